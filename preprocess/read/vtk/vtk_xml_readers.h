/// VTK's readers of XML, without what they do (9.1) to memory where a file is wrong.
#pragma once
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/utf8.h"

namespace splatray {

/// A reader that keeps to its arrays: VTK's own write texts behind the end of an array that has more of them than it says, and fail with a
/// message that reads through null pointers where an array of texts or of cells has too few values.
template <class Reader>
class CarefulReader : public Reader {
 public:
  std::string short_array;  ///< the name of one that has too few values; empty = none

 protected:
  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType first, vtkAbstractArray* array, vtkIdType start,
                      vtkIdType count, vtkXMLReader::FieldType type) override {
    constexpr vtkIdType TEXTS_AT_ONCE = 1024;  // of one byte each, as VTK reads them; it stops behind them
    const vtkIdType tuples = array == nullptr ? 0 : array->GetNumberOfTuples();
    const bool has_texts = vtkStringArray::SafeDownCast(array) != nullptr;
    if (has_texts) array->SetNumberOfTuples(tuples + TEXTS_AT_ONCE);
    const int read = Reader::ReadArrayValues(element, first, array, start, count, type);
    if (has_texts) array->SetNumberOfTuples(tuples);
    if (read != 0) return read;
    const char* name = element->GetAttribute("Name");
    if (!this->AbortExecute) short_array = name == nullptr ? "an array without a name" : to_utf8(name);
    const std::string parent = element->GetParent() == nullptr ? "" : element->GetParent()->GetName();
    return parent == "PointData" || parent == "CellData" ? 1 : 0;
  }
};

/// A new object of VTK's.
template <class Object>
[[nodiscard]] Object* made() {
  auto* object = new Object;
  object->InitializeObjectBase();
  return object;
}

/// VTK's reader of .vtp.
class SurfaceReader : public CarefulReader<vtkXMLPolyDataReader> {
 public:
  static SurfaceReader* New() { return made<SurfaceReader>(); }
};

/// Numbers of polyhedra for a byte of the file: real ones compress less.
inline constexpr std::uint64_t MOST_FACE_NUMBERS = 16;

/// VTK's reader of .vtu, which (9.1) follows the lists of polyhedra's faces wherever they lead: they are looked at before.
class GridReader : public CarefulReader<vtkXMLUnstructuredGridReader> {
 public:
  static GridReader* New() { return made<GridReader>(); }
  std::uint64_t file_bytes = 0;
  bool faces_fit = true;

 protected:
  int ReadPieceData() override {
    faces_fit = faces_fit && check_faces();
    return faces_fit ? vtkXMLUnstructuredGridReader::ReadPieceData() : 0;
  }

 private:
  /// The first `count` of an array; fewer where it has fewer.
  std::vector<vtkIdType> values_of(vtkXMLDataElement* element, vtkIdType count) {
    const auto made = vtkSmartPointer<vtkAbstractArray>::Take(CreateArray(element));
    auto* array = vtkDataArray::SafeDownCast(made);
    if (array == nullptr || array->GetNumberOfComponents() != 1) return {};
    array->SetNumberOfTuples(count);
    if (vtkXMLUnstructuredGridReader::ReadArrayValues(element, 0, array, 0, count) == 0) return {};
    std::vector<vtkIdType> values;
    for (vtkIdType i = 0; i < count; ++i) values.push_back(static_cast<vtkIdType>(array->GetTuple1(i)));
    return values;
  }

  /// Whether each polyhedron's list ends where its offset says: the number of faces, then each face's points after their number.
  bool check_faces() {
    vtkXMLDataElement* cells = CellElements[Piece];
    vtkXMLDataElement* lists = cells == nullptr ? nullptr : FindDataArrayWithName(cells, "faces");
    vtkXMLDataElement* offsets = cells == nullptr ? nullptr : FindDataArrayWithName(cells, "faceoffsets");
    if (lists == nullptr || offsets == nullptr) return true;
    const std::vector<vtkIdType> ends = values_of(offsets, NumberOfCells[Piece]);
    const vtkIdType total = ends.empty() ? 0 : *std::max_element(ends.begin(), ends.end());
    if (total > 0 && static_cast<std::uint64_t>(total) > MOST_FACE_NUMBERS * file_bytes) return false;
    const std::vector<vtkIdType> numbers = values_of(lists, std::max<vtkIdType>(total, 0));
    vtkIdType at = 0;
    for (const vtkIdType end : ends) {
      if (end < 0) continue;  // no polyhedron
      if (end <= at || static_cast<std::size_t>(end) > numbers.size()) return false;
      for (vtkIdType faces = numbers[at++]; faces > 0; --faces) {
        if (at >= end || numbers[at] < 0 || numbers[at] >= end - at) return false;
        at += numbers[at] + 1;
      }
      if (at != end) return false;
    }
    return true;
  }
};

}  // namespace splatray

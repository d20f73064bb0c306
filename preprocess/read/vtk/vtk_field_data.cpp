#include "preprocess/read/vtk/vtk_field_data.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <string>

#include "engine/base/utf8.h"
#include "preprocess/base/quoted_list.h"

namespace splatray {
namespace {

std::string name_of(vtkAbstractArray* array) {
  return array->GetName() == nullptr ? "" : to_utf8(array->GetName());
}

/// The names of the arrays for which `is_left_out`; those that VTK itself makes of ghost cells are none.
template <typename IsLeftOut>
std::vector<std::string> names_where(vtkFieldData* data, const IsLeftOut& is_left_out) {
  std::vector<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (name_of(array) != "vtkGhostType" && is_left_out(array)) names.push_back(name_of(array));
  }
  return names;
}

}  // namespace

std::vector<SplatMark> read_vtk_marks(vtkDataSet* data) {
  std::vector<SplatMark> marks;
  vtkFieldData* fields = data->GetFieldData();
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i) {
    auto* texts = vtkStringArray::SafeDownCast(fields->GetAbstractArray(i));
    if (texts == nullptr || !is_mark_key(name_of(texts))) continue;
    for (vtkIdType n = 0; n < texts->GetNumberOfValues(); ++n)
      marks.push_back({name_of(texts), to_utf8(texts->GetValue(n))});
  }
  return marks;
}

void note_vtk_left_out(vtkDataSet* data, const std::filesystem::path& path, const ReadListener& listener) {
  const auto note = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) listener.note(path, what + quoted_list(names));
  };
  note("skipped arrays without a name or without one number for each point: ",
       names_where(data->GetPointData(), [&](vtkAbstractArray* array) {
         return name_of(array).empty() || vtkDataArray::SafeDownCast(array) == nullptr ||
                array->GetNumberOfTuples() != data->GetNumberOfPoints();
       }));
  note("skipped values of cells: ", names_where(data->GetCellData(), [](vtkAbstractArray*) { return true; }));
  note("skipped field data ", names_where(data->GetFieldData(), [](vtkAbstractArray* array) {
         return vtkStringArray::SafeDownCast(array) == nullptr || !is_mark_key(name_of(array));
       }));
}

}  // namespace splatray

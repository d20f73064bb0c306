#include "preprocess/read/vtk/vtk_module.h"

#include <vtkAlgorithm.h>
#include <vtkAppendFilter.h>
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataSetReader.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "engine/base/utf8.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/scan/narrow_column.h"
#include "preprocess/read/vtk/vtk_cells_check.h"
#include "preprocess/read/vtk/vtk_colors.h"
#include "preprocess/read/vtk/vtk_field_data.h"
#include "preprocess/read/vtk/vtk_xml_readers.h"

namespace splatray {
namespace {

/// Takes what VTK would print while it lives; the first error is kept.
class SilentWindow : public vtkOutputWindow {
 public:
  static SilentWindow* New();
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error.empty()) {
      first_error = text;
    }
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  std::string first_error;

 protected:
  SilentWindow() = default;
};
vtkStandardNewMacro(SilentWindow);

/// Puts the window in VTK's place for messages and stops its log.
class WindowScope {
 public:
  explicit WindowScope(vtkOutputWindow* window)
      : previous_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(window);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~WindowScope() {
    vtkOutputWindow::SetInstance(previous_);
    vtkLogger::SetStderrVerbosity(verbosity_);
  }
  WindowScope(const WindowScope&) = delete;
  WindowScope& operator=(const WindowScope&) = delete;

 private:
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkLogger::Verbosity verbosity_;
};

/// VTK's "ERROR: In file, line n\nvtkClass (0x..): sentence\n\n" -> "sentence".
std::string sentence_of(const std::string& text) {
  const std::size_t address = text.find("): ");
  std::string sentence = address == std::string::npos ? text : text.substr(address + 3);
  sentence.erase(std::find(sentence.begin(), sentence.end(), '\n'), sentence.end());
  while (!sentence.empty() && (sentence.back() == '.' || sentence.back() == ' ')) {
    sentence.pop_back();
  }
  return sentence;
}

/// Hears of a VTK reader's progress; VTK has no place for exceptions, so one that comes waits until the reader is done.
class ProgressWatch : public vtkCommand {
 public:
  static ProgressWatch* New() { return new ProgressWatch; }
  void Execute(vtkObject* caller, unsigned long, void*) override {
    auto* reader = vtkAlgorithm::SafeDownCast(caller);
    try {
      if (stopped == nullptr) listener->report(reader->GetProgress());
    } catch (...) {
      stopped = std::current_exception();
      reader->AbortExecuteOn();
    }
  }

  const ReadListener* listener = nullptr;
  std::exception_ptr stopped;
};

/// Runs readers and filters of VTK's one after the other for one file, silently.
class Run {
 public:
  explicit Run(const std::filesystem::path& path, const ReadListener& listener) : path_(path) {
    watch_->listener = &listener;
  }

  /// Throws what the listener threw, or Error (input_unreadable) with VTK's first error.
  void update(vtkAlgorithm* algorithm) {
    algorithm->AddObserver(vtkCommand::ProgressEvent, watch_.Get());
    try {
      algorithm->Update();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& failure) {
      throw_unreadable(path_, std::string("VTK cannot read it: ") + failure.what());
    }
    if (watch_->stopped) std::rethrow_exception(watch_->stopped);
    if (!window_->first_error.empty())
      throw_unreadable(path_, "VTK cannot read it: " + sentence_of(window_->first_error));
  }

 private:
  const std::filesystem::path& path_;
  vtkNew<SilentWindow> window_;
  WindowScope scope_{window_};
  vtkNew<ProgressWatch> watch_;
};

/// VTK's filters take for granted that attributes have a value for each point or cell.
void drop_unfit_arrays(vtkFieldData* attributes, vtkIdType count) {
  for (int i = attributes->GetNumberOfArrays() - 1; i >= 0; --i)
    if (attributes->GetAbstractArray(i)->GetNumberOfTuples() != count) attributes->RemoveArray(i);
}

/// Makes it read all arrays of each kind, of which it takes the first alone otherwise.
void read_all_of_kind(vtkDataSetReader& reader) {
  reader.ReadAllScalarsOn();
  reader.ReadAllVectorsOn();
  reader.ReadAllNormalsOn();
  reader.ReadAllTensorsOn();
  reader.ReadAllColorScalarsOn();
  reader.ReadAllTCoordsOn();
  reader.ReadAllFieldsOn();
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_by(const std::filesystem::path& path, const ReadListener& listener) {
  Run run(path, listener);
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  if constexpr (std::is_same_v<Reader, GridReader>) reader->file_bytes = std::filesystem::file_size(path);
  if constexpr (std::is_same_v<Reader, vtkDataSetReader>) read_all_of_kind(*reader);
  run.update(reader.Get());
  if constexpr (std::is_same_v<Reader, GridReader>)
    if (!reader->faces_fit)
      throw_unreadable(path, "found lists of polyhedra's faces that end elsewhere than their offsets say");
  if constexpr (!std::is_same_v<Reader, vtkDataSetReader>)
    if (!reader->short_array.empty())
      throw_unreadable(path, "found fewer values of '" + reader->short_array + "' than there should be");
  vtkSmartPointer<vtkDataSet> data = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (data == nullptr) throw_unreadable(path, "VTK found no points in it");
  check_vtk_cells(data, path);
  note_vtk_left_out(data, path, listener);
  drop_unfit_arrays(data->GetPointData(), data->GetNumberOfPoints());
  drop_unfit_arrays(data->GetCellData(), data->GetNumberOfCells());
  return data;
}

vtkSmartPointer<vtkDataSet> read_file(const std::filesystem::path& path, const ReadListener& listener) {
  const std::string extension = lower_extension(path);
  if (extension == ".vtp") return read_by<SurfaceReader>(path, listener);
  if (extension == ".vtu") return read_by<GridReader>(path, listener);
  return read_by<vtkDataSetReader>(path, listener);
}

/// What a file says of all its points; pieces say it of their own alone.
std::vector<SplatMark> marks_of(const std::vector<vtkSmartPointer<vtkDataSet>>& pieces,
                                const std::filesystem::path& path, const ReadListener& listener) {
  std::vector<SplatMark> marks = read_vtk_marks(pieces[0]);
  if (pieces.size() == 1 || marks.empty()) return marks;
  listener.note(path, "skipped what it says of all its points, such as their up direction, as it is a piece");
  return {};
}

/// The pieces as one, without the cells that a piece has of its neighbours; points at one place of volumes are one.
vtkSmartPointer<vtkDataSet> joined(const std::vector<vtkSmartPointer<vtkDataSet>>& pieces,
                                   const std::filesystem::path& path, const ReadListener& listener) {
  if (pieces.size() == 1) return pieces[0];
  Run run(path, listener);
  if (vtkPolyData::SafeDownCast(pieces[0]) != nullptr) {
    const vtkNew<vtkAppendPolyData> all;
    for (vtkDataSet* piece : pieces) {
      auto* surface = vtkPolyData::SafeDownCast(piece);
      surface->RemoveGhostCells();
      all->AddInputData(surface);
    }
    run.update(all.Get());
    return all->GetOutput();
  }
  const vtkNew<vtkAppendFilter> all;
  all->MergePointsOn();
  for (vtkDataSet* piece : pieces) {
    vtkUnstructuredGrid::SafeDownCast(piece)->RemoveGhostCells();
    all->AddInputData(piece);
  }
  run.update(all.Get());
  return all->GetOutput();
}

/// The outer faces of what is no surface yet.
vtkSmartPointer<vtkPolyData> surface_of(vtkDataSet* data, const std::filesystem::path& path,
                                        const ReadListener& listener) {
  if (auto* surface = vtkPolyData::SafeDownCast(data)) return surface;
  Run run(path, listener);
  const vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(data);
  run.update(filter.Get());
  return filter->GetOutput();
}

bool is_beside(vtkDataArray* array, vtkIdType count) {
  return array != nullptr && array->GetNumberOfTuples() == count;
}

/// An array of the points' attributes as columns, one for each component and of vectors their length too.
void add_columns(vtkDataArray* array, Points& points) {
  const int width = array->GetNumberOfComponents();
  const std::string name = to_utf8(array->GetName());
  std::vector<double> values(points.size()), squared(width == 3 || width == 2 ? points.size() : 0);
  for (int component = 0; component < width; ++component) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = array->GetComponent(static_cast<vtkIdType>(i), component);
    for (std::size_t i = 0; i < squared.size(); ++i) squared[i] += values[i] * values[i];
    const std::string suffix = width == 1         ? std::string()
                               : !squared.empty() ? std::string("_") + "XYZ"[component]
                                                  : "_" + std::to_string(component);
    points.columns.push_back(narrow_column(name + suffix, values));
  }
  if (squared.empty()) return;
  for (double& value : squared) value = std::sqrt(value);
  points.columns.push_back(narrow_column(name + "_Magnitude", std::move(squared)));
}

/// What is neither normal, colour nor radius, as far as scenes have room for; splats' words (`has_words`) become no attributes.
void copy_attributes(vtkPointData* attributes, const std::vector<vtkDataArray*>& used, bool has_words,
                     const std::filesystem::path& path, const ReadListener& listener, Points& points) {
  const auto count = static_cast<vtkIdType>(points.size());
  std::uint64_t left_out = 0;
  std::size_t taken = 0;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = attributes->GetArray(i);
    if (!is_beside(array, count) || array->GetName() == nullptr || array->GetName()[0] == 0) continue;
    const std::string name = to_utf8(array->GetName());
    const auto width = static_cast<std::size_t>(array->GetNumberOfComponents());
    if (std::find(used.begin(), used.end(), array) != used.end() || name == "vtkGhostType" || width == 0)
      continue;
    listener.report(0.9);
    const bool is_word =
        has_words && std::find(SPLAT_WORDS.begin(), SPLAT_WORDS.end(), name) != SPLAT_WORDS.end();
    const std::size_t columns = is_word ? 0 : width == 2 || width == 3 ? width + 1 : width;
    if (taken + columns > COLUMNS_MOST) {
      ++left_out;
    } else {
      add_columns(array, points);
      taken += columns;
    }
  }
  if (left_out > 0)
    listener.note(path, std::to_string(left_out) + " arrays are left out, as scenes have at most " +
                            std::to_string(COLUMNS_MOST) + " attributes");
}

void copy_points(vtkPointSet* data, bool has_words, const std::filesystem::path& path,
                 const ReadListener& listener, Points& points) {
  const vtkIdType count = data->GetNumberOfPoints();
  points.position.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i) data->GetPoint(i, &points.position[static_cast<std::size_t>(i)].x);
  vtkPointData* attributes = data->GetPointData();
  std::vector<vtkDataArray*> used;
  if (vtkDataArray* normals = attributes->GetNormals();
      is_beside(normals, count) && normals->GetNumberOfComponents() == 3) {
    used.push_back(normals);
    for (vtkIdType i = 0; i < count; ++i) {
      const double* n = normals->GetTuple3(i);
      points.normal.emplace_back(n[0], n[1], n[2]);
    }
  }
  for (vtkDataArray* colors : read_vtk_colors(attributes, path, listener, points)) used.push_back(colors);
  vtkDataArray* radii = attributes->GetArray("radius");
  if (is_beside(radii, count) && radii->GetNumberOfComponents() == 1) {
    used.push_back(radii);
    for (vtkIdType i = 0; i < count; ++i) points.radius.push_back(static_cast<float>(radii->GetTuple1(i)));
  }
  copy_attributes(attributes, used, has_words, path, listener, points);
}

/// Triangles of cells that check_vtk_cells has seen.
void copy_cells(vtkCellArray* cells, bool strips, Mesh& mesh) {
  vtkIdType length = 0;
  const vtkIdType* ids = nullptr;
  cells->InitTraversal();
  while (cells->GetNextCell(length, ids) != 0) {
    for (vtkIdType i = 2; i < length; ++i) {
      const auto odd = strips && i % 2 == 1;
      const glm::uvec3 triangle(strips ? ids[i - 2] : ids[0], ids[i - 1], ids[i]);
      mesh.triangles.push_back(odd ? glm::uvec3(triangle.y, triangle.x, triangle.z) : triangle);
    }
  }
}

Mesh mesh_of(vtkDataSet* data, const std::vector<SplatMark>& marks, const std::filesystem::path& path,
             const ReadListener& listener) {
  if (data->GetNumberOfPoints() > 0xFFFFFFFFLL) throw_unreadable(path, "found more than 4294967295 points");
  const vtkSmartPointer<vtkPolyData> surface = surface_of(data, path, listener.part(0.8, 0.9));
  const bool has_faces = surface->GetNumberOfPolys() > 0 || surface->GetNumberOfStrips() > 0;
  auto* points = vtkPointSet::SafeDownCast(data);
  Mesh mesh;
  copy_points(has_faces || points == nullptr ? surface.Get() : points, !has_faces && has_splats(marks), path,
              listener, mesh.vertices);
  if (!has_faces) {
    take_marks(marks, mesh.vertices);
    return mesh;
  }
  copy_cells(surface->GetPolys(), false, mesh);
  copy_cells(surface->GetStrips(), true, mesh);
  return mesh;
}

}  // namespace
}  // namespace splatray

void splatray_read_vtk(const std::vector<std::filesystem::path>& files,
                       const splatray::ReadListener& listener, splatray::Mesh& mesh) {
  std::vector<vtkSmartPointer<vtkDataSet>> pieces;
  const double share = 0.7 / static_cast<double>(files.size());
  for (const std::filesystem::path& file : files) {
    const double begin = share * static_cast<double>(pieces.size());
    pieces.push_back(splatray::read_file(file, listener.part(begin, begin + share)));
  }
  const auto whole = splatray::joined(pieces, files[0], listener.part(0.7, 0.8));
  mesh = splatray::mesh_of(whole, splatray::marks_of(pieces, files[0], listener), files[0], listener);
}

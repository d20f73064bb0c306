#include "preprocess/read/vtk/vtk_module.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "engine/base/srgb.h"
#include "preprocess/read/byte_reader.h"

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

template <class Reader>
vtkSmartPointer<vtkPolyData> run_reader(Reader* reader, const std::filesystem::path& path,
                                        const ReadListener& listener) {
  const vtkNew<SilentWindow> window;
  const WindowScope scope(window);
  const vtkNew<ProgressWatch> watch;
  watch->listener = &listener;
  reader->AddObserver(vtkCommand::ProgressEvent, watch.Get());
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    throw_unreadable(path, std::string("VTK cannot read it: ") + failure.what());
  }
  if (watch->stopped) {
    std::rethrow_exception(watch->stopped);
  }
  if (!window->first_error.empty()) {
    throw_unreadable(path, "VTK cannot read it: " + sentence_of(window->first_error));
  }
  vtkSmartPointer<vtkPolyData> data = reader->GetOutput();
  if (data == nullptr) {
    throw_unreadable(path, "VTK found no surface in it");
  }
  return data;
}

void copy_points(vtkPolyData* data, Points& points) {
  const vtkIdType count = data->GetNumberOfPoints();
  points.position.resize(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i) {
    data->GetPoint(i, &points.position[static_cast<std::size_t>(i)].x);
  }
  vtkPointData* attributes = data->GetPointData();
  if (vtkDataArray* normals = attributes->GetNormals();
      normals != nullptr && normals->GetNumberOfComponents() == 3 && normals->GetNumberOfTuples() == count) {
    for (vtkIdType i = 0; i < count; ++i) {
      const double* n = normals->GetTuple3(i);
      points.normal.emplace_back(n[0], n[1], n[2]);
    }
  }
  auto* colors = vtkUnsignedCharArray::SafeDownCast(attributes->GetScalars());
  if (colors != nullptr && colors->GetNumberOfComponents() >= 3 && colors->GetNumberOfTuples() == count) {
    for (vtkIdType i = 0; i < count; ++i) {
      const auto linear = [&](int channel) {
        return srgb_to_linear(static_cast<float>(colors->GetTypedComponent(i, channel)) / 255.0F);
      };
      points.color.emplace_back(linear(0), linear(1), linear(2));
    }
  }
  vtkDataArray* radii = attributes->GetArray("radius");
  if (radii != nullptr && radii->GetNumberOfComponents() == 1 && radii->GetNumberOfTuples() == count) {
    for (vtkIdType i = 0; i < count; ++i) {
      points.radius.push_back(static_cast<float>(radii->GetTuple1(i)));
    }
  }
}

void copy_cells(vtkCellArray* cells, bool strips, const std::filesystem::path& path, Mesh& mesh) {
  const auto vertex_count = static_cast<vtkIdType>(mesh.vertices.size());
  if (!cells->IsValid()) {
    throw_unreadable(path, "the offsets of its faces do not fit their connectivity");
  }
  vtkIdType length = 0;
  const vtkIdType* ids = nullptr;
  cells->InitTraversal();
  while (cells->GetNextCell(length, ids) != 0) {
    for (vtkIdType i = 0; i < length; ++i) {
      if (ids[i] < 0 || ids[i] >= vertex_count) {
        throw_unreadable(path, "a face uses vertex " + std::to_string(ids[i]) + ", expected less than " +
                                   std::to_string(vertex_count));
      }
    }
    for (vtkIdType i = 2; i < length; ++i) {
      const auto odd = strips && i % 2 == 1;
      const glm::uvec3 triangle(strips ? ids[i - 2] : ids[0], ids[i - 1], ids[i]);
      mesh.triangles.push_back(odd ? glm::uvec3(triangle.y, triangle.x, triangle.z) : triangle);
    }
  }
}

Mesh mesh_of(vtkPolyData* data, const std::filesystem::path& path) {
  Mesh mesh;
  if (data->GetNumberOfPoints() > 0xFFFFFFFFLL) {
    throw_unreadable(path, "found more than 4294967295 points");
  }
  copy_points(data, mesh.vertices);
  copy_cells(data->GetPolys(), false, path, mesh);
  copy_cells(data->GetStrips(), true, path, mesh);
  return mesh;
}

}  // namespace
}  // namespace splatray

void splatray_read_vtp(const std::filesystem::path& path, const splatray::ReadListener& listener,
                       splatray::Mesh& mesh) {
  const vtkNew<vtkXMLPolyDataReader> reader;
  mesh = splatray::mesh_of(splatray::run_reader(reader.Get(), path, listener), path);
}

#include "preprocess/read/vtk/read_vtk.h"

#include "engine/base/module.h"
#include "preprocess/read/vtk/vtk_module.h"
#include "preprocess/read/vtk/vtp_check.h"

namespace splatray {

Mesh read_vtp(const std::filesystem::path& path, const ReadListener& listener) {
  void* function = module_function("splatray_vtk", "splatray_read_vtp", ExitCode::input_unreadable,
                                   path.string() + ": cannot read VTK's format .vtp",
                                   ": the package splatray-vtk (Python's wheel has no VTK)");
  check_vtp(path, listener.part(0.0, 0.2));
  Mesh mesh;
  reinterpret_cast<decltype(&splatray_read_vtp)>(function)(path, listener.part(0.2, 1.0), mesh);
  return mesh;
}

}  // namespace splatray

// read_vtp of builds without VTK (Python's wheel).
#include "engine/base/error.h"
#include "preprocess/read/vtk/read_vtk.h"

namespace splatray {

Mesh read_vtp(const std::filesystem::path& path, const ReadListener& /*listener*/) {
  throw Error(
      ExitCode::input_unreadable,
      path.string() + ": found a .vtp, expected another format, as this build of splatray has no VTK");
}

}  // namespace splatray

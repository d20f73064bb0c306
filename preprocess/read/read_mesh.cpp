#include "preprocess/read/read_mesh.h"

#include "preprocess/base/file_extension.h"
#include "preprocess/read/byte_reader.h"
#include "preprocess/read/ply/read_ply.h"
#include "preprocess/read/read_vtk.h"

namespace splatray {

Mesh read_mesh(const std::filesystem::path& path, std::vector<std::string>& notes) {
  const ByteReader present(path);
  const std::string extension = lower_extension(path);
  if (extension == ".ply") {
    return read_ply(path, notes);
  }
  if (extension == ".obj" || extension == ".stl" || extension == ".vtp") {
    return read_vtk(path, notes);
  }
  if (extension == ".gltf" || extension == ".glb") {
    throw_unreadable(path, "found a glTF scene, expected a geometry file: .ply .obj .stl .vtp");
  }
  throw_unreadable(path,
                   "found the extension '" + extension + "', expected one of .ply .obj .stl .vtp .gltf .glb");
}

}  // namespace splatray

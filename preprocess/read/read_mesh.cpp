#include "preprocess/read/read_mesh.h"

#include "preprocess/base/file_extension.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/scan/gaussian_capture.h"

namespace splatray {

Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener) {
  const ByteReader present(path);
  const Format* format = find_format(path);
  refuse_gaussian_file(path);
  if (lower_extension(path) == ".vtkhdf") {
    throw_unreadable(
        path,
        "found VTK's HDF format, which is not read, expected the same data as .vtp or .vtu: ParaView's "
        "Save Data, vtkXMLPolyDataWriter and vtkXMLUnstructuredGridWriter write those");
  }
  if (format == nullptr) {
    throw_unreadable(
        path, "found the extension '" + lower_extension(path) + "', expected one of " + format_extensions());
  }
  if (format->read_mesh == nullptr) {
    throw_unreadable(path, "found a scene, expected a geometry file: " + format_extensions(true));
  }
  return format->read_mesh(path, options, listener);
}

}  // namespace splatray

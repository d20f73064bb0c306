#include "preprocess/read/read_mesh.h"

#include "preprocess/base/file_extension.h"
#include "preprocess/read/byte_reader.h"
#include "preprocess/read/formats.h"

namespace splatray {

Mesh read_mesh(const std::filesystem::path& path, const ReadListener& listener) {
  const ByteReader present(path);
  const Format* format = find_format(path);
  if (format == nullptr) {
    throw_unreadable(
        path, "found the extension '" + lower_extension(path) + "', expected one of " + format_extensions());
  }
  if (format->read_mesh == nullptr) {
    throw_unreadable(path, "found a scene, expected a geometry file: " + format_extensions(true));
  }
  return format->read_mesh(path, listener);
}

}  // namespace splatray

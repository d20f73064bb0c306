#include "preprocess/read/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/base/error.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/byte_reader.h"

namespace splatray {
namespace {

constexpr std::array SUPPORTED_EXTENSIONS{
    "KHR_lights_punctual",  "KHR_materials_ior",     "KHR_materials_transmission",
    "KHR_materials_volume", "KHR_mesh_quantization", "KHR_texture_transform",
};
constexpr std::array COMPRESSIONS{
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
};

template <std::size_t N>
bool is_in(const std::array<const char*, N>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Extensions of this family change the look of a material and nothing else; without them the base material
/// is shown.
bool is_look_only(const std::string& extension) { return extension.rfind("KHR_materials_", 0) == 0; }

/// tinygltf's image loader: keeps files as they are; pictures in buffer views are read when they are needed.
bool keep_image_bytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                      const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) {
    image->image.assign(bytes, bytes + size);
  }
  image->as_is = true;
  return true;
}

/// tinygltf's file reader, for files only: from a folder or a device it would ask for all memory, or wait.
bool read_regular_file(std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                       void*) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) {
    *error = "not a regular file";
    return false;
  }
  return tinygltf::ReadWholeFile(bytes, error, path, nullptr);
}

std::uint32_t little_endian_word(const unsigned char* bytes) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes, sizeof(word));
  return word;
}

/// Whether the file is a GLB; its header is checked.
bool check_container(const std::filesystem::path& path) {
  constexpr std::size_t HEADER_BYTES = 12;
  ByteReader in(path);
  const std::uint64_t size = in.remaining();
  const unsigned char* head = in.take(static_cast<std::size_t>(std::min<std::uint64_t>(size, HEADER_BYTES)));
  const bool has_magic = size >= 4 && std::memcmp(head, "glTF", 4) == 0;
  if (!has_magic) {
    if (lower_extension(path) == ".glb") {
      throw_unreadable(path, "the file does not begin with 'glTF', expected a binary glTF");
    }
    return false;
  }
  if (size < HEADER_BYTES) {
    throw_unreadable(path, "found " + std::to_string(size) + " bytes, expected a header of 12");
  }
  if (little_endian_word(head + 4) != 2) {
    throw_unreadable(path, "found glTF container version " + std::to_string(little_endian_word(head + 4)) +
                               ", expected 2");
  }
  if (little_endian_word(head + 8) > size) {
    throw_unreadable(path, "found " + std::to_string(size) + " bytes, the header declares " +
                               std::to_string(little_endian_word(head + 8)));
  }
  return true;
}

std::string first_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) {
    line.pop_back();
  }
  return line.empty() ? "no reason given" : line;
}

void parse(GltfFile& file, bool binary) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_image_bytes, nullptr);
  parser.SetFsCallbacks(
      {tinygltf::FileExists, tinygltf::ExpandFilePath, read_regular_file, tinygltf::WriteWholeFile, nullptr});
  std::string error;
  std::string warning;
  bool good = false;
  try {
    good = binary ? parser.LoadBinaryFromFile(&file.model, &error, &warning, file.path.string())
                  : parser.LoadASCIIFromFile(&file.model, &error, &warning, file.path.string());
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!good) {
    file.fail("not a readable glTF 2.0: " + first_line(error));
  }
}

void check_extensions(const GltfFile& file, std::vector<std::string>& notes) {
  for (const std::string& name : file.model.extensionsRequired) {
    if (is_in(COMPRESSIONS, name)) {
      file.fail("the geometry is compressed with " + name +
                ", expected plain buffers: save it without compression");
    }
    if (!is_in(SUPPORTED_EXTENSIONS, name) && !is_look_only(name)) {
      file.fail("the file requires the extension " + name + ", which is not supported");
    }
  }
  std::vector<std::string> ignored;
  for (const std::string& name : file.model.extensionsUsed) {
    if (!is_in(SUPPORTED_EXTENSIONS, name)) {
      ignored.push_back(name);
    }
  }
  if (!ignored.empty()) {
    notes.push_back(file.path.string() + ": ignored extensions " + quoted_list(ignored));
  }
}

void note_ignored(const GltfFile& file, std::vector<std::string>& notes) {
  if (!file.model.animations.empty()) {
    notes.push_back(file.path.string() + ": ignored animations, the pose at rest is shown");
  }
  if (!file.model.skins.empty()) {
    notes.push_back(file.path.string() + ": ignored skins, meshes are shown unbent");
  }
}

}  // namespace

void GltfFile::fail(const std::string& what) const { throw_unreadable(path, what); }

std::size_t GltfFile::checked(int index, std::size_t count, const char* what) const {
  if (index < 0 || static_cast<std::size_t>(index) >= count) {
    fail("found " + std::string(what) + " " + std::to_string(index) + ", expected less than " +
         std::to_string(count));
  }
  return static_cast<std::size_t>(index);
}

GltfFile load_gltf(const std::filesystem::path& path, std::vector<std::string>& notes) {
  GltfFile file{path, {}};
  parse(file, check_container(path));
  check_extensions(file, notes);
  note_ignored(file, notes);
  return file;
}

std::optional<double> number_in(const tinygltf::Value& object, const std::string& key) {
  if (!object.IsObject() || !object.Get(key).IsNumber()) {
    return std::nullopt;
  }
  return object.Get(key).GetNumberAsDouble();
}

std::string text_in(const tinygltf::Value& object, const std::string& key) {
  return object.IsObject() && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : std::string();
}

std::vector<double> numbers_in(const tinygltf::Value& object, const std::string& key,
                               std::vector<double> otherwise) {
  if (!object.IsObject() || object.Get(key).ArrayLen() != otherwise.size()) {
    return otherwise;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < otherwise.size(); ++i) {
    const tinygltf::Value& entry = object.Get(key).Get(static_cast<int>(i));
    numbers.push_back(entry.IsNumber() ? entry.GetNumberAsDouble() : otherwise[i]);
  }
  return numbers;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

}  // namespace splatray

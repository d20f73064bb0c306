#include "preprocess/read/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "engine/base/json_fault.h"
#include "engine/base/utf8.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/find_file.h"
#include "preprocess/read/scan/gaussian_capture.h"

namespace splatray {
namespace {

constexpr std::array SUPPORTED_EXTENSIONS{
    "KHR_lights_punctual",    "KHR_materials_ior",       "KHR_materials_transmission",
    "KHR_materials_volume",   "KHR_mesh_quantization",   "KHR_texture_transform",
    "KHR_materials_specular", "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
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

/// Where the files lie that a scene's uris name, as tinygltf's file functions take it.
struct SceneFolder {
  std::string path;  ///< absolute
  const ReadListener& listener;
  std::string escape;   ///< a uri that leaves the folder; empty = none
  std::string missing;  ///< the last uri of which there is no file; empty = none
};

std::vector<unsigned char> read_whole_file(const std::filesystem::path& path, const ReadListener& listener) {
  ByteReader in(path, &listener);
  std::vector<unsigned char> bytes;
  bytes.reserve(in.remaining());
  while (in.remaining() > 0) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(in.remaining(), ByteReader::BLOCK_BYTES));
    const unsigned char* block = in.take(count);
    if (block == nullptr) throw_unreadable(path, "it could not be read to its end");
    bytes.insert(bytes.end(), block, block + count);
  }
  return bytes;
}

/// tinygltf asks for the folder's path and a uri, then for the uri in the current folder, which is no place for it.
bool is_in_folder(const std::string& file, void* user_data) {
  auto& folder = *static_cast<SceneFolder*>(user_data);
  if (!file.starts_with(folder.path)) return false;
  const std::filesystem::path uri(file.substr(std::min(file.size(), folder.path.size() + 1)));
  if (!stays_inside(uri)) {
    folder.escape = uri.string();
    return false;
  }
  std::error_code unknown;
  if (std::filesystem::is_regular_file(file, unknown)) return true;
  folder.missing = uri.string();
  return false;
}

bool read_in_folder(std::vector<unsigned char>* bytes, std::string*, const std::string& file,
                    void* user_data) {
  *bytes = read_whole_file(file, static_cast<SceneFolder*>(user_data)->listener);
  return true;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
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

/// The JSON of a file: all of it, or a GLB's first chunk.
std::string_view json_of(const std::vector<unsigned char>& bytes, bool binary) {
  constexpr std::size_t CHUNK_BEGIN = 20;
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!binary) return all;
  if (all.size() < CHUNK_BEGIN) return {};
  return all.substr(CHUNK_BEGIN, little_endian_word(bytes.data() + CHUNK_BEGIN - 8));
}

void store_little_endian_word(unsigned char* bytes, std::size_t word) {
  const auto stored = static_cast<std::uint32_t>(word);
  std::memcpy(bytes, &stored, sizeof(stored));
}

/// Puts a text in the JSON's place; a GLB's lengths follow.
void replace_json(std::vector<unsigned char>& bytes, bool binary, std::string text) {
  constexpr std::size_t ALIGNMENT = 4;  // of a GLB's chunks, which blanks fill
  const std::string_view json = json_of(bytes, binary);
  if (json == text) return;
  const auto begin = bytes.begin() + (reinterpret_cast<const unsigned char*>(json.data()) - bytes.data());
  if (binary) text.resize((text.size() + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT, ' ');
  bytes.insert(bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(json.size())), text.begin(),
               text.end());
  if (!binary) return;
  store_little_endian_word(bytes.data() + 8, bytes.size());
  store_little_endian_word(bytes.data() + 12, text.size());
}

/// The end of a JSON string that begins at a quote: its closing quote, or the text's end.
std::size_t end_of_string(std::string_view json, std::size_t quote) {
  std::size_t at = quote + 1;
  while (at < json.size() && json[at] != '"') at += json[at] == '\\' ? 2 : 1;
  return std::min(at, json.size());
}

/// Spells "+" in the names of files so that tinygltf, which takes it for a blank as forms of web pages do, leaves it.
std::string with_plus_encoded(std::string_view json) {
  std::string text;
  bool is_uri = false;  // of the next string
  for (std::size_t at = 0; at < json.size();) {
    if (json[at] != '"') {
      text += json[at++];
      continue;
    }
    const std::size_t end = std::min(end_of_string(json, at) + 1, json.size());
    const std::string_view string = json.substr(at, end - at);
    const bool is_file = is_uri && !string.starts_with("\"data:");
    for (const char c : string) text += is_file && c == '+' ? "%2B" : std::string(1, c);
    is_uri = string == "\"uri\"";
    at = end;
  }
  return text;
}

/// Makes the JSON UTF-8, as all JSON is to be, and its names of files what they say.
void mend_json(std::vector<unsigned char>& bytes, bool binary) {
  const std::string_view json = json_of(bytes, binary);
  replace_json(bytes, binary, with_plus_encoded(is_utf8(json) ? std::string(json) : to_utf8(json)));
}

void refuse_compressed(const GltfFile& file, const std::string& extension) {
  file.fail("the geometry is compressed with " + extension +
            ", expected plain buffers: save it without compression");
}

/// What of other versions and compressions looks like damage.
void explain_failure(const GltfFile& file) {
  if (file.model.asset.version.starts_with('1'))
    file.fail("found glTF " + file.model.asset.version.substr(0, 20) +
              ", expected 2.0: convert it, as by gltf-pipeline");
  for (const std::string& name : file.model.extensionsUsed)
    if (is_in(COMPRESSIONS, name)) refuse_compressed(file, name);
}

void parse(GltfFile& file, bool binary, const ReadListener& listener) {
  std::vector<unsigned char> bytes = read_whole_file(file.path, listener);
  if (bytes.size() > 0xFFFFFFFFU) {
    file.fail("found " + std::to_string(bytes.size()) + " bytes, expected less than 4 GiB");
  }
  if (json_is_too_deep(json_of(bytes, binary))) {
    file.fail("its JSON nests more than " + std::to_string(MOST_JSON_DEPTH) + " deep");
  }
  mend_json(bytes, binary);
  SceneFolder folder{std::filesystem::absolute(file.path).parent_path().string(), listener, "", ""};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_image_bytes, nullptr);
  parser.SetFsCallbacks({is_in_folder, [](const std::string& path, void*) { return path; }, read_in_folder,
                         write_nothing, &folder});
  std::string error;
  std::string warning;
  bool good = false;
  const auto size = static_cast<unsigned>(bytes.size());
  try {
    good = binary
               ? parser.LoadBinaryFromMemory(&file.model, &error, &warning, bytes.data(), size, folder.path)
               : parser.LoadASCIIFromString(&file.model, &error, &warning,
                                            reinterpret_cast<const char*>(bytes.data()), size, folder.path);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const nlohmann::json::exception&) {
    error = "found a value of another type than glTF has there";
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!folder.escape.empty()) {
    file.fail("found the uri '" + folder.escape + "', expected a file in the scene's folder or below");
  }
  if (!good || file.model.asset.version.starts_with('1')) explain_failure(file);
  if (good) return;
  if (const auto fault = json_fault<nlohmann::json>(json_of(bytes, binary)))
    file.fail("found " + *fault + ", expected the JSON of a glTF");
  if (!folder.missing.empty() && error.find("File not found") != std::string::npos)
    file.fail("found no file '" + folder.missing + "', which it names, expected it beside it");
  file.fail("not a readable glTF 2.0: " + first_line(error));
}

/// Refuses captures of Gaussians, as PLY's are.
void check_gaussians(const GltfFile& file) {
  std::vector<std::string> names = file.model.extensionsUsed;
  for (const tinygltf::Mesh& mesh : file.model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      for (const auto& [name, accessor] : primitive.attributes) names.push_back(name);
      for (const auto& [name, value] : primitive.extensions) names.push_back(name);
    }
  refuse_gaussian_names(file.path, names);
}

void check_extensions(const GltfFile& file, std::vector<std::string>& notes) {
  for (const std::string& name : file.model.extensionsRequired) {
    if (is_in(COMPRESSIONS, name)) {
      refuse_compressed(file, name);
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

/// The textures of materials that are not modelled, by their names in glTF. Occlusion is none of them: light itself finds it.
std::vector<std::string> ignored_textures(const tinygltf::Model& model) {
  constexpr std::pair<const char*, const char*> IN_EXTENSIONS[] = {
      {"KHR_materials_clearcoat", "clearcoatNormalTexture"}, {"KHR_materials_volume", "thicknessTexture"}};
  std::vector<std::string> ignored;
  const auto add = [&](const char* name) {
    if (std::find(ignored.begin(), ignored.end(), name) == ignored.end()) ignored.emplace_back(name);
  };
  for (const tinygltf::Material& material : model.materials) {
    for (const auto& [extension, name] : IN_EXTENSIONS) {
      const tinygltf::Value* found = find_extension(material.extensions, extension);
      if (found != nullptr && found->IsObject() && found->Has(name)) add(name);
    }
  }
  return ignored;
}

void note_ignored(const GltfFile& file, std::vector<std::string>& notes) {
  const std::vector<std::string> textures = ignored_textures(file.model);
  if (!textures.empty())
    notes.push_back(file.path.string() + ": ignored textures " + quoted_list(textures) +
                    ", which are not modelled");
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

GltfFile load_gltf(const std::filesystem::path& path, const ReadListener& listener) {
  GltfFile file{path, {}};
  parse(file, check_container(path), listener);
  check_gaussians(file);
  check_extensions(file, listener.notes);
  note_ignored(file, listener.notes);
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

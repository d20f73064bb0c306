/// A glTF 2.0 file in memory, checked as far as its JSON goes (Khronos, "glTF 2.0 Specification").
#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// The parsed file. Its numbers are still the author's: indices into arrays are checked where they are used.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;  ///< images hold their undecoded bytes, or nothing when they stand in a buffer view

  /// Throws Error (input_unreadable): "<path>: <what>".
  [[noreturn]] void fail(const std::string& what) const;
  /// `index` when it lies in [0, count); fails otherwise, naming what it was to be.
  [[nodiscard]] std::size_t checked(int index, std::size_t count, const char* what) const;
};

/// Loads .gltf or .glb with its buffers. A `uri` names a file in the scene's folder or below it, `extras.points` and
/// `extras.environment` one there or in a data path (find_scene_file): names that are absolute or leave their folder by
/// `..` are refused, so that a scene from elsewhere reads nothing but what lies beside it. Unknown required extensions,
/// compressed geometry, Gaussian splats, glTF 1.0 and JSON that nests deeper than MOST_JSON_DEPTH are errors; extensions that are used and ignored,
/// textures that are not modelled, animations and skins are noted, each once. Throws Error (input_unreadable).
[[nodiscard]] GltfFile load_gltf(const std::filesystem::path& path, const ReadListener& listener);

/// The number `key` of an object value (an extension or extras), if it is there.
[[nodiscard]] std::optional<double> number_in(const tinygltf::Value& object, const std::string& key);
/// The text `key` of an object value, or an empty string.
[[nodiscard]] std::string text_in(const tinygltf::Value& object, const std::string& key);
/// The numbers of the array `key` of an object value, or `otherwise` unless there are exactly as many.
[[nodiscard]] std::vector<double> numbers_in(const tinygltf::Value& object, const std::string& key,
                                             std::vector<double> otherwise);
/// The extension `name`, or nullptr.
[[nodiscard]] const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                                    const std::string& name);

}  // namespace splatray

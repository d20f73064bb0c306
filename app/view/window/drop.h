/// Files that a person drops on the window, or pastes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// What a file is for.
enum class DropKind {
  scene,        ///< a .soct or what splatray-preprocess reads, a folder too
  picture,      ///< of splatray: .png, .exr with options kept in it
  environment,  ///< another .exr, .hdr
  camera,       ///< .json
  unknown
};

/// By the file's name; a .exr by its content.
[[nodiscard]] DropKind drop_kind(const std::filesystem::path& file);

/// The files that a pasted text names: a path or file: URI on each line (RFC 8089), as file managers copy them.
[[nodiscard]] std::vector<std::filesystem::path> pasted_files(const std::string& text);

}  // namespace splatray

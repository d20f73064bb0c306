/// Texts and files of JSON.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/json_fault.h"
#include "engine/file/file_roles.h"

namespace splatray {

/// What a text of JSON holds. `refuse(found, expected)`, which throws, is called for one that is none.
template <class Refuse>
[[nodiscard]] nlohmann::ordered_json parse_json(const std::string& text, const Refuse& refuse) {
  if (const auto fault = json_fault<nlohmann::ordered_json>(text)) refuse(*fault, "JSON");
  return nlohmann::ordered_json::parse(text);
}

/// The same of a file; one that is not there is refused, too.
template <class Refuse>
[[nodiscard]] nlohmann::ordered_json read_json_file(const std::filesystem::path& path, const Refuse& refuse) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    refuse(std::filesystem::exists(path, error) ? "a folder or device" : "no such file", "a JSON file");
  note_input(path);
  std::ifstream file(path, std::ios::binary);
  return parse_json(std::string{std::istreambuf_iterator<char>(file), {}}, refuse);
}

}  // namespace splatray

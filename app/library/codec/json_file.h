/// Files of JSON.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/json_depth.h"
#include "engine/file/file_roles.h"

namespace splatray {

/// What a file of JSON holds. `refuse(found, expected)`, which throws, is called for one that is not there or holds none.
template <class Refuse>
[[nodiscard]] nlohmann::ordered_json read_json_file(const std::filesystem::path& path, const Refuse& refuse) {
  using Json = nlohmann::ordered_json;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    refuse(std::filesystem::exists(path, error) ? "a folder or device" : "no such file", "a JSON file");
  note_input(path);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (json_is_too_deep(text))
    refuse("JSON that nests more than " + std::to_string(MOST_JSON_DEPTH) + " deep", "a JSON file");
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& damage) {
    refuse("no JSON after byte " + std::to_string(damage.byte), "a JSON file");
  } catch (const Json::out_of_range&) {
    refuse("a number beyond float64", "finite numbers");
  }
  return {};
}

}  // namespace splatray

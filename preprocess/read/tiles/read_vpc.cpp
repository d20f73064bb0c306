#include "preprocess/read/tiles/read_vpc.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "preprocess/base/file_extension.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/tiles/read_json.h"

namespace splatray {
namespace {

using Json = nlohmann::json;

/// A member of an object, null where there is none.
const Json& member(const Json& object, const char* name) {
  static const Json NONE;
  return object.is_object() && object.contains(name) ? object.at(name) : NONE;
}

/// Whether an asset of a survey's tile is its points, not pictures or thinned copies of them.
bool is_points(const std::string& name, const Json& asset) {
  const Json& roles = member(asset, "roles");
  return roles.is_array() ? std::find(roles.begin(), roles.end(), "data") != roles.end() : name == "data";
}

std::filesystem::path place_of(const std::filesystem::path& list, const std::string& href) {
  const std::filesystem::path place(href);
  return is_url(place) || place.is_absolute() ? place : list.parent_path() / place;
}

}  // namespace

std::vector<std::filesystem::path> read_vpc(const std::filesystem::path& path) {
  const Json list = read_json(path);
  const Json& features = member(list, "features");
  if (!features.is_array())
    throw_unreadable(path, "found no list of features, expected a virtual point cloud's");
  std::vector<std::filesystem::path> files;
  for (const Json& feature : features) {
    for (const auto& [name, asset] : member(feature, "assets").items()) {
      const Json& href = member(asset, "href");
      if (!href.is_string() || !is_points(name, asset)) continue;
      files.push_back(place_of(path, href.get<std::string>()));
      const Format* format = find_format(files.back());
      if (format == nullptr || format->read_scan == nullptr)
        throw_unreadable(path, "found the file '" + href.get<std::string>() + "' in it, expected scans");
    }
  }
  if (files.empty()) throw_unreadable(path, "found no files of points in it, expected some");
  return files;
}

}  // namespace splatray

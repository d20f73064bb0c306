#include "preprocess/read/scan/column_names.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "engine/scene/columns.h"

namespace splatray {
namespace {

struct Alias {
  std::string_view plain;
  std::string_view meaning;
};

/// The plainest first. PDAL, CloudCompare, ParaView, VeloView, LAStools and the specifications of LAS call them so.
constexpr Alias ALIASES[] = {
    {"x", "x"},
    {"y", "y"},
    {"z", "z"},
    {"xcoordinate", "x"},
    {"ycoordinate", "y"},
    {"zcoordinate", "z"},
    {"xcoord", "x"},
    {"ycoord", "y"},
    {"zcoord", "z"},
    {"pointsmxyz0", "x"},
    {"pointsmxyz1", "y"},
    {"pointsmxyz2", "z"},
    {"points0", "x"},
    {"points1", "y"},
    {"points2", "z"},
    {"easting", "x"},
    {"northing", "y"},
    {"east", "x"},
    {"north", "y"},
    {"lon", "x"},
    {"lat", "y"},
    {"longitude", "x"},
    {"latitude", "y"},
    {"elevation", "z"},
    {"height", "z"},
    {"altitude", "z"},
    {"elev", "z"},
    {"alt", "z"},
    {"nx", "nx"},
    {"ny", "ny"},
    {"nz", "nz"},
    {"normalx", "nx"},
    {"normaly", "ny"},
    {"normalz", "nz"},
    {"red", "red"},
    {"green", "green"},
    {"blue", "blue"},
    {"normals0", "nx"},
    {"normals1", "ny"},
    {"normals2", "nz"},
    {"diffusered", "red"},
    {"diffusegreen", "green"},
    {"diffuseblue", "blue"},
    {"r", "red"},
    {"g", "green"},
    {"b", "blue"},
    {"rgb0", "red"},
    {"rgb1", "green"},
    {"rgb2", "blue"},
    {"rgba0", "red"},
    {"rgba1", "green"},
    {"rgba2", "blue"},
    {"colors0", "red"},
    {"colors1", "green"},
    {"colors2", "blue"},
    {"rf", "red"},
    {"gf", "green"},
    {"bf", "blue"},
    {"intensity", COLUMN_INTENSITY},
    {"i", COLUMN_INTENSITY},
    {"reflectance", COLUMN_INTENSITY},
    {"reflectivity", COLUMN_INTENSITY},
    {"amplitude", COLUMN_INTENSITY},
    {"class", COLUMN_CLASS},
    {"classification", COLUMN_CLASS},
    {"return", COLUMN_RETURN},
    {"returnnumber", COLUMN_RETURN},
    {"returns", COLUMN_RETURNS},
    {"numberofreturns", COLUMN_RETURNS},
    {"source", COLUMN_SOURCE},
    {"sourceid", COLUMN_SOURCE},
    {"pointsourceid", COLUMN_SOURCE},
    {"time", COLUMN_TIME},
    {"gpstime", COLUMN_TIME},
    {"scan", COLUMN_SCAN},
    {"scanid", COLUMN_SCAN},
    {"scanindex", COLUMN_SCAN},
    {"sweep", COLUMN_SCAN},
};

constexpr std::string_view DEGREES[] = {"lon", "lat", "longitude", "latitude"};

std::string alias_name(std::string_view name) {
  std::string plain = plain_name(name.substr(0, name.find_first_of("[(", 1)));
  if (plain.size() > 6 && plain.starts_with("scalar")) plain.erase(0, 6);
  return plain;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

std::vector<std::string> known_columns(const std::vector<std::string>& names) {
  std::vector<std::string> plain(names.size());
  std::transform(names.begin(), names.end(), plain.begin(), alias_name);
  std::vector<std::string> meanings(names.size());
  for (const Alias& alias : ALIASES) {
    const auto found = std::find(plain.begin(), plain.end(), alias.plain);
    const bool taken = std::find(meanings.begin(), meanings.end(), alias.meaning) != meanings.end();
    if (found != plain.end() && !taken)
      meanings[static_cast<std::size_t>(found - plain.begin())] = alias.meaning;
  }
  return meanings;
}

bool is_degrees(std::string_view name) {
  return std::find(std::begin(DEGREES), std::end(DEGREES), alias_name(name)) != std::end(DEGREES);
}

}  // namespace splatray

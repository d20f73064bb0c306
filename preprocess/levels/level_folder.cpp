#include "preprocess/levels/level_folder.h"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/tiles/ept.h"
#include "preprocess/read/tiles/read_json.h"

namespace splatray {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

constexpr int EPT_SPAN = 128;  ///< cells along a node's edge, of each of which it has one point

Json corners_json(const glm::dvec3& low, const glm::dvec3& high) {
  return {low.x, low.y, low.z, high.x, high.y, high.z};
}

Json stations_json(const std::vector<Station>& stations) {
  Json json = Json::array();
  for (const Station& station : stations) {
    Json entry{{"name", station.name}};
    if (station.sensor_world)
      entry["sensor"] = {station.sensor_world->x, station.sensor_world->y, station.sensor_world->z};
    json.push_back(std::move(entry));
  }
  return json;
}

Json job_json(const LevelJob& job) {
  Json parts = Json::array();
  for (const LevelPart& part : job.plan.parts)
    parts.push_back({part.level, part.cell.x, part.cell.y, part.cell.z, part.points});
  const glm::dvec3& low = job.plan.lattice.low;
  return {{"source", job.source},
          {"stations", stations_json(job.stations)},
          {"first_stations", job.first_stations},
          {"low", {low.x, low.y, low.z}},
          {"edge", job.plan.lattice.edge},
          {"depth", job.plan.depth},
          {"parts", parts},
          {"schema", tile_schema_json(job.schema)},
          {"crs", job.crs},
          {"points", job.points},
          {"box", corners_json(job.box_low, job.box_high)}};
}

glm::dvec3 corner_of(const Json& numbers, std::size_t at) {
  return {numbers.at(at).get<double>(), numbers.at(at + 1).get<double>(), numbers.at(at + 2).get<double>()};
}

LevelJob job_of(const Json& json, const Path& path) {
  LevelJob job;
  job.source = json.at("source").get<std::string>();
  job.plan.lattice = {corner_of(json.at("low"), 0), json.at("edge").get<double>()};
  job.plan.depth = json.at("depth").get<unsigned>();
  for (const Json& part : json.at("parts"))
    job.plan.parts.push_back(
        {part.at(0).get<std::uint32_t>(),
         {part.at(1).get<std::uint32_t>(), part.at(2).get<std::uint32_t>(), part.at(3).get<std::uint32_t>()},
         part.at(4).get<std::uint64_t>()});
  job.plan.index();
  job.schema = read_tile_schema(json.at("schema"), path);
  job.crs = json.at("crs").get<std::string>();
  job.points = json.at("points").get<std::uint64_t>();
  job.stations = read_stations(json.at("stations"), path);
  job.first_stations = json.at("first_stations").get<std::vector<std::size_t>>();
  job.box_low = corner_of(json.at("box"), 0);
  job.box_high = corner_of(json.at("box"), 3);
  return job;
}

/// What read gives of a file's JSON; nothing where there is no such file.
template <typename Read>
auto read_kept(const Path& path, const Read& read) -> std::optional<decltype(read(Json()))> {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  try {
    return read(read_json(path));
  } catch (const Json::exception&) {
    throw_unreadable(path,
                     "found a damaged file of levels in the making, expected what splatray-preprocess wrote");
  }
}

Json system_json(const std::string& text) {
  Json system = Json::object();
  if (text.empty()) return system;
  const Crs crs = describe_crs(text);
  if (crs.epsg != 0) system = {{"authority", "EPSG"}, {"horizontal", std::to_string(crs.epsg)}};
  if (crs.vertical_epsg != 0) system["vertical"] = std::to_string(crs.vertical_epsg);
  if (!text.starts_with("EPSG:")) system["wkt"] = text;
  return system;
}

}  // namespace

std::string node_name(std::uint32_t level, const glm::uvec3& cell) {
  return std::to_string(level) + '-' + std::to_string(cell.x) + '-' + std::to_string(cell.y) + '-' +
         std::to_string(cell.z);
}

LevelFolder::LevelFolder(const Path& ept_json)
    : ept_json_(ept_json), folder_(ept_json.parent_path()), build_(folder_ / "ept-build") {}

Path LevelFolder::node(const std::string& name) const { return folder_ / "ept-data" / (name + ".bin"); }
Path LevelFolder::top(std::size_t part) const { return build_ / ("top-" + std::to_string(part) + ".bin"); }
Path LevelFolder::rest(std::size_t part) const { return build_ / ("rest-" + std::to_string(part) + ".bin"); }
Path LevelFolder::means(const std::string& name) const { return folder_ / "ept-means" / (name + ".bin"); }
Path LevelFolder::records(std::size_t part, const std::string& node) const {
  return build_ / ("part-" + std::to_string(part) + (node.empty() ? "" : "-" + node) + ".bin");
}

std::optional<LevelJob> LevelFolder::job() const {
  const Path path = build_ / "plan.json";
  return read_kept(path, [&](const Json& json) { return job_of(json, path); });
}

void LevelFolder::keep(const LevelJob& job) const {
  for (const Path& folder :
       {folder_ / "ept-data", folder_ / "ept-means", folder_ / "ept-hierarchy", build_}) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw Error(ExitCode::failed, folder.string() + ": the folder could not be made: " + error.message());
  }
  write_text_file(job_json(job).dump(), build_ / "plan.json");
}

DividedSoFar LevelFolder::divided(std::size_t parts) const {
  const auto kept = read_kept(build_ / "divided.json", [](const Json& json) {
    return DividedSoFar{json.at("batches").get<std::size_t>(),
                        json.at("bytes").get<std::vector<std::uint64_t>>()};
  });
  return kept && kept->bytes.size() == parts ? *kept : DividedSoFar{0, std::vector<std::uint64_t>(parts)};
}

void LevelFolder::keep(const DividedSoFar& divided) const {
  write_text_file(Json{{"batches", divided.batches}, {"bytes", divided.bytes}}.dump(),
                  build_ / "divided.json");
}

std::optional<BuiltNodes> LevelFolder::nodes_of(std::size_t part) const {
  return read_kept(build_ / ("nodes-" + std::to_string(part) + ".json"), [](const Json& json) {
    return BuiltNodes{json.at("points").get<NodeCounts>(), json.at("means").get<NodeCounts>()};
  });
}

void LevelFolder::keep(std::size_t part, const BuiltNodes& nodes) const {
  write_text_file(Json{{"points", nodes.points}, {"means", nodes.means}}.dump(),
                  build_ / ("nodes-" + std::to_string(part) + ".json"));
}

void LevelFolder::finish(const LevelJob& job, const BuiltNodes& nodes) const {
  write_text_file(Json(nodes.points).dump() + '\n', folder_ / "ept-hierarchy" / "0-0-0-0.json");
  write_text_file(Json(nodes.means).dump() + '\n', folder_ / "ept-means" / "counts.json");
  const LevelLattice& lattice = job.plan.lattice;
  Json head{{"bounds", corners_json(lattice.low, lattice.low + lattice.edge)},
            {"boundsConforming", corners_json(job.box_low, job.box_high)},
            {"dataType", "binary"},
            {"hierarchyType", "json"},
            {"means", true},
            {"points", job.points},
            {"schema", tile_schema_json(job.schema)},
            {"span", EPT_SPAN},
            {"srs", system_json(job.crs)},
            {"version", "1.0.0"}};
  if (!job.stations.empty()) head["stations"] = stations_json(job.stations);
  write_text_file(head.dump(1) + '\n', ept_json_);
  std::error_code error;
  std::filesystem::remove_all(build_, error);
}

void write_records(std::span<const unsigned char> bytes, const Path& path, bool append) {
  std::ofstream file(path, std::ios::binary | (append ? std::ios::app : std::ios::trunc));
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Error(ExitCode::failed, path.string() + ": it could not be written, is the disk full?");
}

std::vector<unsigned char> read_records(const Path& path) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) == 0 && !error) return {};
  ByteReader in(path);
  return in.read(in.remaining());
}

}  // namespace splatray

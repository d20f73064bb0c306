#include "preprocess/read/tiles/ept.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <span>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "preprocess/base/level_facts.h"
#include "preprocess/base/point_arrays.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/las/read_las.h"
#include "preprocess/read/tiles/read_json.h"
#include "preprocess/read/tiles/stand_ins.h"
#include "preprocess/read/tiles/tile_schema.h"
#include "preprocess/read/tiles/zstandard.h"

namespace splatray {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

/// What an `ept.json` says of the whole.
struct Head {
  Json json;
  glm::dvec3 low{0.0};
  double edge = 0.0;  ///< of the root's cube
  std::array<glm::dvec3, 2> box{};
  std::string crs;
  std::optional<TileSchema> binary;  ///< of tiles that are records alone, else they are LAZ
  bool is_packed = false;            ///< those records are, by Zstandard
  bool has_means = false;            ///< beside binary tiles, as splatray-preprocess writes them
};

std::array<glm::dvec3, 2> box_of(const Path& path, const Json& json, const char* name) {
  const Json numbers = json.value(name, Json());
  if (!numbers.is_array() || numbers.size() != 6 ||
      !std::all_of(numbers.begin(), numbers.end(), [](const Json& n) { return n.is_number(); }))
    throw_unreadable(path, "found no " + std::string(name) + " of six numbers, expected an ept.json");
  const auto corner = [&](std::size_t at) {
    return glm::dvec3(numbers[at].get<double>(), numbers[at + 1].get<double>(),
                      numbers[at + 2].get<double>());
  };
  return {corner(0), corner(3)};
}

/// One of EPSG's numbers, a text or a number; 0 where there is none.
unsigned epsg_number(const Json& system, const char* name) {
  const Json value =
      system.is_object() && system.value("authority", Json()) == "EPSG" ? system.value(name, Json()) : Json();
  if (value.is_number_unsigned()) return value.get<unsigned>();
  const std::string text = value.is_string() ? value.get<std::string>() : "";
  unsigned number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

Head read_head(const Path& path) {
  Head head;
  head.json = read_json(path);
  if (!head.json.is_object()) throw_unreadable(path, "found no object, expected an ept.json");
  const auto [low, high] = box_of(path, head.json, "bounds");
  head.low = low;
  head.edge = high.x - low.x;
  if (!(head.edge > 0.0)) throw_unreadable(path, "found an octree without a size, expected a positive one");
  head.box = head.json.contains("boundsConforming") ? box_of(path, head.json, "boundsConforming")
                                                    : std::array{low, high};
  const Json type = head.json.value("dataType", Json());
  head.is_packed = type == "zstandard";
  if (type == "binary" || head.is_packed)
    head.binary = read_tile_schema(head.json.value("schema", Json()), path);
  else if (type != "laszip")
    throw_unreadable(
        path, "found tiles of the type " + type.dump() + R"(, expected "laszip", "binary" or "zstandard")");
  head.has_means = head.binary && !head.is_packed && head.json.value("means", Json()) == true;
  const Json system = head.json.value("srs", Json::object());
  const Json text = system.is_object() ? system.value("wkt", Json()) : Json();
  const unsigned horizontal = epsg_number(system, "horizontal");
  if (text.is_string())
    head.crs = text.get<std::string>();
  else if (horizontal != 0)
    head.crs = epsg_text(horizontal, epsg_number(system, "vertical"), {});
  return head;
}

/// "1-0-1-1", what a node's file is called.
std::string name_of(const LevelNode& node) {
  return std::to_string(node.level) + '-' + std::to_string(node.cell.x) + '-' + std::to_string(node.cell.y) +
         '-' + std::to_string(node.cell.z);
}

/// The node that a name means; nothing where it is none.
std::optional<LevelNode> node_of(const std::string& name) {
  std::array<std::uint32_t, 4> numbers{};
  const char* at = name.data();
  const char* const end = at + name.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != '-')) return std::nullopt;
    const auto [next, fault] = std::from_chars(at, end, numbers[i]);
    if (fault != std::errc{}) return std::nullopt;
    at = next;
  }
  LevelNode node{numbers[0], {numbers[1], numbers[2], numbers[3]}};
  return at == end && node.lies_in_octree() ? std::optional(node) : std::nullopt;
}

class HierarchyReader {
 public:
  explicit HierarchyReader(Path path) : path_(std::move(path)) {}

  std::vector<LevelNode> read() {
    for (std::size_t i = 0; i < pages_.size(); ++i) read_page(pages_[i]);
    if (const auto fault = link_levels(nodes_))
      throw_unreadable(path_, "found in its hierarchy " + *fault + ", expected an octree");
    return std::move(nodes_);
  }

 private:
  void read_page(const std::string& root) {
    const Path page = path_.parent_path() / "ept-hierarchy" / (root + ".json");
    const Json counts = read_json(page);
    if (!counts.is_object()) throw_unreadable(page, "found no object, expected counts of points by node");
    for (const auto& [name, count] : counts.items()) add(page, name, count);
  }

  void add(const Path& page, const std::string& name, const Json& count) {
    constexpr std::int64_t IS_PAGE = -1;  // instead of a count: more of the hierarchy is there
    std::optional<LevelNode> node = node_of(name);
    if (!node || !count.is_number_integer() || count.get<std::int64_t>() < IS_PAGE)
      throw_unreadable(page, "found the entry '" + name + "' with " + count.dump() +
                                 ", expected a node of an octree and a count");
    if (count.get<std::int64_t>() != IS_PAGE) {
      node->points = count.get<std::uint64_t>();
      nodes_.push_back(*node);
    } else if (seen_.insert(name).second) {
      pages_.push_back(name);
    } else {
      throw_unreadable(page, "found the page '" + name + "' twice, expected each once");
    }
  }

  Path path_;
  std::vector<std::string> pages_{"0-0-0-0"};
  std::set<std::string> seen_{"0-0-0-0"};
  std::vector<LevelNode> nodes_;
};

Levels levels_of_head(const Path& path, const Head& head) {
  return {head.low, head.edge, HierarchyReader(path).read()};
}

/// A node's points, or why there are none.
struct Tile {
  ScanFile file;
  std::vector<std::string> notes;
};

/// A file of a node's points, or of means in its place.
struct TileFile {
  Path path;
  std::uint32_t node = 0;
  std::uint64_t points = 0;
  bool is_means = false;
};

std::vector<unsigned char> bytes_of(const TileFile& file, const TileSchema& schema, bool is_packed) {
  if (is_packed)
    return read_zstandard(file.path, std::min<std::uint64_t>(file.points, UINT32_MAX) * schema.record_bytes);
  ByteReader in(file.path);
  return in.read(in.remaining());
}

std::vector<unsigned char> records_of(const TileFile& file, const TileSchema& schema, bool is_packed) {
  std::vector<unsigned char> records = bytes_of(file, schema, is_packed);
  if (records.size() % schema.record_bytes != 0)
    throw_unreadable(file.path, "found " + std::to_string(records.size()) +
                                    " bytes, expected whole records of " +
                                    std::to_string(schema.record_bytes));
  return records;
}

/// Removes those in whose place means are read.
void remove_replaced(const StandIns& stand_ins, const TileFile& file, const TileSchema& schema,
                     std::vector<unsigned char>& records) {
  const std::size_t stride = schema.record_bytes;
  auto kept = records.begin();
  for (auto record = records.begin(); record != records.end(); record += std::ptrdiff_t(stride)) {
    if (stand_ins.replace(file.node, schema.position(&*record))) continue;
    kept = std::copy_n(record, stride, kept);
  }
  records.erase(kept, records.end());
}

/// `stand_ins`: of scans that have means, else none.
ScanFile read_binary_tile(const TileFile& file, const Head& head, const StandIns* stand_ins,
                          const ReadOptions& options) {
  const TileSchema of_file = file.is_means ? tile_means_schema(*head.binary) : *head.binary;
  std::vector<unsigned char> records = records_of(file, of_file, head.is_packed);
  const std::uint64_t stored = records.size() / of_file.record_bytes;
  if (stand_ins != nullptr && !file.is_means) remove_replaced(*stand_ins, file, of_file, records);
  ScanFile read;
  read.points = points_of_records(records, of_file, options.scans, read.counts);
  read.counts.stored = stored;
  return read;
}

Tile read_tile(const TileFile& file, const Head& head, const StandIns* stand_ins,
               const ReadOptions& options) {
  const Progress none;
  Tile tile;
  try {
    tile.file = head.binary ? read_binary_tile(file, head, stand_ins, options)
                            : read_las(file.path, options, {tile.notes, none});
  } catch (const Error& error) {
    if (options.scans.strict || error.code() != ExitCode::input_unreadable) throw;
    tile.notes.emplace_back(error.what());
    tile.file.counts = {file.points, file.points};
    return tile;
  }
  if (tile.file.counts.stored != file.points) {
    const std::string found = "found " + std::to_string(tile.file.counts.stored) + " points, expected the " +
                              std::to_string(file.points) + " that the hierarchy counts";
    if (options.scans.strict) throw_unreadable(file.path, found);
    tile.notes.push_back(file.path.string() + ": " + found);
  }
  return tile;
}

/// The nodes that are chosen.
std::vector<std::uint32_t> chosen_nodes(const Path& path, const Levels& levels, const ChosenNodes& chosen) {
  std::vector<std::uint32_t> which(levels.nodes.size());
  std::iota(which.begin(), which.end(), 0U);
  if (const auto found = chosen.find(path); found != chosen.end()) which = found->second;
  if (!which.empty() && which.back() >= levels.nodes.size())
    throw_unreadable(path, "found " + std::to_string(levels.nodes.size()) +
                               " nodes in its hierarchy, expected more: it has changed");
  return which;
}

/// How many means stand for a node.
std::uint64_t means_of(const Json& counts, const std::string& name, const Path& page) {
  const Json count = counts.is_object() ? counts.value(name, Json()) : Json();
  if (!count.is_number_unsigned())
    throw_unreadable(page, "found for '" + name + "' " + count.dump() + ", expected a count of means");
  return count.get<std::uint64_t>();
}

Path counts_of_means(const Path& path) { return path.parent_path() / "ept-means" / "counts.json"; }

void count_means(const Path& path, Levels& levels) {
  const Path page = counts_of_means(path);
  const Json counts = read_json(page);
  for (LevelNode& node : levels.nodes)
    if (node.parent != LevelNode::NO_PARENT) node.means = means_of(counts, name_of(node), page);
}

/// The files of nodes that have points, and of means.
std::vector<TileFile> tile_files(const Path& path, const Head& head, const Levels& levels,
                                 const std::vector<std::uint32_t>& nodes, const StandIns* stand_ins) {
  const Path folder = path.parent_path();
  const std::string extension = head.is_packed ? ".zst" : head.binary ? ".bin" : ".laz";
  std::vector<TileFile> files;
  for (const std::uint32_t i : nodes)
    if (const LevelNode& node = levels.nodes[i]; node.points > 0)
      files.push_back({folder / "ept-data" / (name_of(node) + extension), i, node.points});
  if (stand_ins == nullptr || stand_ins->nodes().empty()) return files;
  const Path page = counts_of_means(path);
  const Json counts = read_json(page);
  for (const std::uint32_t i : stand_ins->nodes()) {
    const std::string name = name_of(levels.nodes[i]);
    files.push_back({folder / "ept-means" / (name + extension), i, means_of(counts, name, page), true});
  }
  return files;
}

void add(ScanFile& to, Tile&& tile, const ReadListener& listener) {
  for (std::string& note : tile.notes) listener.notes.push_back(std::move(note));
  if (to.points.crs.empty()) to.points.crs = tile.file.points.crs;
  to.counts += tile.file.counts;
  to.in_degrees = to.in_degrees ? to.in_degrees : tile.file.in_degrees;
  append_points(to.points, std::move(tile.file.points));
}

/// Reads some nodes at a time, each in a thread; all in their order.
void read_nodes(const Path& path, const Head& head, const Levels& levels, const ReadOptions& options,
                const ReadListener& listener, ScanFile& file) {
  const std::vector<std::uint32_t> chosen = chosen_nodes(path, levels, options.nodes);
  std::optional<StandIns> stand_ins;
  if (head.has_means) stand_ins.emplace(levels, chosen);
  const StandIns* const means = stand_ins ? &*stand_ins : nullptr;
  const std::vector<TileFile> files = tile_files(path, head, levels, chosen, means);
  const std::size_t at_once =
      2 * tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  for (std::size_t done = 0; done < files.size(); done += at_once) {
    listener.report(static_cast<double>(done) / static_cast<double>(files.size()));
    const std::span<const TileFile> some =
        std::span(files).subspan(done, std::min(at_once, files.size() - done));
    std::vector<Tile> tiles(some.size());
    tbb::parallel_for(std::size_t{0}, some.size(),
                      [&](std::size_t i) { tiles[i] = read_tile(some[i], head, means, options); });
    for (Tile& tile : tiles) add(file, std::move(tile), listener);
    listener.show(file.points);
  }
}

/// Points of stations that there are none of have unknown ones: all are left out.
void check_stations(Points& points) {
  const bool is_whole = std::all_of(points.station.begin(), points.station.end(),
                                    [&](std::uint16_t station) { return station < points.stations.size(); });
  if (is_whole) return;
  points.station.clear();
  points.stations.clear();
}

}  // namespace

std::vector<Station> read_stations(const Json& stations, const Path& path) {
  std::vector<Station> read;
  for (const Json& entry : stations) {
    const Json name = entry.is_object() ? entry.value("name", Json()) : Json();
    const Json place = entry.is_object() ? entry.value("sensor", Json()) : Json();
    const bool has_place = place.is_array() && place.size() == 3 && place[0].is_number() &&
                           place[1].is_number() && place[2].is_number();
    if (!name.is_string() || !(has_place || place.is_null()))
      throw_unreadable(path,
                       "found among its stations " + entry.dump() + ", expected a name and a sensor's place");
    read.push_back({});
    read.back().name = name.get<std::string>();
    if (has_place)
      read.back().sensor_world = {place[0].get<double>(), place[1].get<double>(), place[2].get<double>()};
  }
  return read;
}

Levels ept_levels(const Path& path) {
  const Head head = read_head(path);
  if (describe_crs(head.crs).is_degrees) return {};
  Levels levels = levels_of_head(path, head);
  if (head.has_means) count_means(path, levels);
  return levels;
}

ScanFile read_ept(const Path& path, const ReadOptions& options, const ReadListener& listener) {
  const Head head = read_head(path);
  const Levels levels = levels_of_head(path, head);
  ScanFile file;
  const Json version = head.json.value("version", Json());
  file.facts = {{"version", "EPT " + (version.is_string() ? version.get<std::string>() : "of no version")}};
  add_level_facts(levels, "EPT", file.facts);
  file.said_box = head.box;
  file.points.crs = head.crs;
  const Json stations = head.json.value("stations", Json::array());
  if (head.binary && !stations.empty()) file.points.stations = read_stations(stations, path);
  file.counts.stored = options.heads_only ? levels.points() : 0;
  if (!options.heads_only) read_nodes(path, head, levels, options, listener, file);
  check_stations(file.points);
  return file;
}

}  // namespace splatray

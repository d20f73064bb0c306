#include "engine/file/scene_file.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <future>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/base/memory.h"
#include "engine/base/utf8.h"
#include "engine/file/checksum.h"
#include "engine/file/old_scene_sections.h"
#include "engine/file/scene_records.h"
#include "engine/file/section_writer.h"
#include "engine/scene/clip.h"
#include "engine/scene/pool/pool_table.h"
#include "engine/scene/scene_check.h"
#include "engine/scene/wide/wide_tree.h"

namespace splatray {

using namespace scene_file;

namespace {

const char* const WIDE_NODES = "wide_nodes";

std::string column_section(std::size_t i) { return "column." + std::to_string(i); }

/// Each value as its record.
template <typename Value>
auto records_of(const std::vector<Value>& values) {
  std::vector<decltype(record_of(values.front()))> records;
  for (const Value& value : values) records.push_back(record_of(value));
  return records;
}

/// Adds a section of names, where there are any.
template <typename Named>
void keep_names(SectionWriter& file, const std::string& section, const std::vector<Named>& named) {
  std::vector<std::string> names;
  for (const Named& one : named) names.push_back(one.name);
  if (!names.empty()) file.keep_strings(section, names);
}

void add_objects(SectionWriter& file, const Scene& scene) {
  file.add("materials", scene.materials);
  file.keep_strings("object_names", scene.object_names);
}

void add_world(SectionWriter& file, const Scene& scene) {
  const WorldRecord world{scene.up, scene.bounds_min_world, scene.bounds_max_world, scene.surface_area_world};
  file.keep("root", std::vector{record_of(scene.root)});
  file.keep("build", std::vector{record_of(scene.build)});
  file.keep("world", std::vector{world});
  if (!scene.lights.empty()) file.keep("lights", records_of(scene.lights));
  if (scene.camera) file.keep("camera", std::vector{record_of(*scene.camera)});
  if (!scene.environment_path.empty()) file.keep_strings("environment", {scene.environment_path});
  if (!scene.crs.empty()) file.keep_strings("crs", {scene.crs});
}

void add_attributes(SectionWriter& file, const Scene& scene) {
  if (!scene.stations.empty()) file.keep("stations", records_of(scene.stations));
  keep_names(file, "station_names", scene.stations);
  keep_names(file, "column_names", scene.columns);
  for (std::size_t i = 0; i < scene.columns.size(); ++i)
    std::visit([&](const auto& values) { file.add(column_section(i), values); }, scene.columns[i].values);
}

/// Header and table, whose checksum is right.
std::vector<char> read_head(SceneInput& input) {
  HeaderStart start{};
  if (input.size() < sizeof MAGIC)
    input.refuse(std::to_string(input.size()) + " bytes", "a scene file starting with SOCT");
  input.read(0, &start, std::min<std::uint64_t>(input.size(), sizeof start));
  if (std::memcmp(start.magic, MAGIC, sizeof MAGIC) != 0)
    input.refuse("another file type", "the letters SOCT at its start");
  if (input.size() < sizeof start)
    input.refuse(std::to_string(input.size()) + " bytes", "a whole header (file truncated)");
  if (start.endianness != ENDIANNESS) input.refuse("a foreign byte order", "little-endian");
  if (start.version < OLDEST_VERSION || start.version > SCENE_FILE_VERSION)
    input.refuse("version " + std::to_string(start.version),
                 "version " + std::to_string(OLDEST_VERSION) + " to " + std::to_string(SCENE_FILE_VERSION));
  if (start.file_bytes != input.size())
    input.refuse(std::to_string(input.size()) + " bytes",
                 std::to_string(start.file_bytes) +
                     (input.size() < start.file_bytes ? " (file truncated)" : " (extra bytes)"));
  if (start.head_bytes < sizeof start || start.head_bytes + sizeof END_MARKER > input.size())
    input.refuse("a header of " + std::to_string(start.head_bytes) + " bytes", "one that fits the file");
  std::vector<char> head(start.head_bytes);
  input.read(0, head.data(), head.size());
  std::memset(head.data() + offsetof(HeaderStart, checksum), 0, sizeof start.checksum);
  if (checksum_of(head.data(), head.size()) != start.checksum)
    input.refuse("another header checksum", "the stored one (file damaged)");
  return head;
}

/// A file's sections by name, whatever its version.
struct Sections {
  SectionTable table;
  std::optional<bool> ellipses;  ///< whether there are some, where the header says so
};

Sections read_sections(SceneInput& input) {
  const std::vector<char> head = read_head(input);
  std::uint32_t version = 0;
  std::memcpy(&version, head.data() + offsetof(HeaderStart, version), sizeof version);
  if (version > LAST_VERSION_WITHOUT_NAMES) return {read_table(input, head), {}};
  OldScene old = read_old_table(input, head);
  return {std::move(old.table), old.ellipses};
}

/// Whether a pool is read into memory: what says where a walk of the octree goes on. A file that someone changes must not lead it in circles.
template <typename Row>
bool leads_walks(const Row& row) {
  return row.length == PoolLength::nodes || row.length == PoolLength::leaf_ends;
}

/// Throws Error (out_of_memory) unless there is room for what is read into memory.
void require_room(SceneInput& input, const SectionReader& sections) {
  std::uint64_t bytes = input.mapping() ? 0 : input.size();
  for_each_pool([&](const auto& row) {
    if (input.mapping() && leads_walks(row)) bytes += sections.find(row.key).bytes;
  });
  require_memory(bytes, "'" + input.path().string() + "'");
}

/// The wide tree, where a file has one.
void read_wide_tree(SceneInput& input, SectionReader& sections, Scene& scene) {
  if (!sections.has(WIDE_NODES)) return;
  scene.wide_nodes = sections.pool<WideNode>(WIDE_NODES);
  if (!has_wide_tree(scene))
    input.refuse("a wide tree of " + std::to_string(scene.wide_nodes.size()) + " nodes for " +
                     std::to_string(scene.data_pool.size()) + " splats",
                 std::to_string(wide_levels(scene.data_pool.size()).nodes));
}

/// The records of a section, none where the file has no such section.
template <typename Record>
std::vector<Record> records_if_any(SectionReader& sections, const std::string& name) {
  return sections.has(name) ? sections.records<Record>(name, Record::LEAST_BYTES) : std::vector<Record>{};
}

/// The one record of a section.
template <typename Record>
Record only_record(SceneInput& input, SectionReader& sections, const std::string& name) {
  const auto records = sections.records<Record>(name, Record::LEAST_BYTES);
  if (records.size() != 1)
    input.refuse("section '" + name + "' of " + std::to_string(records.size()) + " records", "one");
  return records.front();
}

/// The strings of a section that must be there for any.
std::vector<std::string> names_of(SectionReader& sections, const std::string& section, std::size_t count) {
  if (count == 0 && !sections.has(section)) return {};
  std::vector<std::string> names = sections.strings(section, count);
  for (std::string& name : names) name = to_utf8(name);
  return names;
}

void read_objects(SceneInput& input, SectionReader& sections, Scene& scene) {
  const bool old = sections.find("materials").element_bytes == OldMaterialRecord::LEAST_BYTES;
  scene.materials = old ? read_old_materials(input, sections)
                        : sections.records<Material>("materials", MATERIAL_LEAST_BYTES);
  scene.object_names = names_of(sections, "object_names", scene.materials.size());
}

void read_world(SceneInput& input, SectionReader& sections, Scene& scene) {
  const auto world = only_record<WorldRecord>(input, sections, "world");
  scene.root = value_of(only_record<RootRecord>(input, sections, "root"));
  scene.build = value_of(only_record<BuildRecord>(input, sections, "build"));
  scene.build.normal_fields = !scene.field_pool.empty();
  scene.up = world.up;
  scene.bounds_min_world = world.bounds_min;
  scene.bounds_max_world = world.bounds_max;
  scene.surface_area_world = world.surface_area;
  for (const LightRecord& light : records_if_any<LightRecord>(sections, "lights"))
    scene.lights.push_back(value_of(light));
  if (sections.has("camera")) scene.camera = value_of(only_record<CameraRecord>(input, sections, "camera"));
  if (sections.has("environment")) scene.environment_path = sections.strings("environment", 1).front();
  if (sections.has("crs")) scene.crs = to_utf8(sections.strings("crs", 1).front());
}

void read_stations(SceneInput& input, SectionReader& sections, Scene& scene) {
  for (const StationRecord& record : records_if_any<StationRecord>(sections, "stations")) {
    if (record.has_sensor > 1 || record.sensor_found > 1) input.refuse("a station's flag above 1", "0 or 1");
    scene.stations.push_back(value_of(record));
  }
  const std::vector<std::string> names = names_of(sections, "station_names", scene.stations.size());
  for (std::size_t i = 0; i < names.size(); ++i) scene.stations[i].name = names[i];
}

Column::Values read_column(SceneInput& input, SectionReader& sections, const std::string& section) {
  switch (sections.find(section).type) {
    case ElementType::uint8:
      return sections.pool<std::uint8_t>(section);
    case ElementType::uint16:
      return sections.pool<std::uint16_t>(section);
    case ElementType::float32:
      return sections.pool<float>(section);
    case ElementType::float64:
      return sections.pool<double>(section);
    default:
      input.refuse("section '" + section + "' of a type that columns are not of", "1 to 4");
  }
}

void read_columns(SceneInput& input, SectionReader& sections, Scene& scene) {
  while (scene.columns.size() < COLUMNS_MOST && sections.has(column_section(scene.columns.size())))
    scene.columns.push_back({"", read_column(input, sections, column_section(scene.columns.size()))});
  const std::vector<std::string> names = names_of(sections, "column_names", scene.columns.size());
  for (std::size_t i = 0; i < names.size(); ++i) scene.columns[i].name = names[i];
}

}  // namespace

void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress) {
  assert(!find_scene_defect(scene));
  SectionWriter file;
  for_each_pool([&](const auto& row) {
    if (!row.optional() || !(scene.*row.pool).empty()) file.add(row.key, scene.*row.pool);
  });
  add_objects(file, scene);
  add_world(file, scene);
  add_attributes(file, scene);
  if (!scene.wide_nodes.empty()) file.add(WIDE_NODES, scene.wide_nodes, SECTION_OPTIONAL);
  file.write(SCENE_FILE_VERSION, path, progress);
}

Scene read_scene(const std::filesystem::path& path, const Progress& progress) {
  SceneInput input(path, progress);
  Sections file = read_sections(input);
  SectionReader sections(input, std::move(file.table));
  require_room(input, sections);
  Scene scene;
  const std::uint64_t leaves = sections.find("slab_pool").count();
  std::future<std::optional<SceneDefect>> tree_defect;
  for_each_pool([&](const auto& row) {
    using Value = typename std::remove_reference_t<decltype(scene.*row.pool)>::value_type;
    if (leads_walks(row))
      scene.*row.pool = sections.array<Value>(row.key);
    else if (!row.optional() || sections.has(row.key))
      scene.*row.pool = sections.pool<Value>(row.key);
    // Beside the reading of all else, which takes longer.
    if (!tree_defect.valid())
      tree_defect = std::async(std::launch::async, find_tree_defect,
                               std::span<const std::uint32_t>(scene.node_pool), leaves);
  });
  read_objects(input, sections, scene);
  read_world(input, sections, scene);
  read_stations(input, sections, scene);
  read_columns(input, sections, scene);
  read_wide_tree(input, sections, scene);
  sections.end();
  if (const auto defect = tree_defect.get()) input.refuse(defect->found, defect->expected);
  if (const auto defect = find_content_defect(scene)) input.refuse(defect->found, defect->expected);
  const bool ellipses = clip_content(scene.clip_pool).ellipses;
  if (file.ellipses.value_or(ellipses) != ellipses)
    input.refuse(ellipses ? "ellipses" : "no ellipses", "those that the header tells of");
  if (input.mapping()) input.mapping()->require_whole();
  scene.mapping = input.mapping();
  return scene;
}

}  // namespace splatray

#include "engine/file/scene_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <fstream>
#include <future>
#include <span>
#include <type_traits>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/utf8.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"
#include "engine/file/scene_file_header.h"
#include "engine/scene/pool_table.h"
#include "engine/scene/scene_check.h"
#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"

namespace splatray {

using namespace scene_file;

namespace {

constexpr std::uint64_t PIECE_BYTES = 1ULL << 24;  ///< read or written between two looks at whether to go on
constexpr std::uint64_t MOST_ELEMENTS = 1ULL << 40;  ///< more cannot be real, and would overflow sizes

/// The bytes of the lights' section, `record_bytes` of each.
std::vector<char> light_bytes(const std::vector<SceneLight>& lights, std::uint32_t record_bytes) {
  std::vector<char> bytes;
  for (const SceneLight& light : lights) {
    const AimedLightRecord record{
        {{light.kind, 0, light.position, light.power, 0}, light.size, light.edge_u, light.edge_v},
        light.spot_axis,
        light.spot_inner,
        light.spot_outer,
        light.range};
    const char* begin = reinterpret_cast<const char*>(&record);
    bytes.insert(bytes.end(), begin, begin + record_bytes);
  }
  return bytes;
}

CameraRecord camera_record(const Camera& camera) {
  return {camera.eye, camera.target, camera.up, camera.fov_y_deg, camera.ortho_height};
}

/// The bytes of the stations' section, `record_bytes` of each.
std::vector<char> station_bytes(const std::vector<Station>& stations, std::uint32_t record_bytes) {
  std::vector<char> bytes;
  for (const Station& station : stations) {
    const MeasuredStationRecord record{{station.sensor_world.value_or(glm::dvec3(0.0)),
                                        station.sensor_world ? 1U : 0U, station.rows, station.columns, 0},
                                       station.noise_world,
                                       station.step_world};
    const char* begin = reinterpret_cast<const char*>(&record);
    bytes.insert(bytes.end(), begin, begin + record_bytes);
  }
  return bytes;
}

bool is_measured(const Scene& scene) {
  return !scene.crs.empty() ||
         std::any_of(scene.stations.begin(), scene.stations.end(), [](const Station& station) {
           return station.noise_world > 0.0 || station.step_world > 0.0;
         });
}

std::string joined_strings(const Scene& scene) {
  std::string strings;
  const auto add = [&strings](const std::string& text) { (strings += text.c_str()) += '\0'; };
  for (const std::string& name : scene.object_names) add(name);
  add(scene.environment_path);
  for (const Station& station : scene.stations) add(station.name);
  for (const Column& column : scene.columns) add(column.name);
  if (is_measured(scene)) add(scene.crs);
  return strings;
}

/// The least version that knows all that the scene has.
std::uint32_t version_of(const Scene& scene) {
  const auto any = [&scene](auto has) { return std::any_of(scene.lights.begin(), scene.lights.end(), has); };
  const bool aimed = any([](const SceneLight& light) { return is_spot(light) || light.range > 0.0; });
  if (is_measured(scene)) return SCENE_FILE_VERSION;
  if (any_leans(scene.field_pool)) return LEANING_SCENE_FILE_VERSION;
  if (aimed || texture_features(scene.columns) != 0) return TEXTURED_SCENE_FILE_VERSION;
  return any(is_sized) ? SIZED_SCENE_FILE_VERSION : PLAIN_SCENE_FILE_VERSION;
}

/// The header of a scene, all but sections, file size and checksums.
Header describe(const Scene& scene, std::size_t string_bytes) {
  const BuildParams& build = scene.build;
  Header header{};
  std::memcpy(header.magic, MAGIC, sizeof MAGIC);
  header.version = version_of(scene);
  header.endianness = ENDIANNESS;
  header.header_size = sizeof(Header);
  header.splats = scene.data_pool.size();
  header.references = scene.reference_pool.size();
  header.nodes = scene.node_pool.size();
  header.leaves = scene.begin_end.size() - 1;
  header.objects = static_cast<std::uint32_t>(scene.materials.size());
  header.lights = static_cast<std::uint32_t>(scene.lights.size());
  header.attributes = attributes_of(scene);
  header.has_camera = scene.camera ? 1 : 0;
  header.string_bytes = string_bytes;
  header.root = scene.root;
  header.leaf_size = build.leaf_size;
  header.insertion = static_cast<std::uint32_t>(build.insertion);
  header.probes = build.probes;
  header.radius_rule = static_cast<std::uint32_t>(build.radius_rule);
  header.radius_scale = build.radius_scale;
  header.samples = build.samples;
  header.seed = build.seed;
  header.up = scene.up;
  header.bounds_min = scene.bounds_min_world;
  header.bounds_max = scene.bounds_max_world;
  header.surface_area = scene.surface_area_world;
  header.stations = static_cast<std::uint32_t>(scene.stations.size());
  header.surfaces = static_cast<std::uint32_t>(scene.surfaces.size());
  for (std::size_t i = 0; i < scene.columns.size(); ++i)
    header.column_types[i] = static_cast<std::uint8_t>(scene.columns[i].values.index() + 1);
  header.section_count = SECTION_COUNT;
  header.section_entry_size = sizeof(SectionEntry);
  return header;
}

/// A scene from its header alone; the sections are still to be read.
Scene described_scene(const Header& header) {
  Scene scene;
  scene.root = header.root;
  scene.build = {header.leaf_size,    Insertion{header.insertion},
                 header.probes,       RadiusRule{header.radius_rule},
                 header.radius_scale, header.samples,
                 header.seed,         false};
  scene.up = header.up;
  scene.bounds_min_world = header.bounds_min;
  scene.bounds_max_world = header.bounds_max;
  scene.surface_area_world = header.surface_area;
  return scene;
}

void report(const Progress& progress, const char* stage, std::uint64_t done, std::uint64_t all) {
  if (progress && !progress(stage, static_cast<double>(done) / static_cast<double>(all)))
    throw Error(ExitCode::interrupted, std::string(stage) + " the scene file was interrupted");
}

/// A scene file being read front to back, every byte checked.
class Reader {
 public:
  Reader(const std::filesystem::path& path, const Progress& progress) : path_(path), progress_(progress) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) refuse("no such file", "a scene file");
    if (!std::filesystem::is_regular_file(path, error)) refuse("a folder or device", "a scene file");
    note_input(path);
    file_.open(path, std::ios::binary);
    if (!file_) refuse("a file that cannot be opened", "a readable one");
    size_ = std::filesystem::file_size(path);
    read_header();
    require_memory(size_, "'" + path.string() + "'");
  }

  [[nodiscard]] const Header& header() const { return header_; }

  template <typename T>
  std::vector<T> section(std::uint32_t id) {
    const SectionEntry& entry = header_.sections[id];
    skip_gap(entry.offset);
    std::vector<T> elements(entry.size / sizeof(T));
    read(elements.data(), entry.size);
    if (XXH3_64bits(elements.data(), entry.size) != entry.checksum)
      refuse("section " + std::to_string(entry.id) + " with another checksum",
             "the one in the header (file damaged)");
    return elements;
  }

  void end() {
    char marker[sizeof END_MARKER];
    skip_gap(size_ - sizeof marker);
    read(marker, sizeof marker);
    if (std::memcmp(marker, END_MARKER, sizeof marker) != 0) refuse("another end", "the end marker SOCT.END");
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw Error(ExitCode::input_unreadable,
                "cannot read scene '" + path_.string() + "': found " + found + ", expected " + expected);
  }

 private:
  void read(void* target, std::uint64_t bytes) {
    for (std::uint64_t done = 0; done < bytes;) {
      const std::uint64_t piece = std::min(bytes - done, PIECE_BYTES);
      if (!file_.read(static_cast<char*>(target) + done, static_cast<std::streamsize>(piece)))
        refuse("its end or a read error at byte " + std::to_string(position_),
               std::to_string(bytes - done) + " more bytes");
      done += piece;
      position_ += piece;
      report(progress_, "reading", position_, size_);
    }
  }

  void skip_gap(std::uint64_t offset) {
    char gap[ALIGNMENT];
    const std::uint64_t bytes = offset - position_;
    read(gap, bytes);
    for (const char byte : std::span(gap, bytes))
      if (byte != 0) refuse("a filled gap before byte " + std::to_string(offset), "zeros (file damaged)");
  }

  void read_header() {
    if (size_ < sizeof MAGIC) refuse(std::to_string(size_) + " bytes", "a scene file starting with SOCT");
    file_.read(reinterpret_cast<char*>(&header_),
               sizeof header_);  // fewer bytes than a header are refused below
    if (std::memcmp(header_.magic, MAGIC, sizeof MAGIC) != 0)
      refuse("another file type", "the letters SOCT at its start");
    if (size_ < sizeof header_)
      refuse(std::to_string(size_) + " bytes",
             "a header of " + std::to_string(HEADER_BYTES) + " (file truncated)");
    position_ = sizeof header_;
    if (header_.endianness != ENDIANNESS) refuse("a foreign byte order", "little-endian");
    if (header_.version < PLAIN_SCENE_FILE_VERSION || header_.version > SCENE_FILE_VERSION)
      refuse("version " + std::to_string(header_.version), "version " +
                                                               std::to_string(PLAIN_SCENE_FILE_VERSION) +
                                                               " to " + std::to_string(SCENE_FILE_VERSION));
    if (header_.file_size != size_)
      refuse(std::to_string(size_) + " bytes",
             std::to_string(header_.file_size) +
                 (size_ < header_.file_size ? " (file truncated)" : " (extra bytes)"));
    if (header_checksum(header_) != header_.checksum)
      refuse("another header checksum", "the stored one (file damaged)");
    check_table();
  }

  void check_table() const {
    Header expected = header_;
    for (const std::uint64_t count :
         {header_.nodes, header_.leaves, header_.references, header_.splats, header_.string_bytes})
      if (count > MOST_ELEMENTS) refuse("a count of " + std::to_string(count), "one that fits the file");
    if (header_.has_camera > 1) refuse("a flag above 1", "0 or 1");
    const std::uint32_t known = attributes_of({}, true);
    if ((header_.attributes & ~known) != 0)
      refuse("attributes " + std::to_string(header_.attributes), "bits of " + std::to_string(known));
    for (const std::uint8_t type : header_.column_types)
      if (type >= std::size(COLUMN_BYTES))
        refuse("a column of type " + std::to_string(type),
               "0 to " + std::to_string(std::size(COLUMN_BYTES) - 1));
    lay_out(expected);
    expected.header_size = sizeof(Header);
    expected.section_count = SECTION_COUNT;
    expected.section_entry_size = sizeof(SectionEntry);
    if (std::memcmp(&expected, &header_, sizeof expected) != 0)
      refuse("a section table that contradicts the counts", "the one that follows from them");
  }

  std::filesystem::path path_;
  const Progress& progress_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
  Header header_{};
};

void read_lights(Reader& reader, Scene& scene) {
  const std::uint32_t record_bytes = light_record_bytes(reader.header());
  const std::vector<char> bytes = reader.section<char>(LIGHTS);
  for (std::size_t at = 0; at < bytes.size(); at += record_bytes) {
    AimedLightRecord record{};
    std::memcpy(&record, bytes.data() + at, record_bytes);
    const auto& [sized, spot_axis, spot_inner, spot_outer, range] = record;
    const LightRecord& light = sized.light;
    scene.lights.push_back({light.kind, light.position, light.power, sized.size, sized.edge_u, sized.edge_v,
                            spot_axis, spot_inner, spot_outer, range});
  }
}

void read_stations(Reader& reader, Scene& scene) {
  const std::uint32_t record_bytes = station_record_bytes(reader.header());
  const std::vector<char> bytes = reader.section<char>(STATIONS);
  for (std::size_t at = 0; at < bytes.size(); at += record_bytes) {
    MeasuredStationRecord measured{};
    std::memcpy(&measured, bytes.data() + at, record_bytes);
    const StationRecord& record = measured.station;
    if (!(measured.noise_world >= 0.0 && measured.noise_world < INFINITY && measured.step_world >= 0.0 &&
          measured.step_world < INFINITY))
      reader.refuse("a station's noise or step that is no length", "finite numbers >= 0");
    if (record.has_sensor > 1) reader.refuse("a station's flag above 1", "0 or 1");
    Station& station = scene.stations.emplace_back();
    if (record.has_sensor == 1) station.sensor_world = record.sensor;
    station.rows = record.rows;
    station.columns = record.columns;
    station.noise_world = measured.noise_world;
    station.step_world = measured.step_world;
  }
}

/// Names of what has been read, and of columns, whose values come last.
void read_strings(Reader& reader, Scene& scene) {
  const Header& header = reader.header();
  for (const std::uint8_t type : header.column_types)
    if (type != 0) scene.columns.emplace_back();
  const std::vector<char> bytes = reader.section<char>(STRINGS);
  if (bytes.empty() || bytes.back() != '\0') reader.refuse("names without an end", "a zero byte after each");
  std::vector<std::string> strings;
  for (const char* p = bytes.data(); p != bytes.data() + bytes.size(); p += strings.back().size() + 1)
    strings.emplace_back(p);
  const std::size_t expected =
      header.objects + 1ULL + scene.stations.size() + scene.columns.size() + (is_measured(header) ? 1U : 0U);
  if (strings.size() != expected)
    reader.refuse(
        std::to_string(strings.size()) + " names",
        std::to_string(expected) + ", of objects, environment, stations and columns, and of the system");
  auto next = strings.begin();
  for (std::uint32_t i = 0; i < header.objects; ++i) scene.object_names.push_back(to_utf8(*next++));
  scene.environment_path = std::move(*next++);
  for (Station& station : scene.stations) station.name = to_utf8(*next++);
  for (Column& column : scene.columns) column.name = to_utf8(*next++);
  if (is_measured(header)) scene.crs = to_utf8(*next++);
}

void read_columns(Reader& reader, Scene& scene) {
  const auto& types = reader.header().column_types;
  const auto last = std::find(std::begin(types), std::end(types), 0) - std::begin(types);
  if (static_cast<std::size_t>(last) != scene.columns.size())
    reader.refuse("a column behind a missing one", "columns without a gap");
  for (std::uint32_t i = 0; i < scene.columns.size(); ++i) {
    Column::Values& values = scene.columns[i].values;
    if (types[i] == 1) values = reader.section<std::uint8_t>(COLUMNS + i);
    if (types[i] == 2) values = reader.section<std::uint16_t>(COLUMNS + i);
    if (types[i] == 3) values = reader.section<float>(COLUMNS + i);
    if (types[i] == 4) values = reader.section<double>(COLUMNS + i);
  }
}

void write_bytes(AtomicFile& file, const Header& header,
                 const std::array<const void*, SECTION_COUNT>& contents, const Progress& progress) {
  constexpr char ZEROS[ALIGNMENT] = {};
  std::uint64_t position = sizeof header;
  file.write(&header, sizeof header);
  for (std::uint32_t i = 0; i < SECTION_COUNT; ++i) {
    const SectionEntry& entry = header.sections[i];
    file.write(ZEROS, entry.offset - position);
    for (std::uint64_t done = 0; done < entry.size; done += PIECE_BYTES) {
      report(progress, "writing", entry.offset + done, header.file_size);
      file.write(static_cast<const char*>(contents[i]) + done, std::min(entry.size - done, PIECE_BYTES));
    }
    position = entry.offset + entry.size;
  }
  file.write(ZEROS, header.file_size - sizeof END_MARKER - position);
  file.write(END_MARKER, sizeof END_MARKER);
}

}  // namespace

void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress) {
  assert(!find_scene_defect(scene));
  const std::string strings = joined_strings(scene);
  Header header = describe(scene, strings.size());
  lay_out(header);
  const std::vector<char> lights = light_bytes(scene.lights, light_record_bytes(header));
  const std::vector<char> stations = station_bytes(scene.stations, station_record_bytes(header));
  const CameraRecord camera = camera_record(scene.camera.value_or(Camera{}));
  std::array<const void*, SECTION_COUNT> contents{};
  std::size_t section = 0;
  for_each_pool([&](const auto& row) { contents[section++] = (scene.*row.pool).data(); });
  contents[MATERIALS] = scene.materials.data();
  contents[LIGHTS] = lights.data();
  contents[CAMERA] = scene.camera ? &camera : nullptr;
  contents[STATIONS] = stations.data();
  contents[STRINGS] = strings.data();
  contents[SURFACES] = scene.surfaces.data();
  section = COLUMNS;
  for (const Column& column : scene.columns)
    std::visit([&](const auto& values) { contents[section++] = values.data(); }, column.values);
  for (std::uint32_t i = 0; i < SECTION_COUNT; ++i)
    header.sections[i].checksum = XXH3_64bits(contents[i], header.sections[i].size);
  header.checksum = header_checksum(header);

  AtomicFile file(path);
  write_bytes(file, header, contents, progress);
  file.commit();
}

Scene read_scene(const std::filesystem::path& path, const Progress& progress) {
  Reader reader(path, progress);
  Scene scene = described_scene(reader.header());
  std::future<std::optional<SceneDefect>> tree_defect;
  std::uint32_t section = 0;
  for_each_pool([&](const auto& row) {
    using Value = typename std::remove_reference_t<decltype(scene.*row.pool)>::value_type;
    scene.*row.pool = reader.section<Value>(section++);
    // Beside the reading of all else, which takes longer.
    if (!tree_defect.valid())
      tree_defect = std::async(std::launch::async, find_tree_defect,
                               std::span<const std::uint32_t>(scene.node_pool), reader.header().leaves);
  });
  scene.build.normal_fields = !scene.field_pool.empty();
  scene.materials = reader.section<Material>(MATERIALS);
  read_lights(reader, scene);
  for (const auto& [eye, target, up, fov_y_deg, ortho_height] : reader.section<CameraRecord>(CAMERA))
    scene.camera = Camera{eye, target, up, fov_y_deg, ortho_height};
  read_stations(reader, scene);
  read_strings(reader, scene);
  scene.surfaces = reader.section<Surface>(SURFACES);
  read_columns(reader, scene);
  reader.end();
  if (const auto defect = tree_defect.get()) reader.refuse(defect->found, defect->expected);
  if (const auto defect = find_content_defect(scene)) reader.refuse(defect->found, defect->expected);
  if (attributes_of(scene) != reader.header().attributes)
    reader.refuse("attributes " + std::to_string(reader.header().attributes),
                  std::to_string(attributes_of(scene)) + ", as there are or are no ellipses");
  return scene;
}

}  // namespace splatray

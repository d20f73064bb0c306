#include "engine/file/old_scene_sections.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "engine/file/checksum.h"
#include "engine/scene/phong.h"

namespace splatray::scene_file {
namespace {

constexpr std::uint64_t MOST_ELEMENTS = 1ULL << 40;  ///< more cannot be real, and would overflow sizes
constexpr std::size_t OLD_COLUMNS = 32, OLD_POOLS = 8;
constexpr std::size_t STRINGS = OLD_POOLS + 4, COLUMNS = OLD_POOLS + 6, SECTIONS = COLUMNS + OLD_COLUMNS;
constexpr std::uint32_t KNOWN_ATTRIBUTES = 7, ELLIPSES = 256;

struct OldEntry {
  std::uint32_t id, element_bytes;
  std::uint64_t offset, bytes, checksum;
};

struct OldHeader {
  HeaderStart start;
  std::uint64_t splats, references, nodes, leaves;
  std::uint32_t objects, lights, attributes, has_camera;
  std::uint64_t string_bytes;
  char root[32], build[40], world[80];
  std::uint32_t stations, surfaces;
  std::uint8_t column_types[OLD_COLUMNS];
  std::uint32_t section_count, entry_bytes;
  std::array<OldEntry, SECTIONS> sections;
};
static_assert(sizeof(OldHeader) == 1760 && offsetof(OldHeader, root) == 88 &&
              offsetof(OldHeader, world) == 160);

/// What the counts say of a section.
struct Shape {
  std::string name;
  ElementType type;
  std::uint32_t element_bytes;
  std::uint64_t count;
};

std::vector<Shape> shapes_of(const OldHeader& header) {
  const std::uint32_t version = header.start.version;
  const auto optional = [&](std::uint32_t bit) { return (header.attributes & bit) != 0 ? header.splats : 0; };
  std::vector<Shape> shapes = {{"node_pool", ElementType::uint32, 4, header.nodes},
                               {"begin_end", ElementType::uint32, 4, header.leaves + 1},
                               {"slab_pool", ElementType::uint32, 4, header.leaves},
                               {"reference_pool", ElementType::uint32, 4, header.references},
                               {"data_pool", ElementType::uvec4, 16, header.splats},
                               {"color_pool", ElementType::uint32, 4, optional(1)},
                               {"field_pool", ElementType::uint32, 4, optional(2)},
                               {"clip_pool", ElementType::uint32, 4, optional(4)},
                               {"materials", ElementType::record, 48, header.objects},
                               {"lights", ElementType::record,
                                version >= 12   ? 152U
                                : version >= 11 ? 104U
                                                : 48U,
                                header.lights},
                               {"camera", ElementType::record, 88, header.has_camera},
                               {"stations", ElementType::record, version >= 14 ? 56U : 40U, header.stations},
                               {"strings", ElementType::text, 1, header.string_bytes},
                               {"surfaces", ElementType::record, 80, header.surfaces}};
  for (std::size_t i = 0; i < OLD_COLUMNS; ++i) {
    const std::uint32_t type = header.column_types[i];  // ElementType has the same numbers
    shapes.push_back({"column." + std::to_string(i), ElementType{type}, ELEMENT_BYTES[type],
                      type == 0 ? 0 : header.splats});
  }
  return shapes;
}

void require_counts(const SceneInput& input, const OldHeader& header) {
  for (const std::uint64_t count :
       {header.nodes, header.leaves, header.references, header.splats, header.string_bytes})
    if (count > MOST_ELEMENTS) input.refuse("a count of " + std::to_string(count), "one that fits the file");
  if (header.has_camera > 1) input.refuse("a flag above 1", "0 or 1");
  const bool empty_pools = header.splats == 0 && (header.attributes & KNOWN_ATTRIBUTES) != 0;
  if ((header.attributes & ~(KNOWN_ATTRIBUTES | ELLIPSES)) != 0 || empty_pools)
    input.refuse("attributes " + std::to_string(header.attributes), "bits of the pools that there are");
  bool last = false;
  for (const std::uint8_t type : header.column_types) {
    if (type > static_cast<std::uint32_t>(ElementType::float64))
      input.refuse("a column of type " + std::to_string(type), "0 to 4");
    if (last && type != 0) input.refuse("a column behind a missing one", "columns without a gap");
    last = type == 0;
  }
}

/// Refuses a table that is not what follows from the counts.
void require_table(SceneInput& input, const OldHeader& header, const std::vector<Shape>& shapes) {
  OldHeader expected = header;
  expected.section_count = SECTIONS;
  expected.entry_bytes = sizeof(OldEntry);
  std::uint64_t end = sizeof header;
  for (std::uint32_t i = 0; i < SECTIONS; ++i) {
    const auto& [name, type, element_bytes, count] = shapes[i];
    OldEntry& entry = expected.sections[i];
    entry = {i + 1, element_bytes, align(end), count * element_bytes, entry.checksum};
    end = entry.offset + entry.bytes;
  }
  expected.start.file_bytes = align(end) + sizeof END_MARKER;
  if (std::memcmp(&expected, &header, sizeof expected) != 0)
    input.refuse("a section table that contradicts the counts", "the one that follows from them");
  std::vector<Span> spans;
  for (const OldEntry& entry : header.sections) spans.push_back({entry.offset, entry.bytes});
  require_layout(input, sizeof header, spans);
}

/// A section within bytes that have been checked.
Section part(const std::vector<char>& bytes, std::uint64_t begin, std::uint64_t size,
             std::uint64_t file_offset, ElementType type, std::uint32_t element_bytes) {
  return {type, element_bytes, false, file_offset + begin, size, checksum_of(bytes.data() + begin, size)};
}

/// The strings as sections of their own.
void divide_strings(SceneInput& input, const OldHeader& header, std::size_t columns, SectionTable& table) {
  const OldEntry& entry = header.sections[STRINGS];
  std::vector<char> bytes(entry.bytes);
  input.read(entry.offset, bytes.data(), bytes.size());
  if (checksum_of(bytes.data(), bytes.size()) != entry.checksum)
    input.refuse("strings with another checksum", "the one in the header (file damaged)");
  const bool has_crs = header.start.version >= 14;
  const std::uint64_t expected = header.objects + 1ULL + header.stations + columns + (has_crs ? 1 : 0);
  const auto found = static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\0'));
  if (found != expected || bytes.back() != '\0')
    input.refuse(
        std::to_string(found) + " names",
        std::to_string(expected) +
            ", of objects, environment, stations and columns, and of the system, a zero byte after each");
  auto next = bytes.begin();
  const auto add = [&](const char* name, std::uint64_t count) {
    const auto begin = next;
    for (; count > 0; --count) next = std::find(next, bytes.end(), '\0') + 1;
    table[name] = part(bytes, static_cast<std::uint64_t>(begin - bytes.begin()),
                       static_cast<std::uint64_t>(next - begin), entry.offset, ElementType::text, 1);
  };
  add("object_names", header.objects);
  add("environment", 1);
  add("station_names", header.stations);
  add("column_names", columns);
  if (has_crs) add("crs", 1);
}

}  // namespace

std::vector<Material> read_old_materials(SceneInput& input, SectionReader& sections) {
  const auto records = sections.records<OldMaterialRecord>("materials", OldMaterialRecord::LEAST_BYTES);
  std::vector<Material> materials;
  if (sections.has("surfaces")) materials = sections.records<Material>("surfaces", 80);
  const bool follow = materials.empty();
  if (follow) materials.resize(records.size());
  if (materials.size() != records.size())
    input.refuse(std::to_string(materials.size()) + " surfaces",
                 "none or the " + std::to_string(records.size()) + " of the objects");
  for (std::size_t i = 0; i < records.size(); ++i) {
    const OldMaterialRecord& record = records[i];
    materials[i].ior = record.ior;
    materials[i].flags = record.flags;
    materials[i].mask_bit = record.mask_bit;
    materials[i].phong = {
        record.diffuse, record.specular, record.tint, record.shininess, record.mirror, 0, 0, 0};
    if (follow) follow_phong(materials[i]);
  }
  return materials;
}

OldScene read_old_table(SceneInput& input, const std::vector<char>& head) {
  OldHeader header;
  if (head.size() != sizeof header)
    input.refuse("a header of " + std::to_string(head.size()) + " bytes", std::to_string(sizeof header));
  std::memcpy(&header, head.data(), sizeof header);
  require_counts(input, header);
  const std::vector<Shape> shapes = shapes_of(header);
  require_table(input, header, shapes);

  OldScene old{{}, (header.attributes & ELLIPSES) != 0};
  const auto columns = static_cast<std::size_t>(std::count_if(
      std::begin(header.column_types), std::end(header.column_types), [](auto type) { return type != 0; }));
  for (std::size_t i = 0; i < COLUMNS + columns; ++i) {
    const OldEntry& entry = header.sections[i];
    if (i != STRINGS)
      old.table[shapes[i].name] = {shapes[i].type, entry.element_bytes, false,
                                   entry.offset,   entry.bytes,         entry.checksum};
  }
  if (header.has_camera == 0) old.table.erase("camera");
  divide_strings(input, header, columns, old.table);
  const auto add_part = [&](const char* name, std::size_t begin, std::uint32_t bytes) {
    old.table[name] = part(head, begin, bytes, 0, ElementType::record, bytes);
  };
  add_part("root", offsetof(OldHeader, root), sizeof header.root);
  add_part("build", offsetof(OldHeader, build), sizeof header.build);
  add_part("world", offsetof(OldHeader, world), sizeof header.world);
  return old;
}

}  // namespace splatray::scene_file

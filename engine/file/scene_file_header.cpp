#include "engine/file/scene_file_header.h"

#include <array>
#include <type_traits>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "engine/scene/clip.h"

namespace splatray::scene_file {
namespace {

[[nodiscard]] inline std::uint64_t align(std::uint64_t offset) {
  return (offset + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

/// Elements of a section, and the bytes of each, by the header's counts.
struct SectionShape {
  std::uint64_t count;
  std::uint32_t element_bytes;
};

std::array<SectionShape, SECTION_COUNT> section_shapes(const Header& header) {
  std::array<SectionShape, SECTION_COUNT> shapes{};
  const std::uint64_t lengths[] = {header.nodes, header.leaves + 1, header.leaves, header.references,
                                   header.splats};
  std::size_t section = 0;
  std::uint32_t optional_bit = 1;
  for_each_pool([&](const auto& row) {
    const bool absent = row.optional() && (header.attributes & optional_bit) == 0;
    if (row.optional()) optional_bit <<= 1;
    shapes[section++] = {absent ? 0 : lengths[static_cast<std::size_t>(row.length)],
                         static_cast<std::uint32_t>(element_bytes(row))};
  });
  shapes[MATERIALS] = {header.objects, sizeof(Material)};
  shapes[LIGHTS] = {header.lights, light_record_bytes(header)};
  shapes[CAMERA] = {header.has_camera, sizeof(CameraRecord)};
  shapes[STATIONS] = {header.stations, station_record_bytes(header)};
  shapes[STRINGS] = {header.string_bytes, 1};
  shapes[SURFACES] = {header.surfaces, sizeof(Surface)};
  for (std::size_t i = 0; i < COLUMNS_MOST; ++i)
    shapes[COLUMNS + i] = {header.column_types[i] == 0 ? 0 : header.splats,
                           COLUMN_BYTES[header.column_types[i]]};
  return shapes;
}

}  // namespace

void lay_out(Header& header) {
  const auto shapes = section_shapes(header);
  std::uint64_t end = sizeof(Header);
  for (std::uint32_t i = 0; i < SECTION_COUNT; ++i) {
    SectionEntry& entry = header.sections[i];
    const auto [count, element_bytes] = shapes[i];
    entry = {i + 1, element_bytes, align(end), count * element_bytes, entry.checksum};
    end = entry.offset + entry.size;
  }
  header.file_size = align(end) + sizeof(END_MARKER);
}

std::uint32_t attributes_of(const Scene& scene, bool all) {
  std::uint32_t bits = all || clip_content(scene.clip_pool).ellipses ? ELLIPSES : 0;
  std::uint32_t bit = 1;
  for_each_pool([&](const auto& row) {
    if (!row.optional()) return;
    if (all || !(scene.*row.pool).empty()) bits |= bit;
    bit <<= 1;
  });
  return bits;
}

std::uint64_t header_checksum(Header header) {
  header.checksum = 0;
  return XXH3_64bits(&header, sizeof header);
}

}  // namespace splatray::scene_file

#include "preprocess/write/point_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "engine/base/srgb.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/base/splat_marks.h"

namespace splatray {
namespace {

/// The radius of a splat as a file has it: squared radii are rounded up to 9 bits of mantissa when they are packed, so one that
/// is a quarter of such a step smaller becomes the same.
float file_radius(const SceneSplat& splat, double unit_world) {
  constexpr double BELOW = 1.0 - 0x1p-12;
  return static_cast<float>(std::sqrt(splat.in_root().radius_squared * BELOW) * unit_world);
}

/// A display-encoded channel of a packed colour, 0 to `most`.
double channel_of(std::uint32_t color, int channel, double most) {
  return std::round(static_cast<double>(linear_to_srgb(unpack_color(color)[channel])) * most);
}

/// Whether 8 bits of what displays have give the same colours when they are read.
bool fit_8_bits(std::span<const std::uint32_t> colors) {
  std::array<bool, 256> fits{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    const auto read = srgb_to_linear(static_cast<float>(channel_of(byte, 0, 255.0) / 255.0));
    fits[byte] = (pack_color(glm::vec3(read)) & 0xFFU) == byte;
  }
  return std::all_of(colors.begin(), colors.end(), [&](std::uint32_t color) {
    return fits[color & 0xFFU] && fits[color >> 8 & 0xFFU] && fits[color >> 16 & 0xFFU];
  });
}

/// The name without what ends words in files' headers, and unlike all others.
std::string file_name(std::string name, const std::vector<PointProperty>& taken) {
  constexpr std::string_view ALLOWED = "_.[]-";
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 &&
        ALLOWED.find(letter) == std::string_view::npos)
      letter = '_';
  const auto is_taken = [&](const std::string& one) {
    return one == "x" || one == "y" || one == "z" || one.empty() ||
           std::any_of(taken.begin(), taken.end(), [&](const auto& other) { return other.name == one; });
  };
  while (is_taken(name)) name += '_';
  return name;
}

void add_shape(const Scene& scene, PointTable& table) {
  const std::size_t splats = splat_count(scene);
  const char* const names[] = {"nx", "ny", "nz"};
  for (int axis = 0; axis < 3; ++axis)
    table.properties.push_back({names[axis], ValueType::float32, [&scene, splats, axis](std::size_t i) {
                                  if (i >= splats) return 0.0;
                                  return splat_at(scene, i).normal()[axis];
                                }});
  table.properties.push_back({"radius", ValueType::float32, [&scene, splats](std::size_t i) {
                                if (i >= splats) return 0.0;
                                return double(file_radius(splat_at(scene, i), scene.root.unit_world));
                              }});
}

void add_colors(const Scene& scene, const LeftOut& left_out, PointTable& table) {
  if (scene.color_pool.empty()) return;
  const bool narrow = fit_8_bits(scene.color_pool) && fit_8_bits(left_out.color);
  const double most = narrow ? 255.0 : 65535.0;
  const char* const names[] = {"red", "green", "blue"};
  for (int channel = 0; channel < 3; ++channel)
    table.properties.push_back({names[channel], narrow ? ValueType::uint8 : ValueType::uint16,
                                [&, channel, most, splats = splat_count(scene)](std::size_t i) {
                                  if (i < splats) return channel_of(scene.color_pool[i], channel, most);
                                  return left_out.color.empty()
                                             ? most
                                             : channel_of(left_out.color[i - splats], channel, most);
                                }});
}

void add_columns(const Scene& scene, const LeftOut& left_out, PointTable& table) {
  constexpr ValueType TYPES[] = {ValueType::uint8, ValueType::uint16, ValueType::float32, ValueType::float64};
  const std::size_t splats = splat_count(scene);
  const bool marks = !left_out.position.empty();
  for (const Column& column : scene.columns) {
    const Column* more = find_column(left_out.columns, column.name);
    const bool is_class = column.name == COLUMN_CLASS;
    const bool is_whole = column.values.index() < 2;
    const double absent = is_whole ? 0.0 : std::nan("");
    table.properties.push_back({file_name(column.name, table.properties), TYPES[column.values.index()],
                                [&column, more, is_class, absent, splats](std::size_t i) {
                                  if (i < splats) return column.number(i);
                                  if (is_class) return double{PointTable::LOW_NOISE};
                                  return more == nullptr ? absent : more->number(i - splats);
                                }});
  }
  if (marks && find_column(scene.columns, COLUMN_CLASS) == nullptr)
    table.properties.push_back(
        {file_name(std::string(COLUMN_CLASS), table.properties), ValueType::uint8,
         [splats](std::size_t i) { return i < splats ? 0.0 : double{PointTable::LOW_NOISE}; }});
}

void add_words(const Scene& scene, PointTable& table) {
  const Pool<std::uint32_t>* const pools[] = {&scene.field_pool, &scene.clip_pool};
  for (std::size_t n = 0; n < SPLAT_WORDS.size(); ++n)
    if (const auto& pool = *pools[n]; table.splats_alone && !pool.empty())
      table.words.push_back({std::string(SPLAT_WORDS[n]), ValueType::uint32,
                             [&pool](std::size_t i) { return double(pool[i]); }});
}

}  // namespace

std::size_t bytes_of(ValueType type) {
  constexpr std::size_t BYTES[] = {1, 2, 4, 4, 8};
  return BYTES[static_cast<std::size_t>(type)];
}

void store_value(ValueType type, double number, unsigned char* bytes) {
  switch (type) {
    case ValueType::uint8:
      return store(bytes, static_cast<std::uint8_t>(number));
    case ValueType::uint16:
      return store(bytes, static_cast<std::uint16_t>(number));
    case ValueType::uint32:
      return store(bytes, static_cast<std::uint32_t>(number));
    case ValueType::float32:
      return store(bytes, static_cast<float>(number));
    case ValueType::float64:
      return store(bytes, number);
  }
}

PointTable make_point_table(const Scene& scene, const LeftOut& left_out) {
  const std::size_t splats = splat_count(scene);
  PointTable table{scene, splats + left_out.position.size(), {}, {}, {}};
  table.splats_alone = left_out.position.empty();
  table.position = [&scene, &left_out, splats](std::size_t i) {
    return i < splats ? splat_at(scene, i).center_world() : left_out.position[i - splats];
  };
  add_shape(scene, table);
  add_colors(scene, left_out, table);
  if (scene.materials.size() > 1)
    table.properties.push_back({"object", ValueType::uint16, [&scene, splats](std::size_t i) {
                                  return i < splats ? double(splat_at(scene, i).object()) : 0.0;
                                }});
  add_columns(scene, left_out, table);
  add_words(scene, table);
  return table;
}

}  // namespace splatray

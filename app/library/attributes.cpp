#include "app/library/attributes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "app/library/palette.h"
#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"
#include "engine/base/rank.h"
#include "engine/base/srgb.h"
#include "engine/image/view.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

/// Shares of all values at the ends of a range.
constexpr double RANGE_FIRST = 0.02, RANGE_LAST = 0.98;
constexpr std::size_t RAMP_STEPS = 256;
constexpr glm::vec3 UNKNOWN_COLOR(0.35F);  // beside signed_color, which has no such grey
constexpr double INTENSITY_GAMMA = 2.2;
/// Display values of its ends: on black and on white no shade is seen.
constexpr const char* HEIGHT_AND_INTENSITY = "height+intensity";
/// Factors on a height's colour, of black and white intensity.
constexpr float RELIEF_DARK = 0.2F, RELIEF_BRIGHT = 1.5F;
constexpr double INTENSITY_DARK = 0.25, INTENSITY_BRIGHT = 0.92;

std::uint32_t color_of(const glm::vec3& encoded) {
  return pack_color({srgb_to_linear(encoded.x), srgb_to_linear(encoded.y), srgb_to_linear(encoded.z)});
}

std::vector<std::uint32_t> ramp_of(glm::vec3 (*color)(float)) {
  std::vector<std::uint32_t> ramp;
  for (std::size_t i = 0; i < RAMP_STEPS; ++i)
    ramp.push_back(color_of(color(static_cast<float>(i) / (RAMP_STEPS - 1))));
  return ramp;
}

std::vector<std::uint32_t> grey_ramp() {
  std::vector<std::uint32_t> ramp;
  for (std::size_t i = 0; i < RAMP_STEPS; ++i) {
    const double share = std::pow(static_cast<double>(i) / (RAMP_STEPS - 1), 1.0 / INTENSITY_GAMMA);
    ramp.push_back(
        color_of(glm::vec3(static_cast<float>(std::lerp(INTENSITY_DARK, INTENSITY_BRIGHT, share)))));
  }
  return ramp;
}

struct AsprsClass {
  const char* name;
  glm::vec3 rgb;  ///< display-encoded, 0..255
};

/// LAS 1.4 R15, table 17; the colours are our own.
const std::map<std::uint32_t, AsprsClass>& asprs_classes() {
  static const std::map<std::uint32_t, AsprsClass> CLASSES = {
      {0, {"never classified", {150, 150, 150}}},
      {1, {"unclassified", {190, 190, 190}}},
      {2, {"ground", {166, 116, 70}}},
      {3, {"low vegetation", {170, 214, 110}}},
      {4, {"medium vegetation", {96, 178, 72}}},
      {5, {"high vegetation", {34, 120, 52}}},
      {6, {"building", {214, 86, 60}}},
      {7, {"low noise", {235, 30, 190}}},
      {8, {"model key point", {240, 220, 60}}},
      {9, {"water", {60, 130, 220}}},
      {10, {"rail", {110, 60, 140}}},
      {11, {"road surface", {90, 92, 98}}},
      {12, {"overlap", {200, 170, 130}}},
      {13, {"wire, guard", {250, 200, 40}}},
      {14, {"wire, conductor", {250, 160, 20}}},
      {15, {"transmission tower", {120, 160, 200}}},
      {16, {"wire connector", {240, 120, 40}}},
      {17, {"bridge deck", {140, 140, 170}}},
      {18, {"high noise", {255, 90, 215}}},
      {19, {"overhead structure", {170, 120, 180}}},
      {20, {"ignored ground", {130, 100, 80}}},
      {21, {"snow", {235, 242, 250}}},
      {22, {"temporal exclusion", {120, 120, 60}}},
  };
  return CLASSES;
}

/// Whether a column is the build's own: a file may have one of that name, too.
bool is_kinds(const Column& column) {
  return column.name == COLUMN_KIND && std::holds_alternative<Pool<std::uint8_t>>(column.values);
}

bool has_categories(const Column& column) { return is_category(column.name) || is_kinds(column); }

/// Surfaces grey, lines orange, scatter green: display-encoded, 0..255.
glm::vec3 kind_color(ScanKind kind) {
  return kind == ScanKind::surface ? glm::vec3(176, 178, 184)
         : kind == ScanKind::line  ? glm::vec3(240, 140, 30)
                                   : glm::vec3(60, 150, 70);
}

Category category(const Scene& scene, std::string_view column, std::uint32_t value) {
  if (column == COLUMN_CLASS) {
    const auto known = asprs_classes().find(value);
    if (known != asprs_classes().end()) {
      return {value, known->second.name, color_of(known->second.rgb / 255.0F), 0};
    }
  }
  if (column == COLUMN_KIND && value < SCAN_KINDS) {
    const auto kind = static_cast<ScanKind>(value);
    return {value, std::string(name_of(kind)), color_of(kind_color(kind) / 255.0F), 0};
  }
  const bool named = column == COLUMN_SCAN && value < scene.stations.size();
  return {value, named ? scene.stations[value].name : "", color_of(number_color(value)), 0};
}

/// The scanner's place of each scan; throws where none is known.
std::vector<std::optional<glm::dvec3>> sensors(const Scene& scene) {
  std::vector<std::optional<glm::dvec3>> places;
  for (const Station& station : scene.stations) places.push_back(station.sensor_world);
  return places;
}

bool knows_a_sensor(const Scene& scene) {
  return std::any_of(scene.stations.begin(), scene.stations.end(),
                     [](const Station& station) { return station.sensor_world.has_value(); });
}

/// The value of an attribute at each splat; NaN where it has none.
std::vector<double> values_of(const Scene& scene, const std::string& name) {
  std::vector<double> values(splat_count(scene));
  const auto fill = [&values](const auto& value) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(i);
  };
  if (const Column* column = find_column(scene.columns, name)) {
    fill([&](std::size_t i) { return column->number(i); });
  } else if (name == "height") {
    const glm::dvec3 up = glm::normalize(scene.up);
    fill([&](std::size_t i) { return glm::dot(up, splat_at(scene, i).center_world()); });
  } else {
    const auto places = sensors(scene);
    const Column* scan = find_column(scene.columns, COLUMN_SCAN);
    fill([&](std::size_t i) {
      const auto station = scan != nullptr ? static_cast<std::size_t>(scan->number(i)) : 0;
      return station < places.size() && places[station]
                 ? glm::length(splat_at(scene, i).center_world() - *places[station])
                 : std::nan("");
    });
  }
  return values;
}

/// From the 2nd to the 98th of 100 parts of the values that are numbers.
std::array<double, 2> robust_range(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {0.0, 0.0};
  return {value_at(values, RANGE_FIRST), value_at(values, RANGE_LAST)};
}

/// Whether values say how far something is from what it should be, so that 0 is the middle.
bool is_signed(const Scene& scene, const std::string& name, double low, double high) {
  return find_column(scene.columns, name) != nullptr && name != COLUMN_INTENSITY && low < 0.0 && high > 0.0;
}

/// From `low` to `high`, neutral at 0.
std::vector<std::uint32_t> signed_ramp(double low, double high) {
  std::vector<std::uint32_t> ramp;
  for (std::size_t i = 0; i < RAMP_STEPS; ++i) {
    const double value = std::lerp(low, high, static_cast<double>(i) / (RAMP_STEPS - 1));
    ramp.push_back(color_of(signed_color(static_cast<float>(value / std::max(-low, high)))));
  }
  return ramp;
}

std::vector<std::uint32_t> ramp_for(const std::string& name) {
  if (name == COLUMN_INTENSITY) return grey_ramp();
  return ramp_of(name == "height" ? land_color : heat_color);
}

AttributeColors ramp_colors(const Scene& scene, const AttributeOptions& options) {
  const std::vector<double> values = values_of(scene, options.color_by);
  auto [low, high] = options.color_range ? *options.color_range : robust_range(values);
  const bool both_signs = is_signed(scene, options.color_by, low, high);
  if (both_signs && !options.color_range) low = -(high = std::max(-low, high));
  AttributeColors result;
  result.legend = {
      options.color_by, low, high, both_signs ? signed_ramp(low, high) : ramp_for(options.color_by), {}};
  const std::uint32_t unknown = both_signs ? color_of(UNKNOWN_COLOR) : result.legend.ramp.front();
  result.colors.reserve(values.size());
  for (const double value : values) {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    const double step = std::clamp(share, 0.0, 1.0) * (RAMP_STEPS - 1);
    result.colors.push_back(
        std::isfinite(share) ? result.legend.ramp[static_cast<std::size_t>(std::lround(step))] : unknown);
  }
  return result;
}

/// Heights' colours, darker where intensity is low: what a survey's surfaces are made of on the lie of the land.
AttributeColors relief_colors(const Scene& scene, AttributeOptions options) {
  options.color_by = "height";
  AttributeColors result = ramp_colors(scene, options);
  options.color_by = COLUMN_INTENSITY;
  options.color_range.reset();
  const std::vector<std::uint32_t> grey = ramp_colors(scene, options).colors;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const float share = linear_to_srgb(unpack_color(grey[i]).x),
                factor = RELIEF_DARK + (RELIEF_BRIGHT - RELIEF_DARK) * share;
    result.colors[i] = pack_color(glm::min(factor * unpack_color(result.colors[i]), glm::vec3(1.0F)));
  }
  return result;
}

AttributeColors category_colors(const Scene& scene, const Column& column) {
  AttributeColors result;
  result.legend.title = column.name;
  result.legend.categories = categories_of(scene, column.name);
  std::map<std::uint32_t, std::uint32_t> color;
  for (const Category& category : result.legend.categories) color[category.value] = category.color;
  result.colors.reserve(column.size());
  for (std::size_t i = 0; i < column.size(); ++i)
    result.colors.push_back(color.at(static_cast<std::uint32_t>(column.number(i))));
  return result;
}

AttributeColors normal_colors(const Scene& scene) {
  AttributeColors result;
  result.legend.title = "normal";
  result.colors.reserve(splat_count(scene));
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    result.colors.push_back(color_of(glm::vec3(0.5 * splat.normal() + 0.5)));
  });
  return result;
}

/// Greys of what is level, faces the plan's top or bottom, and faces its sides, in parts by the squares of the normal's components: they
/// do not depend on which side is the front, and walls of a room differ at its corners.
AttributeColors orientation_colors(const Scene& scene) {
  constexpr double LEVEL = 0.95, FACING_NORTH = 0.8, FACING_EAST = 0.66;  // display values
  const glm::dmat3 axes = upright_axes(scene.up);
  AttributeColors result;
  result.colors.reserve(splat_count(scene));
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 along = glm::transpose(axes) * splat.normal(), part = along * along;
    const double grey = FACING_EAST * part.x + LEVEL * part.y + FACING_NORTH * part.z;
    result.colors.push_back(color_of(glm::vec3(static_cast<float>(grey))));
  });
  return result;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Shrinks the splats whose value of the column is in the list.
void hide(Scene& scene, std::string_view name, const std::vector<std::uint32_t>& hidden) {
  if (hidden.empty()) return;
  const Column* column = find_column(scene.columns, name);
  if (column == nullptr)
    throw Error(ExitCode::usage,
                "--hide-" + std::string(name) + ": the scene's points have no " + std::string(name));
  std::vector<uvec4>& splats = scene.data_pool.edit();
  for (std::size_t i = 0; i < column->size(); ++i) {
    const auto value = static_cast<std::uint32_t>(column->number(i));
    if (std::find(hidden.begin(), hidden.end(), value) == hidden.end()) continue;
    splats[i].w &= OBJECT_MASK;  // a stored radius of 0 is the least: sqrt(2) lattice units
  }
}

}  // namespace

bool is_category(std::string_view column) {
  return column == COLUMN_CLASS || column == COLUMN_RETURN || column == COLUMN_RETURNS ||
         column == COLUMN_SOURCE || column == COLUMN_SCAN;
}

std::vector<std::string> color_sources(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.color_pool.empty()) names.emplace_back("rgb");
  names.emplace_back("plain");
  for (const Column& column : scene.columns) names.push_back(column.name);
  names.insert(names.end(), {"height", "normal", "orientation"});
  if (find_column(scene.columns, COLUMN_INTENSITY) != nullptr) names.emplace_back(HEIGHT_AND_INTENSITY);
  if (knows_a_sensor(scene)) names.emplace_back("distance");
  return names;
}

AttributeColors color_by(const Scene& scene, const AttributeOptions& options) {
  if (options.color_by.empty() || options.color_by == "rgb") return {};
  if (options.color_by == "plain")
    return {std::vector<std::uint32_t>(scene.color_pool.size(), pack_color(glm::vec3(1.0F))), {}};
  const std::vector<std::string> sources = color_sources(scene);
  if (std::find(sources.begin(), sources.end(), options.color_by) == sources.end())
    throw Error(ExitCode::usage, "--color-by: found '" + options.color_by +
                                     "', expected what the scene's points have: " + joined(sources) +
                                     did_you_mean(options.color_by, sources));
  if (options.color_by == "normal") return normal_colors(scene);
  if (options.color_by == "orientation") return orientation_colors(scene);
  if (options.color_by == HEIGHT_AND_INTENSITY) return relief_colors(scene, options);
  if (const Column* column = find_column(scene.columns, options.color_by); column && has_categories(*column))
    return category_colors(scene, *column);
  return ramp_colors(scene, options);
}

std::string class_name(std::uint32_t value) {
  const auto known = asprs_classes().find(value);
  return known != asprs_classes().end() ? known->second.name : "";
}

std::vector<Category> categories_of(const Scene& scene, std::string_view name) {
  const Column* column = find_column(scene.columns, name);
  if (column == nullptr || !has_categories(*column)) return {};
  std::map<std::uint32_t, std::uint64_t> points;
  for (std::size_t i = 0; i < column->size(); ++i) ++points[static_cast<std::uint32_t>(column->number(i))];
  std::vector<Category> categories;
  for (const auto& [value, count] : points) {
    categories.push_back(category(scene, name, value));
    categories.back().points = count;
  }
  return categories;
}

ColorLegend show_attributes(Scene& scene, const AttributeOptions& options) {
  AttributeColors colors = color_by(scene, options);
  if (!colors.colors.empty()) scene.color_pool = std::move(colors.colors);
  hide(scene, COLUMN_CLASS, options.hidden_classes);
  hide(scene, COLUMN_SCAN, options.hidden_scans);
  return colors.legend;
}

std::vector<AttributeValue> attributes_of(const Scene& scene, std::size_t splat) {
  std::vector<AttributeValue> values;
  for (const Column& column : scene.columns) {
    std::string text = number_text(column.number(splat));
    if (column.name == COLUMN_CLASS || column.name == COLUMN_SCAN || is_kinds(column)) {
      const std::string name =
          category(scene, column.name, static_cast<std::uint32_t>(column.number(splat))).name;
      if (!name.empty()) text += " (" + name + ")";
    }
    values.push_back({column.name, text});
  }
  return values;
}

}  // namespace splatray

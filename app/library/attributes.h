/// Points shown by their attributes: colours made of them, classes and scans left out.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// What is shown of the attributes of a scene's points.
struct AttributeOptions {
  /// rgb, plain (no colours), height, height+intensity (darker where intensity is low), normal, orientation (greys: level ones light,
  /// walls darker, two kinds of them), distance, or a column's name; empty = rgb, what the scene has.
  std::string color_by;
  /// Unset = from the 2nd to the 98th of 100 parts of all values.
  std::optional<std::array<double, 2>> color_range;
  std::vector<std::uint32_t> hidden_classes;  ///< of the column COLUMN_CLASS
  std::vector<std::uint32_t> hidden_scans;    ///< of the column COLUMN_SCAN

  bool operator==(const AttributeOptions&) const = default;
};

/// A value that stands for itself, such as a class.
struct Category {
  std::uint32_t value = 0;
  std::string name;          ///< of a class or scan; empty = the number says all
  std::uint32_t color = 0;   ///< pack_color
  std::uint64_t points = 0;  ///< that have it
};

/// What the colours mean.
struct ColorLegend {
  std::string title;                 ///< the attribute's name; empty = the colours are the scene's own
  double low = 0.0, high = 0.0;      ///< values at the first and last of `ramp`
  std::vector<std::uint32_t> ramp;   ///< pack_color, at even steps; empty = categories, or normals
  std::vector<Category> categories;  ///< ascending by value
};

/// Colours beside a scene's data pool, pack_color; empty = as the scene has them.
struct AttributeColors {
  std::vector<std::uint32_t> colors;
  ColorLegend legend;
};

/// What color_by may be for this scene. The first is what it shows where nothing is asked for: rgb, or plain without colours.
[[nodiscard]] std::vector<std::string> color_sources(const Scene& scene);

/// The colours that the options ask for: categories for class, return, returns, source, scan and kind, a ramp over `color_range`
/// for others (intensity: greys from dark to light with gamma 1/2.2, as its values are of any scale; height: land_color; values of
/// both signs: signed_color, as far to either side of 0 where no range is asked for, grey where there is no number). Throws
/// Error (usage) for an attribute that
/// the scene does not have.
[[nodiscard]] AttributeColors color_by(const Scene& scene, const AttributeOptions& options);

/// Whether values of the attribute of this name stand for themselves: class, return, returns, source and scan.
[[nodiscard]] bool is_category(std::string_view column);

/// ASPRS's name of a class (LAS 1.4 R15, table 17); empty where it has none.
[[nodiscard]] std::string class_name(std::uint32_t value);

/// The categories of a column, with the points that have each; none where there is no such column
/// of categories.
[[nodiscard]] std::vector<Category> categories_of(const Scene& scene, std::string_view column);

/// Applies colours and hides classes and scans: splats of hidden ones shrink to the least radius, 1/10^6 of the scene, which hardly
/// any ray meets. Throws Error (usage) as color_by does, and where something is hidden that the
/// scene does not have.
[[nodiscard]] ColorLegend show_attributes(Scene& scene, const AttributeOptions& options);

/// All attributes of a splat, by name, in the scene's order.
struct AttributeValue {
  std::string name;
  std::string text;
};
[[nodiscard]] std::vector<AttributeValue> attributes_of(const Scene& scene, std::size_t splat);

}  // namespace splatray

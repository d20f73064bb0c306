/// A scene's splats as points with named values, for files of points.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// Points of the input that are in no splat, with what their files say of them.
struct LeftOut {
  std::vector<glm::dvec3> position;
  std::vector<std::uint32_t> color;  ///< pack_color; empty = none
  std::vector<Column> columns;
};

enum class ValueType : std::uint8_t { uint8, uint16, uint32, float32, float64 };

/// Bytes of a value.
[[nodiscard]] std::size_t bytes_of(ValueType type);
/// Puts a number, which the type holds, where `bytes` points to.
void store_value(ValueType type, double number, unsigned char* bytes);

/// One value of each point.
struct PointProperty {
  std::string name;  ///< letters, digits and '_', '.', '[', ']', '-' alone; no two are the same
  ValueType type;
  std::function<double(std::size_t)> value;  ///< of a point; a number that the type holds
};

/// The splats, in the scene's order, then what was left out, which has no normal (zero), no radius (0) and the class LOW_NOISE.
/// The scene and what was left out must stay.
struct PointTable {
  static constexpr std::uint8_t LOW_NOISE = 7;  ///< of ASPRS's classes

  const Scene& scene;
  std::size_t size = 0;
  std::function<glm::dvec3(std::size_t)> position;  ///< world units
  /// nx ny nz radius, red green blue (display-encoded) where there are colours, object where there are several, the columns.
  /// A radius is such that the splat that is packed of it is the same.
  std::vector<PointProperty> properties;
  /// The words that splats alone have beside their 128 bits (SPLAT_WORDS), for formats that keep marks (splat_marks.h).
  std::vector<PointProperty> words;
  bool splats_alone = true;  ///< nothing was left out
};

[[nodiscard]] PointTable make_point_table(const Scene& scene, const LeftOut& left_out);

}  // namespace splatray

/// A light that is asked for, and its text.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "engine/scene/look.h"

namespace splatray {

/// A rectangle whose width is level about the scene's up direction, which its edges follow once that is known.
struct LevelRectangle {
  glm::dvec3 target{0.0};  ///< what it shines at, world space
  glm::dvec2 edges{0.0};   ///< width and height, world units

  bool operator==(const LevelRectangle&) const = default;
};

/// A light of the picture, but for what its scene decides.
struct LightRequest {
  SceneLight light;
  std::optional<LevelRectangle> level;  ///< of rectangles: light.edge_u and edge_v follow from it
  /// Where not: irradiance pi, of a point light at the scene's centre, of a rectangle at its target.
  bool has_power = false;

  bool operator==(const LightRequest&) const = default;
};

/// The angle, degrees, that a sun seems to have.
[[nodiscard]] double sun_degrees(const SceneLight& sun);

/// The kinds of lights in texts, as a sentence lists them: "point, spot, sun or rectangle".
[[nodiscard]] std::string light_kind_names();
/// The kind of a light, one of them.
[[nodiscard]] const char* light_kind_name(const SceneLight& light);

/// The keys of a light's text with their units, as help lists them.
[[nodiscard]] std::string light_keys_help();

/// Reads KIND:key=value,..., such as spot:at=0,3,0,to=0,0,0,cone=17,range=9. Throws Expected.
[[nodiscard]] LightRequest read_light(const std::string& text);
/// The text that read_light makes the same of, for all but level rectangles.
[[nodiscard]] std::string light_text(const LightRequest& light);

}  // namespace splatray

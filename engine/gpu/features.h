/// Which features a pipeline needs, from the content of the scene and the settings: what a scene does not use costs nothing.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/device/spec_constants.h"
#include "engine/image/view.h"
#include "shaders/layout.h"

namespace splatray {

/// What the features depend on in a scene's materials.
struct MaterialContent {
  std::uint32_t faces = FACES_MIXED;  ///< FACES_*: the cheapest that is right for all
  bool open = false;                  ///< every object is two-sided or a dielectric, none is hidden
  bool mirrors = false;               ///< some mirror; Phong
  bool glass = false;                 ///< some are dielectrics
  bool panes = false;                 ///< some of these do not bend light
  bool scatters = false;              ///< some send light of lights back, diffusely or as a highlight; Phong
  std::uint32_t lobes = 0;            ///< FEATURE_* of the lobes that they have, and of their emission
};
/// `textures`: FEATURE_TEXTURE_* of the scene, which may make less of a material's values.
[[nodiscard]] MaterialContent material_content(std::span<const Material> materials,
                                               std::uint32_t textures = 0);

/// What the features depend on.
struct SceneContent {
  MaterialContent materials{};
  std::uint32_t pools = 0;                   ///< FEATURE_* of the optional pools that some splat needs
  bool ellipses = false;                     ///< some splat is an ellipse
  bool leans = false;                        ///< some normal field is a constant term
  bool references = false;                   ///< the data pool is read through the reference pool
  std::uint32_t top_levels = 0;              ///< of the top table
  std::array<std::uint32_t, POOLS> pages{};  ///< Paging::pages
  std::uint32_t page_shift = 0;              ///< Paging::page_shift
  std::uint32_t textures = 0;                ///< texture_features()
  bool lights = false;                       ///< there are lights
  bool sized_lights = false;                 ///< some light has a size
  bool environment_texture = false;          ///< the environment is not constant
  bool sky = false;                          ///< it has a sky table
  bool fused = false;                        ///< Queue::fuses
};

/// Constants of images (trace.comp.glsl); of Program::light where the look is not LOOK_PAPER.
[[nodiscard]] SpecConstants picture_features(const SceneContent& content, const Settings& settings);
/// Constants of ray queries (rays.comp.glsl): those of images without what only shading needs.
[[nodiscard]] SpecConstants query_features(const SceneContent& content, const Settings& settings);

}  // namespace splatray

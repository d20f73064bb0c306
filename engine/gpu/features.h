/// Which features a pipeline needs, from the content of the scene and the settings (design, section 5).
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/image/view.h"
#include "shaders/layout.h"

namespace splatray {

/// Values of the specialization constants; index = SPEC_*.
using SpecConstants = std::array<std::uint32_t, SPEC_COUNT>;

/// What the features depend on.
struct SceneContent {
  std::span<const Material> materials{};
  bool colors = false;               ///< there is a colour pool
  bool fields = false;               ///< there is a pool of normal fields
  bool references = false;           ///< the data pool is read through the reference pool
  std::uint32_t top_levels = 0;      ///< of the top table
  std::uint32_t pages = 0;           ///< Paging::pages_constant
  std::uint32_t page_shift = 0;      ///< Paging::page_shift
  bool lights = false;               ///< there are lights
  bool environment_texture = false;  ///< the environment is not constant
};

/// Constants of pictures (trace.comp.glsl), with SPEC_AOV = 0.
[[nodiscard]] SpecConstants picture_features(const SceneContent& content, const Settings& settings);
/// Those of them that matter where no primary ray hits anything, and the pages, which descriptor sets depend on.
[[nodiscard]] SpecConstants empty_features(const SpecConstants& constants);
/// Constants of ray queries (rays.comp.glsl): those of pictures without what only shading needs.
[[nodiscard]] SpecConstants query_features(const SceneContent& content, const Settings& settings);

}  // namespace splatray

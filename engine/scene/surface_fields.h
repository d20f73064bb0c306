/// The numbers of a Surface, one row each: files are checked by them, and the keys of --object and the viewer's sliders made of
/// them. A lobe is its members in shaders/layout.h, their rows here, its text in shaders/light/bsdf.glsl and what needs it in
/// engine/gpu/features.cpp.
#pragma once
#include <span>

#include "shaders/layout.h"

namespace splatray {

struct SurfaceField {
  const char* what;        ///< in sentences: "a clearcoat roughness"
  float Surface::*number;  ///< a number, or
  vec3 Surface::*color;    ///< a colour, linear; the other is null
  float least, most;       ///< range, of a colour of each channel
  /// In --object and panels, "coat-roughness"; null: files and the material say it.
  const char* key = nullptr;

  [[nodiscard]] vec3 of(const Surface& surface) const {
    return number != nullptr ? vec3(surface.*number) : surface.*color;
  }
  /// Of a number, its first channel is taken.
  void set(Surface& surface, const vec3& value) const {
    if (number != nullptr)
      surface.*number = value.x;
    else
      surface.*color = value;
  }
};

[[nodiscard]] std::span<const SurfaceField> surface_fields();

}  // namespace splatray

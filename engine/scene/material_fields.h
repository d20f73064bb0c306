/// The numbers of a Material beside Phong's, one row each: files are checked by them, and the keys of --object, the viewer's sliders and what
/// kernels are compiled with are made of them. A lobe is its members and FEATURE_ bit in shaders/layout.h, their rows here, the
/// bit's row in shaders/scene/features.glsl, its text in shaders/light/bsdf.glsl, and where glTF has it
/// preprocess/read/gltf/gltf_material.cpp.
#pragma once
#include <span>

#include "shaders/layout.h"

namespace splatray {

/// Largest emission: half as bright as the sun in candela per square metre; squares of it stay finite.
inline constexpr float EMISSION_MOST = 1e9F;

struct MaterialField {
  const char* what;         ///< in sentences: "a clearcoat roughness"
  float Material::*number;  ///< a number, or
  vec3 Material::*color;    ///< a colour, linear; the other is null
  float least, most;        ///< range, of a colour of each channel
  /// FEATURE_* that kernels have where some material's value is above zero; 0: none, or it is more than that.
  std::uint32_t feature;
  /// In --object and panels, "coat-roughness"; null: files and Phong's numbers say it.
  const char* key = nullptr;

  [[nodiscard]] vec3 of(const Material& material) const {
    return number != nullptr ? vec3(material.*number) : material.*color;
  }
  /// A field that is one number takes the value's first channel.
  void set(Material& material, const vec3& value) const {
    if (number != nullptr)
      material.*number = value.x;
    else
      material.*color = value;
  }
};

[[nodiscard]] std::span<const MaterialField> material_fields();

}  // namespace splatray

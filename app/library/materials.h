/// Materials by name, for objects whose file has none worth keeping.
#pragma once
#include <string>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

/// Names for --material: matte, glossy, mirror, gold, copper, glass, ruby.
[[nodiscard]] std::vector<std::string> material_names();

/// The material of a name in material_names(). The dielectrics (glass, ruby) are one-sided: their object must
/// be closed and its normals must point outwards; the others are two-sided.
[[nodiscard]] Material named_material(const std::string& name);

/// Gives an object's material the looks of a name; what belongs to the object stays: whether it is hidden, and its
/// mask_bit.
void change_material(Material& material, const std::string& name);

}  // namespace splatray

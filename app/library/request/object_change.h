/// Changes to the materials of single objects: --object.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// What one --object changes; what is unset stays as it is. Ranges as Material's.
struct ObjectChange {
  std::string object;  ///< index where it is a whole number, else name
  std::string preset;  ///< a name of materials.h, replaces the whole material first; empty = none
  std::optional<glm::vec3> diffuse, tint;
  std::optional<float> specular, shininess, mirror, ior;
  std::optional<bool> glass, two_sided, hidden;
  // Of the Surface, which follows the material above (surface_after) before these change it.
  std::optional<float> metallic, roughness, coat, coat_roughness;
  std::optional<glm::vec3> emission;

  bool operator==(const ObjectChange&) const = default;
};

/// Reads OBJECT:key=value,... . The last ':' ends the object's name, so names may hold any character. Throws Error (usage)
/// for unknown keys and values out of range.
[[nodiscard]] ObjectChange read_object_change(const std::string& text);
/// The text that reads back to equal options.
[[nodiscard]] std::string object_text(const ObjectChange& options);

/// What a surface becomes when its material changes: surface_of the material after, but for metallic, roughness, coat and emission
/// where the surface said something else than its material before. As it is where surface_of does not see the change.
[[nodiscard]] Surface surface_after(const Material& before, const Surface& surface, const Material& after);

/// Whether options change more of an object than which of its sides are seen.
[[nodiscard]] bool changes_look(const ObjectChange& options);

/// Changes the looks of the objects named `names`; each keeps its mask_bit. All that is said of an object is one change, whatever
/// its order; of a key said twice the last holds. Throws Error (usage) for an
/// object that does not exist or a name that several have.
void apply_object_changes(const std::vector<ObjectChange>& options, const std::vector<std::string>& names,
                          ObjectLooks& looks);

/// The options that make `loaded` look like `shown`, one for each object that differs; mask_bit is not looked at.
[[nodiscard]] std::vector<ObjectChange> object_changes_between(const ObjectLooks& loaded,
                                                               const ObjectLooks& shown,
                                                               const std::vector<std::string>& names);

}  // namespace splatray

/// Changes to the materials of single objects: --object.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// What one --object changes; what is not said stays as it is.
struct ObjectChange {
  std::string object;  ///< index where it is a whole number, else name
  /// The values said, by key: texts that set() has checked.
  std::map<std::string, std::string> values{};

  /// Says a value. Throws Error (usage) for an unknown key and a value out of range.
  void set(const std::string& key, const std::string& value);

  bool operator==(const ObjectChange&) const = default;
};

/// The keys, as help lists them.
[[nodiscard]] std::string object_keys_help();

/// Reads OBJECT:key=value,... . The last ':' ends the object's name, so names may hold any character. Throws Error (usage)
/// for unknown keys and values out of range.
[[nodiscard]] ObjectChange read_object_change(const std::string& text);
/// The text that reads back to an equal change.
[[nodiscard]] std::string object_text(const ObjectChange& change);

/// Whether a change is of more than which sides of an object are seen.
[[nodiscard]] bool changes_look(const ObjectChange& change);

/// Changes the materials of the objects named `names`; each keeps its mask_bit, and glTF's numbers follow from Phong's
/// (follow_change in engine/scene/phong.h) unless they are said. All that is said of an object is one change, whatever
/// its order; of a key said twice the last holds. Throws Error (usage) for an object that does not exist or a name that several
/// have.
void apply_object_changes(const std::vector<ObjectChange>& changes, const std::vector<std::string>& names,
                          std::vector<Material>& materials);

/// The changes that make `loaded` look like `shown`, one for each object that differs; mask_bit is not looked at.
[[nodiscard]] std::vector<ObjectChange> object_changes_between(const std::vector<Material>& loaded,
                                                               const std::vector<Material>& shown,
                                                               const std::vector<std::string>& names);

}  // namespace splatray

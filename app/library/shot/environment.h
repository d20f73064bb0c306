/// Environments by the names that --environment takes.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "engine/scene/environment.h"

namespace splatray {

/// The environment of a name that needs no file: white, black, studio, sky:... or r,g,b, empty = studio; nothing for other names.
/// Throws Error (usage) for a radiance that is negative or not finite.
[[nodiscard]] std::optional<Environment> built_in_environment(const std::string& name);
/// That, or the one of a file. `note` hears what is odd about the file. Throws Error (input_unreadable).
[[nodiscard]] Environment load_environment(const std::string& name,
                                           const std::function<void(const std::string&)>& note = {});

}  // namespace splatray

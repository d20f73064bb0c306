/// Files of JSON that say where points are.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace splatray {

/// What a file of JSON holds. Throws Error (input_unreadable), one sentence, for what is none.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace splatray

/// Counts in messages.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace splatray {

/// "12 withheld, 3 isolated": the counts that are not zero, each with what it counts; empty where all are.
[[nodiscard]] inline std::string counted_list(std::span<const std::pair<std::uint64_t, const char*>> counts) {
  std::string text;
  for (const auto& [count, what] : counts)
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  return text;
}

}  // namespace splatray

/// Which frames of a sequence: the text of --frames, which is how render farms name a task's chunk.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splatray {

/// Every step-th frame from first to last; first <= last, step >= 1.
struct FrameRange {
  std::uint32_t first = 0, last = 0, step = 1;

  bool operator==(const FrameRange&) const = default;
};

/// No frame has a greater number.
inline constexpr std::uint32_t LAST_FRAME = 999999;

/// Reads 0-3,7,9-12:3, which is 0 1 2 3 7 9 12 (Open Job Description 2023-09, "IntRangeExpr", whose numbers ascend here); nothing
/// for another text.
[[nodiscard]] std::optional<std::vector<FrameRange>> read_frame_list(const std::string& text);
/// The text that reads back to the same ranges.
[[nodiscard]] std::string frame_list_text(const std::vector<FrameRange>& ranges);
/// Each frame once, in the order of the ranges.
[[nodiscard]] std::vector<std::uint32_t> listed_frames(const std::vector<FrameRange>& ranges);

/// The pattern with its one run of # replaced by the number, padded with zeros to the run's length. Throws Error (usage)
/// unless the file's name has exactly one run.
[[nodiscard]] std::filesystem::path frame_file(const std::filesystem::path& pattern, std::uint32_t number);

}  // namespace splatray

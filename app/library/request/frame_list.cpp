#include "app/library/request/frame_list.h"

#include <charconv>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// Takes a whole number up to LAST_FRAME off the text's front.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number > LAST_FRAME) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// Takes a character off the text's front where it is that one.
bool take(std::string_view& text, char wanted) {
  if (!text.starts_with(wanted)) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<FrameRange> take_range(std::string_view& text) {
  const auto first = take_number(text);
  if (!first) return {};
  FrameRange range{*first, *first};
  if (!take(text, '-')) return range;
  const auto last = take_number(text);
  if (!last || *last < *first) return {};
  range.last = *last;
  if (!take(text, ':')) return range;
  const auto step = take_number(text);
  if (!step || *step == 0) return {};
  range.step = *step;
  return range;
}

}  // namespace

std::optional<std::vector<FrameRange>> read_frame_list(const std::string& text) {
  std::vector<FrameRange> ranges;
  std::string_view rest = text;
  do {
    const auto range = take_range(rest);
    if (!range) return {};
    ranges.push_back(*range);
  } while (take(rest, ','));
  if (!rest.empty()) return {};
  return ranges;
}

std::string frame_list_text(const std::vector<FrameRange>& ranges) {
  std::string text;
  for (const FrameRange& range : ranges) {
    text += (text.empty() ? "" : ",") + std::to_string(range.first);
    if (range.last != range.first || range.step != 1) text += "-" + std::to_string(range.last);
    if (range.step != 1) text += ":" + std::to_string(range.step);
  }
  return text;
}

std::vector<std::uint32_t> listed_frames(const std::vector<FrameRange>& ranges) {
  std::vector<std::uint32_t> frames;
  std::vector<bool> listed(LAST_FRAME + 1);
  for (const FrameRange& range : ranges)
    for (std::uint32_t frame = range.first; frame <= range.last; frame += range.step) {
      if (!listed[frame]) frames.push_back(frame);
      listed[frame] = true;
    }
  return frames;
}

std::filesystem::path frame_file(const std::filesystem::path& pattern, std::uint32_t number) {
  const std::string name = pattern.filename();
  const std::size_t begin = name.find('#');
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  if (begin == std::string::npos || name.find('#', end) != std::string::npos)
    throw Error(ExitCode::usage,
                "found output '" + pattern.string() +
                    "' for a sequence, expected a name with one run of # such as out.####.png");
  std::string digits = std::to_string(number);
  digits.insert(0, std::max(end - begin, digits.size()) - digits.size(), '0');
  return pattern.parent_path() / (name.substr(0, begin) + digits + name.substr(end));
}

}  // namespace splatray

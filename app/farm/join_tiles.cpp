#include "app/farm/join_tiles.h"

#include <algorithm>
#include <string>

#include "app/library/request/command_line.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"

namespace splatray {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found,
                         const std::string& expected) {
  throw Error(ExitCode::input_unreadable,
              "cannot join '" + file.string() + "': found " + found + ", expected " + expected);
}

std::string size_text(const ExrPicture& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

/// The command kept in a part becomes the one that makes the whole picture.
void name_whole_picture(ExrPicture& part, const std::filesystem::path& file) {
  const auto kept = std::find_if(part.metadata.begin(), part.metadata.end(),
                                 [](const auto& entry) { return entry.first == "command_line"; });
  if (kept == part.metadata.end())
    refuse(file, "no splatray.command_line in it", "an EXR of splatray-render");
  Request request;
  try {
    request = parse_command_line(kept->second);
  } catch (const Error& error) {
    refuse(file, std::string("a command that is none of ours (") + error.what() + ")",
           "an EXR of splatray-render");
  }
  request.view.crop = {};
  request.view.tile = request.view.tiles = 0;
  kept->second = command_line(request);
}

/// Refuses parts that cannot be the whole picture before there is memory for that: a part's header may claim any size.
void require_all_pixels(const std::vector<std::filesystem::path>& files) {
  std::uint64_t whole = 0, parts = 0, channels = 0;
  for (const std::filesystem::path& file : files) {
    const ExrPicture part = read_exr_header(file);
    whole = std::uint64_t{part.width} * part.height;
    parts += std::uint64_t{part.window.width} * part.window.height;
    channels = part.channels.size();
  }
  if (parts < whole || files.empty())
    throw Error(ExitCode::input_unreadable, "found at least " + std::to_string(whole - parts) +
                                                " pixels in none of the " + std::to_string(files.size()) +
                                                " parts, expected each in one");
  require_memory(whole * (channels * sizeof(float) + exr_writing_bytes(channels)),
                 "the picture of all parts");
}

ExrPicture read_part(const std::filesystem::path& file) {
  ExrPicture part = read_exr(file);
  name_whole_picture(part, file);
  return part;
}

void require_same_picture(const ExrPicture& part, const ExrPicture& first, const std::filesystem::path& file,
                          const std::filesystem::path& first_file) {
  const std::string like = " as in '" + first_file.string() + "'";
  if (part.width != first.width || part.height != first.height)
    refuse(file, "a part of " + size_text(part) + " pixels", size_text(first) + like);
  if (part.channels != first.channels) refuse(file, "other channels", "those" + like);
  if (part.metadata.size() != first.metadata.size()) refuse(file, "other metadata", "those" + like);
  for (std::size_t i = 0; i < part.metadata.size(); ++i)
    if (part.metadata[i] != first.metadata[i])
      refuse(file, part.metadata[i].first + " '" + part.metadata[i].second + "'",
             "'" + first.metadata[i].second + "'" + like);
}

/// Puts a part's pixels where they belong. `there`: which the whole picture has.
void put(const ExrPicture& part, const std::filesystem::path& file, ExrPicture& whole,
         std::vector<bool>& there) {
  const std::size_t channels = whole.channels.size();
  const std::size_t row_values = channels * part.window.width;
  for (std::size_t row = 0; row < part.window.height; ++row) {
    const std::size_t first = (part.window.y + row) * whole.width + part.window.x;
    for (std::size_t i = first; i < first + part.window.width; ++i) {
      if (there[i])
        refuse(file,
               "the pixel " + std::to_string(i % whole.width) + "," + std::to_string(i / whole.width) +
                   ", which another part has too",
               "parts that do not overlap");
      there[i] = true;
    }
    const auto from = part.values.begin() + static_cast<std::ptrdiff_t>(row * row_values);
    std::copy(from, from + static_cast<std::ptrdiff_t>(row_values),
              whole.values.begin() + static_cast<std::ptrdiff_t>(channels * first));
  }
}

}  // namespace

ExrPicture join_tiles(const std::vector<std::filesystem::path>& files) {
  require_all_pixels(files);
  ExrPicture whole;
  std::vector<bool> there;
  for (const std::filesystem::path& file : files) {
    const ExrPicture part = read_part(file);
    if (there.empty()) {
      whole = {part.width, part.height, {0, 0, part.width, part.height}, part.channels, {}, part.metadata};
      there.resize(std::size_t{part.width} * part.height);
      whole.values.resize(there.size() * part.channels.size());
    }
    require_same_picture(part, whole, file, files.front());
    put(part, file, whole, there);
  }
  const auto missing = static_cast<std::size_t>(std::count(there.begin(), there.end(), false));
  if (missing > 0) {
    const std::size_t first =
        static_cast<std::size_t>(std::find(there.begin(), there.end(), false) - there.begin());
    throw Error(ExitCode::input_unreadable, "found " + std::to_string(missing) + " pixels in none of the " +
                                                std::to_string(files.size()) + " parts, the first is " +
                                                std::to_string(first % whole.width) + "," +
                                                std::to_string(first / whole.width) +
                                                ", expected each in one");
  }
  return whole;
}

}  // namespace splatray

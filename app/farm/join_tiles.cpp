#include "app/farm/join_tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "app/library/picture/picture_file.h"
#include "app/library/request/command_line.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/image/sample_mean.h"

namespace splatray {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found,
                         const std::string& expected) {
  throw Error(ExitCode::input_unreadable,
              "cannot join '" + file.string() + "': found " + found + ", expected " + expected);
}

/// A file, its values still to be read, and which samples they are of.
struct Part {
  std::filesystem::path file;
  ExrPicture header;
  Request request;  ///< of the command that made it

  [[nodiscard]] std::uint32_t begin() const { return request.settings.sample_offset; }
  [[nodiscard]] std::uint32_t samples() const { return request.settings.samples; }
  [[nodiscard]] std::uint32_t end() const { return begin() + samples(); }
};

std::string size_text(const ExrPicture& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

std::string samples_text(std::uint32_t begin, std::uint32_t end) {
  return "the samples " + std::to_string(begin) + " to " + std::to_string(end - 1);
}

/// A value among a picture's metadata.
std::string* find_value(Metadata& metadata, const char* name) {
  const auto found =
      std::find_if(metadata.begin(), metadata.end(), [&](const auto& entry) { return entry.first == name; });
  return found == metadata.end() ? nullptr : &found->second;
}

Part read_part_header(const std::filesystem::path& file) {
  Part part{file, read_exr_header(file), {}};
  const std::string* command = find_value(part.header.metadata, "command_line");
  if (command == nullptr) refuse(file, "no splatray.command_line in it", "an EXR of splatray-render");
  try {
    part.request = parse_command_line(*command);
  } catch (const Error& error) {
    refuse(file, std::string("a command that is none of ours (") + error.what() + ")",
           "an EXR of splatray-render");
  }
  if (part.request.output.denoise.value_or(false) || part.request.output.despeckle)
    refuse(file, "a part whose noise was taken out", "one made without --denoise and --despeckle");
  return part;
}

/// Turns the metadata of a part into those of the whole picture, which has `samples` samples a pixel.
void name_whole_picture(Part& part, std::uint32_t samples) {
  Request request = part.request;
  request.view.crop = {};
  request.view.tile = request.view.tiles = 0;
  request.settings.samples = samples;
  request.settings.sample_offset = 0;
  *find_value(part.header.metadata, "command_line") = command_line(request);
  if (std::string* stored = find_value(part.header.metadata, "samples")) *stored = std::to_string(samples);
}

/// Empty where it is not kept.
std::string device_of(Part& part) {
  const std::string* device = find_value(part.header.metadata, "device");
  return device == nullptr ? std::string() : *device;
}

/// Has all parts name all devices that made them, and none ask for one.
void name_all_devices(std::vector<Part>& parts) {
  std::string all = device_of(parts.front());
  for (Part& part : parts) all = joined_devices(all, device_of(part));
  for (Part& part : parts) {
    if (std::string* device = find_value(part.header.metadata, "device")) *device = all;
    part.request.settings.device.clear();
  }
}

void require_same_device(Part& part, Part& first) {
  if (device_of(part) != device_of(first))
    refuse(part.file, "a part that '" + device_of(part) + "' made",
           "one of '" + device_of(first) + "' as '" + first.file.string() +
               "' is, or --mixed-devices, as samples may differ");
}

void require_same_picture(const Part& part, const Part& first_part) {
  const ExrPicture &header = part.header, &first = first_part.header;
  const std::string like = " as in '" + first_part.file.string() + "'";
  if (header.width != first.width || header.height != first.height)
    refuse(part.file, "a part of " + size_text(header) + " pixels", size_text(first) + like);
  if (header.channels != first.channels) refuse(part.file, "other channels", "those" + like);
  if (header.metadata.size() != first.metadata.size()) refuse(part.file, "other metadata", "those" + like);
  for (std::size_t i = 0; i < header.metadata.size(); ++i)
    if (header.metadata[i] != first.metadata[i])
      refuse(part.file, header.metadata[i].first + " '" + header.metadata[i].second + "'",
             "'" + first.metadata[i].second + "'" + like);
}

using Place = std::array<std::uint32_t, 4>;

Place place_of(const Part& part) {
  const PixelWindow& window = part.header.window;
  return {window.y, window.x, window.width, window.height};
}

/// The parts of the same pixels, one behind the other, each with its samples in their order.
using Parts = std::vector<Part>;
std::vector<Parts> by_place(Parts parts) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::tuple(place_of(a), a.begin(), a.end()) < std::tuple(place_of(b), b.begin(), b.end());
  });
  std::vector<Parts> groups;
  for (Part& part : parts) {
    if (groups.empty() || place_of(groups.back().front()) != place_of(part)) groups.emplace_back();
    groups.back().push_back(std::move(part));
  }
  return groups;
}

/// Each sample must be in one part, in a range whose mean is one of those that the whole picture is made of.
void require_all_samples(const Parts& parts, std::uint32_t samples) {
  std::uint32_t next = 0;
  for (const Part& part : parts) {
    if (part.begin() < next)
      refuse(part.file,
             samples_text(part.begin(), std::min(next, part.end())) + " of the pixel " +
                 std::to_string(part.header.window.x) + "," + std::to_string(part.header.window.y) +
                 ", which another part has too",
             "parts that do not overlap");
    if (part.begin() > next)
      refuse(part.file, samples_text(part.begin(), part.end()) + " behind a gap",
             samples_text(next, part.begin()) + " in a part, too");
    const std::uint32_t range = whole_range(part.samples());
    if (part.samples() != range && part.end() != samples)
      refuse(part.file, samples_text(part.begin(), part.end()) + " before others",
             "64, 128, 256 ... samples in a part that is not the last");
    next = part.end();
  }
  if (next < samples)
    refuse(parts.back().file, "no part behind " + samples_text(parts.back().begin(), next),
           samples_text(next, samples) + " in one");
}

/// Refuses parts that cannot be the whole picture before there is memory for that: a part's header may claim any size.
void require_all_pixels(const std::vector<Parts>& groups, std::size_t files) {
  const ExrPicture& first = groups.front().front().header;
  const std::uint64_t whole = std::uint64_t{first.width} * first.height, channels = first.channels.size();
  std::uint64_t pixels = 0, adding_bytes = 0;
  for (const Parts& parts : groups) {
    const PixelWindow& window = parts.front().header.window;
    const std::uint64_t here = std::uint64_t{window.width} * window.height;
    pixels += here;
    // A part's values, and means of 1, 2, 4 ... of all parts.
    adding_bytes = std::max<std::uint64_t>(
        adding_bytes, here * (channels * sizeof(float) + (1 + std::bit_width(parts.size())) * sizeof(vec4)));
  }
  if (pixels < whole)
    throw Error(ExitCode::input_unreadable, "found at least " + std::to_string(whole - pixels) +
                                                " pixels in none of the " + std::to_string(files) +
                                                " parts, expected each in one");
  require_memory(whole * (channels * sizeof(float) + exr_writing_bytes(channels)) + adding_bytes,
                 "the picture of all parts");
}

/// Where colours and coverage are among the channels; what splatray-render writes has them all.
std::array<std::size_t, 4> color_channels(const Part& part) {
  std::array<std::size_t, 4> places{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& names = part.header.channels;
    const auto found = std::find(names.begin(), names.end(), std::string(1, "RGBA"[i]));
    if (found == names.end()) refuse(part.file, "no channels R, G, B, A", "an EXR of splatray-render");
    places[i] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

ExrPicture read_values(const Part& part) {
  ExrPicture picture = read_exr(part.file);
  const ExrPicture& header = part.header;
  if (picture.width != header.width || picture.height != header.height || picture.window != header.window ||
      picture.channels != header.channels)
    refuse(part.file, "a file that is being written", "one that stays as it is");
  return picture;
}

/// The mean of parts of the same pixels; what is no colour must be the same in all.
ExrPicture add_samples(const Parts& parts) {
  ExrPicture sum = read_values(parts.front());
  if (parts.size() == 1) return sum;
  const std::array<std::size_t, 4> colors = color_channels(parts.front());
  const std::size_t channels = sum.channels.size(), pixels = sum.values.size() / channels;
  std::vector<vec4> last(pixels);
  SampleMean before;
  const auto each_color = [&](std::vector<float>& values, const auto& exchange) {
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 4; ++c)
        exchange(values[i * channels + colors[c]], last[i][static_cast<glm::length_t>(c)]);
  };
  for (const Part& part : parts) {
    ExrPicture more = read_values(part);
    each_color(more.values, [](float& value, float& mean) { mean = std::exchange(value, 0.0F); });
    if (&part == &parts.front()) sum.values = more.values;
    if (std::memcmp(more.values.data(), sum.values.data(), std::span(sum.values).size_bytes()) != 0)
      refuse(part.file, "other values of a channel that is no colour",
             "those as in '" + parts.front().file.string() + "'");
    if (&part != &parts.back()) before.add(last, part.samples());
  }
  before.join(last, 0, parts.back().samples());
  each_color(sum.values, [](float& value, float& mean) { value = mean; });
  return sum;
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

/// The parts, their metadata those of the whole picture; all of one picture.
std::vector<Parts> read_headers(const std::vector<std::filesystem::path>& files, bool mixed_devices) {
  Parts parts;
  std::uint32_t samples = 0;
  for (const std::filesystem::path& file : files) {
    parts.push_back(read_part_header(file));
    samples = std::max(samples, parts.back().end());
  }
  if (mixed_devices) name_all_devices(parts);
  for (Part& part : parts) {
    require_same_device(part, parts.front());
    name_whole_picture(part, samples);
    require_same_picture(part, parts.front());
  }
  std::vector<Parts> groups = by_place(std::move(parts));
  require_all_pixels(groups, files.size());
  for (const Parts& group : groups) require_all_samples(group, samples);
  return groups;
}

}  // namespace

ExrPicture join_tiles(const std::vector<std::filesystem::path>& files, bool mixed_devices) {
  const std::vector<Parts> groups = read_headers(files, mixed_devices);
  const ExrPicture& header = groups.front().front().header;
  ExrPicture whole{header.width, header.height,  {0, 0, header.width, header.height}, header.channels,
                   {},           header.metadata};
  std::vector<bool> there(std::size_t{header.width} * header.height);
  whole.values.resize(there.size() * header.channels.size());
  for (const Parts& parts : groups) put(add_samples(parts), parts.front().file, whole, there);
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

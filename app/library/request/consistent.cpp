#include "app/library/request/consistent.h"

#include <algorithm>
#include <array>
#include <set>

#include "app/library/codec/picture_format.h"
#include "app/library/request/fields.h"
#include "engine/base/error.h"
#include "engine/image/sample_mean.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

using Names = std::vector<std::string>;

[[noreturn]] void fail(const std::string& sentence) { throw Error(ExitCode::usage, sentence); }

/// "--crop, --tile or --resume".
std::string options_text(const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "--" : (i + 1 == names.size() ? " or --" : ", --")) + names[i];
  return text;
}

/// Fields each of which may not stand beside any of the others.
struct Exclusion {
  Names fields, others;
  std::string why{};  ///< behind the sentence
};
const std::vector<Exclusion>& exclusions() {
  static const Names GOALS{"error", "time"}, SEQUENCES{"turntable", "camera-path"},
      PARTS{"crop", "tile", "sample-offset"}, LENS{"eye", "fov", "lens-shift", "pixel-aspect"};
  static const std::vector<Exclusion> ALL = {
      {{"tile"}, {"crop"}},
      {{"camera-path"}, {"turntable"}},
      {{"despeckle"}, {"denoise", "keep-noise"}},
      {{"xray"}, {"ink"}},
      {LENS, {"camera-path"}, ", as the path has its cameras"},
      {LENS, {"sheet"}, ", as a sheet has its camera"},
      {{"ortho-height", "panorama"}, {"sheet"}, ", as a sheet has its camera"},
      {{"panorama"}, {"camera-path"}, ", as the path has its cameras"},
      {{"panorama"},
       {"ortho-height", "fov", "lens-shift", "pixel-aspect", "aperture", "orbit"},
       ", as a panorama shows all directions from one place"},
      {{"resolution"}, {"sheet"}, ", as scale= and dpi= in the sheet make its size"},
      {SEQUENCES, {"sheet", "resume", "reference"}, ", as these are of a single picture"},
      {GOALS, PARTS, ", as parts of a picture have the same --samples"},
      {GOALS, {"resume"}, ", as that goes up to --samples"},
      {PARTS, {"reference"}, ", as whole pictures are compared"},
      {{"denoise", "despeckle"}, {"tile", "sample-offset"}, ", as parts that are joined keep their noise"},
      {{"denoise", "despeckle"}, {"reference"}, ", as pictures are compared as they were traced"},
      {{"orbit"},
       {"sheet", "turntable", "camera-path", "crop", "tile", "resume", "reference", "lens-shift",
        "pixel-aspect"}}};
  return ALL;
}

/// A field that says something of others alone.
struct Need {
  std::string field;
  Names others;  ///< one of which it needs
};
const std::vector<Need>& needs() {
  static const std::vector<Need> ALL = {
      {"target", {"eye"}},          {"camera-up", {"eye"}},
      {"ortho-height", {"eye"}},    {"ink", {"sheet"}},
      {"xray", {"sheet"}},          {"measures", {"sheet"}},
      {"height-raster", {"sheet"}}, {"frames", {"turntable", "camera-path"}}};
  return ALL;
}

void check_fields(const Request& request) {
  std::set<std::string> asked;
  for (const FieldText& value : changed_values(request)) asked.insert(value.name);
  const auto any = [&asked](const Names& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return asked.count(name) > 0; });
  };
  for (const Exclusion& rule : exclusions())
    for (const std::string& field : rule.fields)
      for (const std::string& other : rule.others)
        if (any({field}) && any({other}))
          fail("found --" + field + " and --" + other + ", expected one of them" + rule.why);
  for (const Need& rule : needs())
    if (any({rule.field}) && !any(rule.others))
      fail("found --" + rule.field + " alone, expected " + options_text(rule.others) + " beside it");
}

void check_sample_range(const Request& request) {
  constexpr std::uint32_t MOST = 65536;
  const std::uint32_t samples = request.settings.samples, offset = request.settings.sample_offset;
  if (offset == 0) return;
  const std::string found =
      "found --sample-offset " + std::to_string(offset) + " with --samples " + std::to_string(samples);
  if (offset % whole_range(samples) != 0)
    fail(found + ", expected a multiple of " + std::to_string(whole_range(samples)));
  if (offset + samples > MOST) fail(found + ", expected at most " + std::to_string(MOST) + " in all");
  if (needs(request.output.aovs, AovSource::noise))
    fail("found --aov error with --sample-offset, expected it for all samples of a picture");
}

void check_noise(const Request& request) {
  const Request::Output& output = request.output;
  const bool denoise = output.denoise.value_or(false);
  if (!denoise && !output.despeckle && !needs(output.aovs, AovSource::noise)) return;
  const std::string option = denoise ? "--denoise" : (output.despeckle ? "--despeckle" : "--aov error");
  if (!request.settings.has_goal() && request.settings.samples < 2)
    fail("found " + option + " with one sample, expected at least two");
  if ((denoise || output.despeckle) && request.look.style == LOOK_PAPER)
    fail("found " + option + " with --look paper, expected a look that has noise");
}

/// What a picture's file must be able to hold.
struct Format {
  bool asked;
  std::string option;  ///< " with --sheet"
  Names extensions;
};

/// Several sheets in one file have no pixels that a part, or a file beside it, could be of.
void check_sheet_set(const Request& request) {
  if (!request.view.sheet || !request.view.sheet->is_set()) return;
  for (const FieldText& value : changed_values(request))
    for (const char* single : {"crop", "tile", "height-raster", "reference", "resume", "sample-offset"})
      if (value.name == single)
        fail("found --" + value.name + " and several sheets of --sheet, expected one of them");
}

void check_format(const Request& request) {
  const Request::Output& output = request.output;
  const std::optional<SheetRequest>& sheet = request.view.sheet;
  const bool is_atlas = sheet && sheet->kind == SheetKind::atlas;
  if (output.path.empty()) return;
  if (!output.film.empty() && !output.many())
    fail("found output '" + output.film.string() +
         "' of a single picture, expected --turntable or --camera-path");
  const std::string extension = lower_extension(output.path);
  const std::array formats = {
      Format{is_atlas, " with an atlas, which has several pages", {".pdf", ".dxf"}},
      Format{sheet && sheet->is_set(), " with several views", {".svg", ".pdf", ".dxf"}},
      Format{output.orbit_columns > 0, " with --orbit", {".html"}},
      Format{!output.measures.empty(), " with --measures", {".svg", ".pdf", ".dxf"}},
      Format{
          !output.height_raster.empty(), " with --height-raster", {".png", ".exr", ".tif", ".svg", ".pdf"}},
      Format{
          request.view.sheet.has_value(), " with --sheet", {".png", ".exr", ".tif", ".svg", ".pdf", ".dxf"}},
      Format{output.aovs != 0, " with --aov", {".exr"}},
      Format{request.settings.transparent && !request.view.sheet,
             " with --background transparent",
             {".png", ".webp", ".exr"}}};
  for (const Format& format : formats) {
    if (!format.asked || std::count(format.extensions.begin(), format.extensions.end(), extension) > 0)
      continue;
    std::string names;
    for (std::size_t i = 0; i < format.extensions.size(); ++i)
      names += (i == 0 ? "" : (i + 1 == format.extensions.size() ? " or " : ", ")) + format.extensions[i];
    fail("found output '" + output.path.string() + "'" + format.option + ", expected a name ending in " +
         names);
  }
  const bool other = request.view.sheet || output.orbit_columns > 0;
  if (!other && !is_picture_format(output.path))
    fail("found output '" + output.path.string() + "', expected a name ending in " + PICTURE_NAMES);
  if (output.many()) (void)frame_file(output.path, 0);
}

void check_size(const Request& request) {
  const PixelWindow made = made_pixels(request.view);
  if (const std::uint32_t most = most_side(request.output.path); std::max(made.width, made.height) > most)
    fail("found a picture of " + std::to_string(made.width) + "x" + std::to_string(made.height) +
         " pixels with a " + lower_extension(request.output.path) + " output, expected at most " +
         std::to_string(most) + " a side, or another format");
}

}  // namespace

void require_part_of(const Request::View& view, std::uint32_t width, std::uint32_t height) {
  if (view.tiles > height)
    fail("found --tile of " + std::to_string(view.tiles) + " parts, expected at most the picture's " +
         std::to_string(height) + " rows");
  const PixelWindow& crop = view.crop;
  if (crop.x + crop.width > width || crop.y + crop.height > height)
    fail("found --crop beyond the picture's " + std::to_string(width) + "x" + std::to_string(height) +
         " pixels, expected a part of it (--resolution)");
}

void require_consistent(const Request& request) {
  check_format(request);
  check_fields(request);
  check_sheet_set(request);
  check_size(request);
  check_noise(request);
  check_sample_range(request);
  const glm::uvec2 size = picture_size(request.view);
  if (!request.view.sheet) require_part_of(request.view, size.x, size.y);
}

}  // namespace splatray

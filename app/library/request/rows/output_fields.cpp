#include <algorithm>
#include <sstream>

#include "app/library/request/fields.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"
#include "engine/image/aovs.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

constexpr FieldGroup OUTPUT = FieldGroup::output;
constexpr const char* VIEWER_GOES_ON = "the viewer's pictures go on by themselves";

std::string aov_names() {
  std::string names;
  for (const Aov& aov : all_aovs()) names += (names.empty() ? "" : ",") + std::string(aov.name);
  return names;
}

Field aov_row() {
  std::string help = "more channels of an EXR picture:";
  for (const Aov& aov : all_aovs()) {
    help += &aov == all_aovs().data() ? " " : "; ";
    help += std::string(aov.name) + " (" + aov.help + ") as";
    for (const char* channel : aov.channels) help += std::string(" ") + channel;
  }
  return value_row(
      "aov", OUTPUT, aov_names(), help,
      [](Request& request, const std::string& text) {
        AovSet& set = request.output.aovs = 0;
        std::istringstream names(text);
        for (std::string name; std::getline(names, name, ',');) {
          const auto found = std::find_if(all_aovs().begin(), all_aovs().end(),
                                          [&](const Aov& aov) { return name == aov.name; });
          if (found == all_aovs().end())
            throw Expected{"a list of " + aov_names() + did_you_mean(name, split_names(aov_names()))};
          set |= 1U << (found - all_aovs().begin());
        }
        request.settings.aov = needs(set, AovSource::centre_ray);
        request.settings.estimate_error = needs(set, AovSource::noise);
      },
      [](const Request& request) {
        std::string text;
        for (std::size_t i = 0; i < all_aovs().size(); ++i)
          if (has_aov(request.output.aovs, i))
            text += (text.empty() ? "" : ",") + std::string(all_aovs()[i].name);
        return text;
      });
}

Field frames_row() {
  return value_row(
      "frames", OUTPUT, "A-B:STEP,...",
      "only these frames of a sequence, such as 0-47 or 0-3,7,9-12:3; default all",
      [](Request& request, const std::string& text) {
        const auto ranges = read_frame_list(text);
        if (!ranges)
          throw Expected{"first-last such as 0-47, or several such as 0-3,7,9-12:3, each up to " +
                         std::to_string(LAST_FRAME)};
        request.output.frames = *ranges;
      },
      [](const Request& request) { return frame_list_text(request.output.frames); });
}

Field orbit_row() {
  Field row = value_row(
      "orbit", OUTPUT, "N[xHEIGHTS]",
      "a page (-o FILE.html) of N pictures all around, from this many heights, in which one turns, zooms and "
      "measures without anything else, such as 36x3; default 0 = none",
      [](Request& request, const std::string& text) {
        constexpr std::uint32_t MOST = 360, MOST_ROWS = 16;
        auto numbers = split_whole_numbers(text, 'x', 2);
        if (numbers.empty()) numbers = split_whole_numbers(text, 'x', 1);
        if (numbers.size() == 1) numbers.push_back(1);
        if (numbers.empty() || numbers[0] > MOST || numbers[1] == 0 || numbers[1] > MOST_ROWS)
          throw Expected{"up to 360 pictures and 16 heights such as 36 or 36x3"};
        request.output.orbit_columns = numbers[0];
        request.output.orbit_rows = numbers[1];
      },
      [](const Request& request) {
        const Request::Output& output = request.output;
        if (output.orbit_columns == 0) return std::string();
        const std::string columns = std::to_string(output.orbit_columns);
        return output.orbit_rows == 1 ? columns : columns + "x" + std::to_string(output.orbit_rows);
      });
  row.between = 'x';
  return row;
}

/// The pictures of a film lie in a folder beside it.
Field output_row() {
  Field row = value_row(
      "output", OUTPUT, "FILE",
      "the picture: .png, .jpg or .webp (sRGB; the last two of quality 95, .jpg without transparency) or "
      ".exr "
      "(linear float); of a sequence with a run of # for the frame's digits such as out.####.png, or a film, "
      ".mp4, by ffmpeg",
      [](Request& request, const std::string& text) {
        const std::filesystem::path path = text;
        const bool is_film = lower_extension(path) == ".mp4";
        request.output.film = is_film ? path : std::filesystem::path();
        request.output.path =
            is_film ? path.parent_path() / (path.stem().string() + ".frames") / "######.png" : path;
      },
      [](const Request& request) {
        const Request::Output& output = request.output;
        return (output.film.empty() ? output.path : output.film).string();
      });
  return needed(with(row, {.letter = "-o"}), "the picture to write: .png, .jpg, .webp or .exr")
      .marked(HAS_OWN_CONTROL);
}

/// Rows that concern a program's run, not a picture.
std::vector<Field> file_fields() {
  constexpr FieldGroup FILES = FieldGroup::files;
  std::vector<Field> rows = {
      path_row("stats-json", FILES, MEMBER(output.stats_json), "write times, counts, bytes and device here"),
      path_row("reference", FILES, MEMBER(output.reference),
               "picture to compare with; exit 1 when they differ"),
      number_row("reference-threshold", FILES, MEMBER(output.reference_threshold), 0.0, 1.0,
                 "allowed error of a pixel, 0..1; default 0.004"),
      number_row("reference-share", FILES, MEMBER(output.reference_share), 0.0, 1.0,
                 "allowed share of pixels beyond it; default 0.0002"),
      number_row("reference-limit", FILES, MEMBER(output.reference_limit), 0.0, 1.0,
                 "no pixel's error may exceed this; default 0.012"),
      switch_row("list-devices", FILES, MEMBER(output.list_devices), "list the Vulkan devices and end"),
      switch_row("quiet", FILES, MEMBER(output.quiet), "only errors on stderr"),
      choice_row<ProgressStyle>("progress", FILES, MEMBER(output.progress),
                                {{"line", ProgressStyle::line},
                                 {"plain", ProgressStyle::plain},
                                 {"json", ProgressStyle::json},
                                 {"openjd", ProgressStyle::openjd}},
                                "how progress is reported: a line on a terminal; lines; a JSON object a "
                                "line; as Open Job Description has it; default line")};
  for (Field& row : rows) {
    row.doors = DOOR_RENDER;
    row.why_not = "of a run of the program, not of a picture";
  }
  rows[0].doors = DOOR_RENDER | DOOR_VIEW | DOOR_PREPROCESS;
  return rows;
}

}  // namespace

std::vector<Field> output_fields() {
  std::vector<Field> rows = {
      output_row(),
      aov_row().marked(NOT_OF_LIGHT | OF_PICTURES),
      with(path_row("resume", OUTPUT, MEMBER(output.resume),
                    "continue this EXR (same command, fewer --samples, or interrupted) up to --samples"),
           {.doors = DOOR_RENDER | DOOR_LIBRARY, .why_not = VIEWER_GOES_ON}),
      with(switch_row("mixed-devices", OUTPUT, MEMBER(output.mixed_devices),
                      "--resume also a picture of another device or driver, whose samples may differ"),
           {.doors = DOOR_RENDER | DOOR_LIBRARY, .why_not = VIEWER_GOES_ON}),
      with(switch_row("lod-error", OUTPUT, MEMBER(output.lod_error),
                      "find on 20 small parts of the (first) picture what points of files in levels that "
                      "were not read change: its mean "
                      "and PSNR with their 95 %, which are said and kept in its metadata and --stats-json"),
           {.doors = DOOR_RENDER | DOOR_LIBRARY,
            .why_not = "the viewer reads finer points as the camera rests"}),
      needed(number_row("turntable", OUTPUT, MEMBER(output.turntable), 0, 999999,
                        "this many pictures of a full turn about the scene's up axis through the target; "
                        "default 0 = none"),
             "so many pictures of a full turn, -o out.####.png or out.mp4")
          .marked(HAS_OWN_CONTROL),
      orbit_row(),
      frames_row().marked(OF_SEQUENCES),
      switch_row("skip-existing", OUTPUT, MEMBER(output.skip_existing),
                 "leave out pictures whose file is whole and was made by the same command")
          .marked(OF_SEQUENCES)};
  for (Field& row : file_fields()) rows.push_back(std::move(row));
  for (Field& row : rows) row.traits |= OF_FILES;
  return rows;
}

}  // namespace splatray

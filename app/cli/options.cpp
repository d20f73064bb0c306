#include "app/cli/options.h"

#include <algorithm>

#include "app/cli/option_types.h"
#include "app/cli/reproduce.h"
#include "app/cli/sequence.h"
#include "app/library/scene_source.h"
#include "engine/base/error.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

/// The channels by their names in --aov.
struct AovName {
  const char* name;
  bool RenderOptions::*member;
};
constexpr AovName AOV_NAMES[] = {{"depth", &RenderOptions::aov_depth},
                                 {"normal", &RenderOptions::aov_normal},
                                 {"id", &RenderOptions::aov_id},
                                 {"error", &RenderOptions::aov_error}};

void read_aovs(const std::string& text, RenderOptions& options) {
  for (const AovName& aov : AOV_NAMES) options.*aov.member = false;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const auto found = std::find_if(std::begin(AOV_NAMES), std::end(AOV_NAMES),
                                    [&](const AovName& aov) { return name == aov.name; });
    if (found == std::end(AOV_NAMES)) refuse_option("--aov", text, "a list of depth, normal, id, error");
    options.*found->member = true;
  }
  options.picture.settings.aov = options.aov_depth || options.aov_normal || options.aov_id;
  options.picture.settings.estimate_error = options.aov_error;
}

std::string aov_text(const RenderOptions& options) {
  std::string text;
  for (const AovName& aov : AOV_NAMES)
    if (options.*aov.member) text += (text.empty() ? "" : ",") + std::string(aov.name);
  return text;
}

/// Parts of a picture, which splatray-merge joins.
void add_part_options(OptionList& list, RenderOptions& options) {
  const auto read_crop = [&options](const std::string& text) {
    const auto numbers = split_whole_numbers(text, ',', 4);
    if (numbers.empty() || numbers[2] == 0 || numbers[3] == 0)
      refuse_option("--crop", text, "pixels X,Y,WIDTH,HEIGHT from the top left corner, such as 0,0,640,360");
    options.crop = {numbers[0], numbers[1], numbers[2], numbers[3]};
  };
  const auto write_crop = [&options] {
    const PixelWindow& crop = options.crop;
    return crop.width == 0 ? std::string()
                           : std::to_string(crop.x) + ',' + std::to_string(crop.y) + ',' +
                                 std::to_string(crop.width) + ',' + std::to_string(crop.height);
  };
  list.add_value(
      "--crop", read_crop, write_crop,
      "only these pixels of the picture, the same as in the whole one; an EXR has them as its data window",
      "X,Y,WIDTH,HEIGHT");
  const auto read_tile = [&options](const std::string& text) {
    const auto numbers = split_whole_numbers(text, '/', 2);
    if (numbers.empty() || numbers[0] == 0 || numbers[0] > numbers[1])
      refuse_option("--tile", text, "a part of so many such as 1/4, the first is 1");
    options.tile = numbers[0];
    options.tiles = numbers[1];
  };
  const auto write_tile = [&options] {
    return options.tiles == 0 ? std::string()
                              : std::to_string(options.tile) + '/' + std::to_string(options.tiles);
  };
  list.add_value("--tile", read_tile, write_tile,
                 "only this one of so many bands of rows; splatray-merge joins them", "I/N");
}

void check_part(const RenderOptions& options) {
  const auto fail = [](const std::string& sentence) { throw Error(ExitCode::usage, sentence); };
  const PixelWindow window = options.window();
  const PictureOptions& picture = options.picture;
  if (options.tiles == 0 && window.width == 0) return;
  if (options.tiles > 0 && options.crop.width > 0) fail("found --crop and --tile, expected one of them");
  if (options.tiles > picture.height)
    fail("found --tile of " + std::to_string(options.tiles) + " parts, expected at most the picture's " +
         std::to_string(picture.height) + " rows");
  if (window.x + window.width > picture.width || window.y + window.height > picture.height)
    fail("found --crop beyond the picture's " + std::to_string(picture.width) + "x" +
         std::to_string(picture.height) + " pixels, expected a part of it (--resolution)");
  const char* part = options.tiles > 0 ? "--tile" : "--crop";
  if (options.has_goal()) fail(std::string("found --error or --time with ") + part + ", expected --samples");
  if (options.denoise)
    fail(std::string("found --denoise with ") + part + ", expected it for a whole picture");
  if (!options.reference.empty())
    fail(std::string("found --reference with ") + part + ", expected a whole picture");
}

void add_output_options(OptionList& list, RenderOptions& options) {
  list.add_value(
      "-o,--output", [&options](const std::string& text) { options.output = text; }, {},
      "the picture: .png (sRGB) or .exr (linear float); of a sequence with a run of # for the "
      "frame's digits such as out.####.png",
      "FILE");
  list.add_words([&options] {
    return options.output.empty() ? Words{} : Words{"-o", options.output.string()};
  });
  const auto read_exposure = [&options](const std::string& text) {
    options.exposure_ev.reset();
    options.exposure_auto = text == "auto";
    if (!options.exposure_auto) options.exposure_ev = read_number<double>("--exposure", text, -60.0, 60.0);
  };
  list.add_value(
      "--exposure", read_exposure,
      [&options] {
        if (options.exposure_ev) return number_text(*options.exposure_ev);
        return std::string(options.exposure_auto ? "auto" : "");
      },
      "brightness of a PNG in stops, or auto: what is seen becomes middle grey on the mean, less where it "
      "would be too bright, as a small picture of the same view tells; default auto for scans, else 0",
      "EV|auto");
  list.add_value(
      "--aov", [&options](const std::string& text) { read_aovs(text, options); },
      [&options] { return aov_text(options); },
      "more channels of an EXR picture: Z, N.X N.Y N.Z, id, error (estimated, of the radiance)",
      "depth,normal,id,error");
  add_number(list, "--error", options.error_goal, 0.0, 1e3,
             "trace until no region of 32 x 32 pixels has more than this relative error, as it is estimated, "
             "such as 0.02, instead of "
             "--samples; default 0 = none");
  add_number(list, "--time", options.seconds_goal, 0.0, 1e9,
             "the best picture in so many seconds of tracing, instead of --samples; beside --error the end "
             "of it; default 0 = none");
  list.add_switch("--denoise", options.denoise,
                  "take the noise out: by Open Image Denoise 2 where it is installed, else by a filter of "
                  "our own; PNGs of "
                  "scans whose look is not asked for go through it anyway");
  list.add_switch("--keep-noise", options.keep_noise, "do not take the noise out of scans' pictures either");
  add_path(list, "--stats-json", options.stats_json, "write times, counts, bytes and device here");
  add_path(list, "--reference", options.reference, "picture to compare with; exit 1 when they differ");
  add_number(list, "--reference-threshold", options.reference_threshold, 0.0, 1.0,
             "allowed error of a pixel, 0..1; default 0.004");
  add_number(list, "--reference-share", options.reference_share, 0.0, 1.0,
             "allowed share of pixels beyond it; default 0.0002");
  add_number(list, "--reference-limit", options.reference_limit, 0.0, 1.0,
             "no pixel's error may exceed this; default 0.012");
  list.add_switch("--list-devices", options.list_devices, "list the Vulkan devices and end");
  list.add_switch("--quiet", options.quiet, "only errors on stderr");
  add_choice<ProgressStyle>(
      list, "--progress", options.progress,
      {{"line", ProgressStyle::line},
       {"plain", ProgressStyle::plain},
       {"json", ProgressStyle::json},
       {"openjd", ProgressStyle::openjd}},
      "how progress is told: a line on a terminal; lines; a JSON object a line; as Open Job Description has "
      "it; default line");
}

void add_sequence_options(OptionList& list, RenderOptions& options) {
  SequenceOptions& sequence = options.sequence;
  list.add_value(
      "--camera-path",
      [&options](const std::string& file) {
        options.sequence.camera_path = file;
        options.picture.eye = options.picture.target = options.picture.camera_up = std::nullopt;
        options.picture.fov_y_deg.reset();
        options.picture.ortho_height = 0.0;
      },
      [&sequence] { return sequence.camera_path.string(); },
      "one picture for each frame of this camera path (JSON: keys, each a camera with its frame)", "FILE");
  add_number(
      list, "--turntable", sequence.turntable, 0, 999999,
      "this many pictures of a full turn about the scene's up axis through the target; default 0 = none");
  const auto read_frames = [&sequence](const std::string& text) {
    const auto ranges = read_frame_list(text);
    if (!ranges)
      refuse_option("--frames", text,
                    "first-last such as 0-47, or several such as 0-3,7,9-12:3, each up to " +
                        std::to_string(LAST_FRAME));
    sequence.frames = *ranges;
  };
  list.add_value(
      "--frames", read_frames, [&sequence] { return frame_list_text(sequence.frames); },
      "only these frames of a sequence, such as 0-47 or 0-3,7,9-12:3; default all", "A-B:STEP,...");
  list.add_switch("--skip-existing", sequence.skip_existing,
                  "leave out pictures whose file is whole and was made by the same command");
}

/// What no single option can check of a sequence.
void check_sequence(const RenderOptions& options) {
  const auto fail = [](const std::string& sentence) { throw Error(ExitCode::usage, sentence); };
  const SequenceOptions& sequence = options.sequence;
  if (!sequence.frames.empty() && !sequence.many())
    fail("found --frames alone, expected --camera-path or --turntable beside it");
  if (sequence.turntable > 0 && !sequence.camera_path.empty())
    fail("found --turntable and --camera-path, expected one of them");
  if (!sequence.camera_path.empty() && (options.picture.eye || options.picture.fov_y_deg))
    fail("found a camera beside --camera-path, expected only the path");
  if (sequence.many() && !options.reference.empty())
    fail("found --reference with a sequence of pictures, expected a single one");
  if (sequence.many() && !options.output.empty()) (void)frame_file(options.output, 0);
}

/// What no single option can check.
void check_together(const RenderOptions& options) {
  const auto fail = [](const std::string& sentence) { throw Error(ExitCode::usage, sentence); };
  const PictureOptions& picture = options.picture;
  if (options.scene.inputs.empty())
    fail("found no SCENE, expected a scene or model file (--help shows all options)");
  require_scene_alone(options.scene.inputs);
  const std::string extension = lower_extension(options.output);
  if (!options.output.empty() && extension != ".png" && extension != ".exr")
    fail("found output '" + options.output.string() + "', expected a name ending in .png or .exr");
  if ((picture.settings.aov || options.aov_error) && extension == ".png")
    fail("found --aov with a .png output, expected .exr");
  if (picture.target && !picture.eye) fail("found --target without --eye, expected both");
  if (picture.ortho_height > 0.0 && !picture.eye) fail("found --ortho without --eye, expected both");
  if (picture.camera_up && !picture.eye) fail("found --camera-up without --eye, expected both");
  if (options.aov_error && !options.has_goal() && picture.settings.samples < 2)
    fail("found --aov error with one sample, expected at least two");
  if (options.denoise && options.keep_noise) fail("found --denoise and --keep-noise, expected one of them");
  if (options.denoise && !options.has_goal() && picture.settings.samples < 2)
    fail("found --denoise with one sample, expected at least two");
  if (options.denoise && picture.look == LOOK_PAPER)
    fail("found --denoise with --look paper, expected a look that has noise");
  if (options.denoise && !options.reference.empty())
    fail("found --denoise with --reference, expected pictures compared as they were traced");
  check_sequence(options);
  check_part(options);
}

/// Reads the words on top of `options`. The program itself also has --help, --version, and --from, which goes into
/// `from`; false when one of the first two was answered.
bool parse_onto(const Words& words, RenderOptions& options, std::filesystem::path* from) {
  OptionList list("Ray-traces a scene of splats into pictures.", "splatray-render");
  add_render_options(list, options);
  if (from != nullptr) {
    list.add_answer(
        "--version", [] { return SPLATRAY_VERSION; }, "print the version");
    add_path(
        list, "--from", *from,
        "make this picture again, from the options kept in it; options beside it replace those, -o defaults "
        "to "
        "its name with .again; relative paths in it are looked for here, then in its folder and those above");
  } else {
    list.remove_help();
  }
  if (!list.parse(words)) return false;
  options.scene.params.seed = options.picture.settings.seed;
  return true;
}

/// What --from stands for: the picture's options, for an output of the name given, if any.
RenderOptions options_from(const std::filesystem::path& picture, const std::filesystem::path& output) {
  RenderOptions options = read_picture_options(picture);
  options.output = picture;
  options.output.replace_extension(".again" + picture.extension().string());
  if (lower_extension(output) == ".png") read_aovs("", options);
  return options;
}

}  // namespace

PixelWindow RenderOptions::window() const {
  if (tiles == 0) return crop;
  const auto row = [this](std::uint32_t part) {
    return static_cast<std::uint32_t>(std::uint64_t{picture.height} * part / tiles);
  };
  return {0, row(tile - 1), picture.width, row(tile) - row(tile - 1)};
}

void add_render_options(OptionList& list, RenderOptions& options) {
  add_scene_options(list, options.scene);
  add_output_options(list, options);
  add_part_options(list, options);
  add_sequence_options(list, options);
  add_picture_options(list, options.picture);
}

RenderOptions parse_render_words(const Words& words) {
  RenderOptions options;
  (void)parse_onto(words, options, nullptr);
  check_together(options);
  return options;
}

std::optional<RenderOptions> parse_render_options(int argc, char** argv) {
  const Words words(argv + std::min(argc, 1), argv + argc);
  RenderOptions options;
  std::filesystem::path from;
  if (!parse_onto(words, options, &from)) return {};
  if (!from.empty()) {
    options = options_from(from, options.output);
    (void)parse_onto(words, options, &from);
  }
  if (options.list_devices) return options;
  check_together(options);
  if (options.output.empty())
    throw Error(ExitCode::usage, "found no output, expected -o with a .png or .exr file");
  return options;
}

}  // namespace splatray

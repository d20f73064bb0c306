#include "app/options.h"

#include <algorithm>

#include "engine/host/error.h"
#include "preprocess/file_extension.h"
#include "preprocess/option_types.h"

namespace splatray {
namespace {

/// The channels by their names in --aov.
struct AovName {
  const char* name;
  bool RenderOptions::*member;
};
constexpr AovName AOV_NAMES[] = {{"depth", &RenderOptions::aov_depth},
                                 {"normal", &RenderOptions::aov_normal},
                                 {"id", &RenderOptions::aov_id}};

void read_aovs(const std::string& text, RenderOptions& options) {
  for (const AovName& aov : AOV_NAMES) options.*aov.member = false;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const auto found = std::find_if(std::begin(AOV_NAMES), std::end(AOV_NAMES),
                                    [&](const AovName& aov) { return name == aov.name; });
    if (found == std::end(AOV_NAMES)) refuse_option("--aov", text, "a list of depth, normal, id");
    options.*found->member = true;
  }
  options.picture.settings.aov = true;
}

std::string aov_text(const RenderOptions& options) {
  std::string text;
  for (const AovName& aov : AOV_NAMES)
    if (options.*aov.member) text += (text.empty() ? "" : ",") + std::string(aov.name);
  return text;
}

void add_output_options(OptionList& list, RenderOptions& options) {
  list.add_option("-o,--output", options.output, "the picture: .png (sRGB) or .exr (linear float)")
      ->type_name("FILE");
  list.add_words([&options] {
    return options.output.empty() ? Words{} : Words{"-o", options.output.string()};
  });
  add_number(list, "--exposure", options.exposure_ev, -60.0, 60.0, "brightness of a PNG in stops; default 0");
  list.add_value(
          "--aov", [&options](const std::string& text) { read_aovs(text, options); },
          [&options] { return aov_text(options); }, "more channels of an EXR picture: Z, N.X N.Y N.Z, id")
      ->type_name("depth,normal,id");
  add_path(list, "--stats-json", options.stats_json, "write times, counts, bytes and device here");
  add_path(list, "--reference", options.reference, "picture to compare with; exit 1 when they differ");
  add_number(list, "--reference-threshold", options.reference_threshold, 0.0, 1.0,
             "allowed error of a pixel, 0..1; default 0.004");
  add_number(list, "--reference-share", options.reference_share, 0.0, 1.0,
             "allowed share of pixels beyond it; default 0.0002");
  add_number(list, "--reference-limit", options.reference_limit, 0.0, 1.0,
             "no pixel's error may exceed this; default 0.012");
  add_switch(list, "--list-devices", options.list_devices, "list the Vulkan devices and end");
  add_switch(list, "--quiet", options.quiet, "only errors on stderr");
}

/// What no single option can check.
void check_together(const RenderOptions& options) {
  const auto fail = [](const std::string& sentence) { throw Error(ExitCode::usage, sentence); };
  const PictureOptions& picture = options.picture;
  if (options.scene.inputs.empty())
    fail("found no SCENE, expected a scene or model file (--help shows all options)");
  const std::size_t scenes = static_cast<std::size_t>(
      std::count_if(options.scene.inputs.begin(), options.scene.inputs.end(),
                    [](const auto& path) { return lower_extension(path) == ".soct"; }));
  if (scenes > 0 && options.scene.inputs.size() > 1)
    fail("found a .soct beside other inputs, expected it alone");
  const std::string extension = lower_extension(options.output);
  if (!options.output.empty() && extension != ".png" && extension != ".exr")
    fail("found output '" + options.output.string() + "', expected a name ending in .png or .exr");
  if (picture.settings.aov && extension == ".png") fail("found --aov with a .png output, expected .exr");
  if (picture.target && !picture.eye) fail("found --target without --eye, expected both");
  if (picture.ortho_height > 0.0 && !picture.eye) fail("found --ortho without --eye, expected both");
  if (picture.camera_up && !picture.eye) fail("found --camera-up without --eye, expected both");
}

}  // namespace

void add_render_options(OptionList& list, RenderOptions& options) {
  add_scene_options(list, options.scene);
  add_output_options(list, options);
  add_picture_options(list, options.picture);
}

std::optional<RenderOptions> parse_render_words(const Words& words) {
  RenderOptions options;
  OptionList list("Ray-traces a scene of splats into a picture.", "splatray-render");
  list.set_version_flag("--version", SPLATRAY_VERSION);
  add_render_options(list, options);
  if (!parse_options(list, words)) return {};
  options.scene.params.seed = options.picture.settings.seed;
  if (!options.list_devices) check_together(options);
  return options;
}

std::optional<RenderOptions> parse_render_options(int argc, char** argv) {
  const auto options = parse_render_words(Words(argv + std::min(argc, 1), argv + argc));
  if (options && !options->list_devices && options->output.empty())
    throw Error(ExitCode::usage, "found no output, expected -o with a .png or .exr file");
  return options;
}

}  // namespace splatray

#include "app/options.h"

#include <algorithm>

#include "app/materials.h"
#include "engine/host/error.h"
#include "preprocess/file_extension.h"
#include "preprocess/option_types.h"

namespace splatray {
namespace {

void add_resolution(CLI::App& app, PictureOptions& picture) {
  app.add_option_function<std::string>(
         "--resolution",
         [&picture](const std::string& text) {
           constexpr double MOST = 32768.0;
           const auto numbers = split_numbers(text, 'x', 2);
           const bool good = !numbers.empty() && numbers[0] >= 1.0 && numbers[0] <= MOST &&
                             numbers[1] >= 1.0 && numbers[1] <= MOST &&
                             numbers[0] == std::floor(numbers[0]) && numbers[1] == std::floor(numbers[1]);
           if (!good)
             refuse_option("--resolution", text, "width x height such as 1920x1080, each 1 to 32768");
           picture.width = static_cast<std::uint32_t>(numbers[0]);
           picture.height = static_cast<std::uint32_t>(numbers[1]);
         },
         "size of the picture, pixels; default 1920x1080")
      ->type_name("WxH");
}

void add_scene_options(CLI::App& app, SceneOptions& scene) {
  app.add_option("SCENE", scene.inputs,
                 "a .soct scene, or what splatray-preprocess reads: .ply .obj .stl .vtp .gltf .glb")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_build_options(app, scene, "--points");
  std::vector<Choice<std::string>> materials;
  for (const std::string& name : material_names()) materials.push_back({name, name});
  add_choice(app, "--material", scene.material, materials,
             "material of a scene with one object; glass and ruby need a closed one");
}

void add_camera_options(CLI::App& app, PictureOptions& picture) {
  add_resolution(app, picture);
  add_vector(app, "--eye", picture.eye,
             "camera position; default: the scene's camera, else a view of the whole scene");
  add_vector(app, "--target", picture.target, "point looked at; default the scene's centre; needs --eye");
  add_vector(app, "--up", picture.up,
             "up direction of the camera, the scene and its environment; default the scene's");
  app.add_option_function<std::string>(
         "--fov",
         [&picture](const std::string& text) {
           const auto numbers = split_numbers(text, ',', 1);
           if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] < 180.0))
             refuse_option("--fov", text, "degrees between 0 and 180");
           picture.fov_y_deg = numbers[0];
         },
         "vertical field of view; default 30")
      ->type_name("DEG");
  add_number(app, "--ortho", picture.ortho_height, 0.0, 1e30,
             "orthographic picture of this height, world units; needs --eye");
}

void add_light_options(CLI::App& app, PictureOptions& picture) {
  Settings& settings = picture.settings;
  add_vector(app, "--light", picture.light,
             "a point light here, irradiance pi at the scene's centre, instead of the scene's lights");
  app.add_option(
         "--env", picture.environment,
         "environment: an HDR or EXR file (latitude-longitude), white, black, studio or a radiance r,g,b; "
         "default: the scene's, else studio with a key light")
      ->type_name("FILE|NAME");
  add_number(app, "--env-strength", settings.environment_strength, 0.0, 1e6,
             "factor on the environment; default 1");
  add_number(app, "--env-turn", settings.environment_turn, -1e6, 1e6,
             "turns of the environment about the up axis; default 0");
}

void add_method_options(CLI::App& app, PictureOptions& picture) {
  Settings& settings = picture.settings;
  add_number(app, "--samples", settings.samples, 1, 65536, "samples per pixel; default 16");
  add_number(app, "--seed", settings.seed, 0, 4294967295.0, "seed of samples and sampled points; default 1");
  add_number(app, "--max-bounces", settings.max_bounces, 0, 64, "most secondary rays in a path; default 8");
  add_choice<bool>(app, "--shadows", settings.shadows, {{"on", true}, {"off", false}}, "default on");
  add_choice<std::uint32_t>(
      app, "--blend", settings.blend,
      {{"window", BLEND_WINDOW}, {"paper", BLEND_PAPER}, {"nearest", BLEND_NEAREST}, {"leaf", BLEND_LEAF}},
      "blending of the splats at a hit; leaf = the first leaf's only, which shows seams; default window");
  add_choice<std::uint32_t>(app, "--kernel", settings.kernel,
                            {{"rim", KERNEL_RIM}, {"gaussian", KERNEL_GAUSSIAN}},
                            "weight of a splat over its disc; default rim (zero there)");
  add_number(app, "--kappa", settings.kappa, 1e-6, 1e6, "blending depth in splat radii; default 1");
  add_choice<std::uint32_t>(app, "--side", settings.side,
                            {{"side", SIDE_SIDE}, {"delta", SIDE_DELTA}, {"none", SIDE_NONE}},
                            "how secondary rays leave their surface; default side");
  app.add_option("--delta", picture.delta_world,
                 "minimum distance of --side delta, world units; default diagonal / 1000");
  add_choice<std::uint32_t>(app, "--order", settings.order, {{"z", ORDER_Z}, {"linear", ORDER_LINEAR}},
                            "order of threads over pixels; default z");
  app.add_flag("--counters", settings.counters, "count rays, steps and tests (slower) for --stats-json");
  app.add_option("--device", picture.device, "device number or part of its name; default the best")
      ->type_name("N|NAME");
}

void add_aovs(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "--aov",
         [&options](const std::string& text) {
           std::istringstream names(text);
           for (std::string name; std::getline(names, name, ',');) {
             if (name == "depth")
               options.aov_depth = true;
             else if (name == "normal")
               options.aov_normal = true;
             else if (name == "id")
               options.aov_id = true;
             else
               refuse_option("--aov", text, "a list of depth, normal, id");
           }
           options.picture.settings.aov = true;
         },
         "more channels of an EXR picture: Z, N.X N.Y N.Z, id")
      ->type_name("depth,normal,id");
}

void add_output_options(CLI::App& app, RenderOptions& options) {
  app.add_option("-o,--output", options.output, "the picture: .png (sRGB) or .exr (linear float)")
      ->type_name("FILE");
  add_number(app, "--exposure", options.exposure_ev, -60.0, 60.0, "brightness of a PNG in stops; default 0");
  add_aovs(app, options);
  app.add_option("--stats-json", options.stats_json, "write times, counts, bytes and device here")
      ->type_name("FILE");
  app.add_option("--reference", options.reference, "picture to compare with; exit 1 when they differ")
      ->type_name("FILE");
  add_number(app, "--reference-threshold", options.reference_threshold, 0.0, 1.0,
             "allowed error of a pixel, 0..1; default 0.004");
  add_number(app, "--reference-share", options.reference_share, 0.0, 1.0,
             "allowed share of pixels beyond it; default 0.0002");
  add_number(app, "--reference-limit", options.reference_limit, 0.0, 1.0,
             "no pixel's error may exceed this; default 0.012");
  app.add_flag("--list-devices", options.list_devices, "list the Vulkan devices and end");
  app.add_flag("--quiet", options.quiet, "only errors on stderr");
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
  if (options.output.empty()) fail("found no output, expected -o with a .png or .exr file");
  if (extension != ".png" && extension != ".exr")
    fail("found output '" + options.output.string() + "', expected a name ending in .png or .exr");
  if (picture.settings.aov && extension != ".exr") fail("found --aov with a .png output, expected .exr");
  if (picture.target && !picture.eye) fail("found --target without --eye, expected both");
  if (picture.ortho_height > 0.0 && !picture.eye) fail("found --ortho without --eye, expected both");
  if (picture.delta_world && !(*picture.delta_world >= 0.0))
    fail("found a negative --delta, expected 0 or more");
}

std::string joined_command_line(int argc, char** argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += " " + std::string(argv[i]);
  return line;
}

}  // namespace

std::optional<RenderOptions> parse_render_options(int argc, char** argv) {
  RenderOptions options;
  CLI::App app("Ray-traces a scene of splats into a picture.", "splatray-render");
  app.set_version_flag("--version", SPLATRAY_VERSION);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);  // so that scripts can append
  add_scene_options(app, options.scene);
  add_output_options(app, options);
  add_camera_options(app, options.picture);
  add_light_options(app, options.picture);
  add_method_options(app, options.picture);
  if (!parse_options(app, argc, argv)) return {};
  add_data_folder(options.scene);
  options.scene.params.seed = options.picture.settings.seed;
  options.command_line = joined_command_line(argc, argv);
  if (!options.list_devices) check_together(options);
  return options;
}

std::optional<ViewOptions> parse_view_options(int argc, char** argv) {
  ViewOptions options;
  options.picture.width = options.picture.height = 0;
  CLI::App app("Shows a scene of splats in a window.", "splatray-view");
  app.set_version_flag("--version", SPLATRAY_VERSION);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_scene_options(app, options.scene);
  add_camera_options(app, options.picture);
  add_light_options(app, options.picture);
  add_method_options(app, options.picture);
  app.add_option("--stats-json", options.stats_json, "stats");
  if (!parse_options(app, argc, argv)) return {};
  add_data_folder(options.scene);
  options.scene.params.seed = options.picture.settings.seed;
  return options;
}

}  // namespace splatray

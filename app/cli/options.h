/// The command lines of splatray-render and splatray-view. What each option means stands in options.cpp
/// and picture_options.cpp, as its help text.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/build_options.h"
#include "app/cli/frame_list.h"
#include "app/cli/object_options.h"
#include "app/library/attributes.h"
#include "app/library/display_image.h"
#include "engine/base/progress.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray {

class OptionList;

/// Where the scene comes from: one .soct, or files that preprocess reads.
struct SceneOptions : BuildOptions {
  std::string material;  ///< a name of materials.h; empty = as the input says

  bool operator==(const SceneOptions&) const = default;
};

/// A light, world space.
struct LightOptions {
  std::uint32_t kind = LIGHT_POINT;  ///< LIGHT_*
  glm::dvec3 position{
      0.0};  ///< point: position; directional: towards the light, any length > 0; rectangle: its centre
  /// As SceneLight's; unset = irradiance pi, of a point light at the scene's centre, of a rectangle at its target.
  std::optional<glm::vec3> power;
  double size = 0.0;       ///< point: radius; directional: angular diameter, degrees; 0 = none
  glm::dvec3 target{0.0};  ///< rectangle: what it shines at
  glm::dvec2 edges{0.0};   ///< rectangle: width and height; the width is level

  bool operator==(const LightOptions&) const = default;
};

/// What is seen of it, and how.
struct PictureOptions {
  std::uint32_t width = 1920, height = 1080;  ///< pixels
  std::optional<glm::dvec3> eye, target;      ///< world
  std::optional<glm::dvec3> up;               ///< world; of the scene, its environment and the camera
  std::optional<glm::dvec3> camera_up;        ///< world; of the camera, where that is another
  std::optional<double> fov_y_deg;
  Viewpoint viewpoint = Viewpoint::automatic;       ///< where no eye is given
  double ortho_height = 0.0;                        ///< world units; 0 = perspective
  std::optional<std::vector<LightOptions>> lights;  ///< unset = the scene's, or the default ones
  std::vector<ObjectOptions> objects;               ///< changes to materials, in this order
  AttributeOptions attributes;                      ///< what is shown of the points' attributes
  std::string environment;            ///< --env as written; empty = the scene's, else the studio
  std::optional<double> delta_world;  ///< --delta; unset = 1/1000 of the scene's diagonal
  std::optional<std::uint32_t> look;  ///< LOOK_*; unset: as choose_look has it
  double aperture_world = 0.0;        ///< diameter of the lens
  std::optional<Tone> tone;           ///< unset: as choose_tone has it
  Settings settings;
  std::string device;  ///< number or part of a name; empty = best

  bool operator==(const PictureOptions&) const = default;
};

/// The tone curve: that of --tone, else Tone::soft with --look paper and Tone::neutral otherwise.
[[nodiscard]] Tone choose_tone(const PictureOptions& picture);

/// Makes the picture's camera exactly this one.
void set_camera(PictureOptions& picture, const Camera& camera);

/// Which pictures make a sequence; with neither a camera path nor a turntable there is one, a still.
struct SequenceOptions {
  std::filesystem::path camera_path;  ///< camera_file.h; empty = none
  std::uint32_t turntable = 0;        ///< frames of a full turn, 0.. turntable - 1; 0 = none
  std::vector<FrameRange> frames;     ///< empty = all
  bool skip_existing = false;         ///< leave out pictures that exist

  /// Whether the output is a pattern of names.
  [[nodiscard]] bool many() const { return turntable > 0 || !camera_path.empty(); }
  bool operator==(const SequenceOptions&) const = default;
};

struct RenderOptions {
  SceneOptions scene;
  PictureOptions picture;
  SequenceOptions sequence;
  std::filesystem::path output;
  double error_goal = 0.0;    ///< Goal::error; 0 = none
  double seconds_goal = 0.0;  ///< Goal::seconds; 0 = none

  /// Whether a picture is traced until it is good enough, instead of by Settings::samples.
  [[nodiscard]] bool has_goal() const { return error_goal > 0.0 || seconds_goal > 0.0; }
  PixelWindow crop{};                 ///< what of the picture is made; without pixels: all
  std::uint32_t tile = 0, tiles = 0;  ///< of so many bands of rows this one, from 1 on; 0 = all
  /// View::window: that of crop or tile.
  [[nodiscard]] PixelWindow window() const;
  bool denoise = false;
  bool keep_noise = false;  ///< also of scans, whose pictures are denoised where nothing else is asked for
  std::optional<double> exposure_ev;  ///< stops, PNG only; unset = automatic for scans, else 0
  bool exposure_auto = false;         ///< unset = automatic for all
  bool aov_depth = false, aov_normal = false, aov_id = false, aov_error = false;
  std::filesystem::path stats_json;    ///< empty = none
  std::filesystem::path reference;     ///< empty = no comparison
  double reference_threshold = 0.004;  ///< allowed error of a pixel, display-encoded 0..1
  double reference_share = 0.0002;     ///< allowed share of pixels beyond it
  double reference_limit = 0.012;      ///< no pixel may be beyond this
  bool list_devices = false;
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::line;

  bool operator==(const RenderOptions&) const = default;
};

/// Adds what says which scene it is, or how it is seen, to a program's options.
void add_scene_options(OptionList& list, SceneOptions& scene);
void add_picture_options(OptionList& list, PictureOptions& picture);
/// Adds all options of splatray-render.
void add_render_options(OptionList& list, RenderOptions& options);

/// The options of the words after splatray-render; the output may be missing, and --help, --version and --from are
/// unknown. Throws Error (usage), one sentence.
[[nodiscard]] RenderOptions parse_render_words(const std::vector<std::string>& words);
/// The program's options, output included; those of --from's picture where nothing else is given. Nothing when help or
/// version was asked for and printed. Throws Error (usage), one sentence, and what reading a picture throws.
[[nodiscard]] std::optional<RenderOptions> parse_render_options(int argc, char** argv);

}  // namespace splatray

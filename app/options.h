/// The command lines of splatray-render and splatray-view. What each option means stands in options.cpp, as
/// its help text.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/host/scene.h"
#include "engine/host/view.h"
#include "preprocess/build_options.h"

namespace splatray {

/// Where the scene comes from: one .soct, or files that preprocess reads.
struct SceneOptions : BuildOptions {
  std::string material;  ///< a name of materials.h; empty = as the input says
};

/// What is seen of it, and how.
struct PictureOptions {
  std::uint32_t width = 1920, height = 1080;  ///< pixels
  std::optional<glm::dvec3> eye, target, up;  ///< world
  std::optional<double> fov_y_deg;
  double ortho_height = 0.0;          ///< world units; 0 = perspective
  std::optional<glm::dvec3> light;    ///< position of a point light, world
  std::string environment;            ///< --env as written; empty = the scene's, else the studio
  std::optional<double> delta_world;  ///< --delta; unset = 1/1000 of the scene's diagonal
  Settings settings;
  std::string device;  ///< number or part of a name; empty = best
};

struct RenderOptions {
  SceneOptions scene;
  PictureOptions picture;
  std::filesystem::path output;
  double exposure_ev = 0.0;  ///< stops, PNG only
  bool aov_depth = false, aov_normal = false, aov_id = false;
  std::filesystem::path stats_json;    ///< empty = none
  std::filesystem::path reference;     ///< empty = no comparison
  double reference_threshold = 0.004;  ///< allowed error of a pixel, display-encoded 0..1
  double reference_share = 0.0002;     ///< allowed share of pixels beyond it
  double reference_limit = 0.012;      ///< no pixel may be beyond this
  bool list_devices = false;
  bool quiet = false;
  std::string command_line;  ///< as given, for the picture's metadata
};

struct ViewOptions {
  SceneOptions scene;  ///< may name no file
  PictureOptions picture;  ///< the size is the window's; 0 x 0 = as it was last
  double exposure_ev = 0.0;          ///< stops
  std::filesystem::path stats_json;  ///< empty = none
};
[[nodiscard]] std::optional<ViewOptions> parse_view_options(int argc, char** argv);

/// The options, or nothing when help or version was asked for and printed. Throws Error (usage), one
/// sentence.
[[nodiscard]] std::optional<RenderOptions> parse_render_options(int argc, char** argv);

}  // namespace splatray

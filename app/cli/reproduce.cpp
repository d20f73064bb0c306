#include "app/cli/reproduce.h"

#include <algorithm>

#include "app/cli/command_line.h"
#include "app/library/image_file.h"
#include "app/library/scene_source.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// Only what decides how a picture looks: a picture from elsewhere must not name files to write.
RenderOptions looks_only(const RenderOptions& options) {
  RenderOptions looks;
  looks.scene = options.scene;
  looks.picture = options.picture;
  looks.exposure_ev = options.exposure_ev;
  looks.exposure_auto = options.exposure_auto;
  looks.aov_depth = options.aov_depth;
  looks.aov_normal = options.aov_normal;
  looks.aov_id = options.aov_id;
  looks.aov_error = options.aov_error;
  looks.error_goal = options.error_goal;
  looks.seconds_goal = options.seconds_goal;
  looks.denoise = options.denoise;
  looks.keep_noise = options.keep_noise;
  looks.crop = options.crop;
  looks.tile = options.tile;
  looks.tiles = options.tiles;
  return looks;
}

/// Where a path kept in a picture leads now; itself when nothing is found.
fs::path find_beside(const fs::path& path, const fs::path& picture) {
  std::error_code error;
  if (path.is_absolute() || fs::exists(path, error)) return path;
  const fs::path home = fs::absolute(picture, error).parent_path();
  fs::path folder = picture.parent_path();
  for (auto depth = std::distance(home.begin(), home.end()); depth > 0; --depth) {
    if (fs::exists(folder / path, error)) return folder / path;
    folder /= "..";
  }
  return path;
}

}  // namespace

RenderOptions still_options(const RenderOptions& options, const Camera& camera) {
  RenderOptions still = looks_only(options);
  set_camera(still.picture, camera);
  return still;
}

RenderOptions read_picture_options(const fs::path& picture) {
  const auto refuse = [&](const std::string& found) {
    throw Error(ExitCode::input_unreadable, "cannot read options from picture '" + picture.string() +
                                                "': " + found + ", expected a picture of splatray-render");
  };
  const Metadata metadata = read_metadata(picture);
  const auto line = std::find_if(metadata.begin(), metadata.end(),
                                 [](const auto& entry) { return entry.first == "command_line"; });
  if (line == metadata.end()) refuse("found no splatray.command_line in it");
  RenderOptions options;
  try {
    options = looks_only(parse_command_line(line->second));
  } catch (const Error& error) {
    refuse(error.what());
  }
  for (fs::path& input : options.scene.inputs) input = find_beside(input, picture);
  for (fs::path& folder : options.scene.data_paths) folder = find_beside(folder, picture);
  std::string& environment = options.picture.environment;
  if (!environment.empty() && !built_in_environment(environment))
    environment = find_beside(environment, picture).string();
  return options;
}

}  // namespace splatray

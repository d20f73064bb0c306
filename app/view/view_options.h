/// The command line of splatray-view: scene, picture and method as splatray-render has them.
#pragma once
#include <filesystem>
#include <optional>

#include "app/cli/options.h"

namespace splatray {

struct ViewOptions {
  SceneOptions scene;      ///< may name no file
  PictureOptions picture;  ///< the size is the window's, screen coordinates; 0 x 0 = as it was last
  std::optional<double> exposure_ev;  ///< stops; unset = automatic for scans, else 0
  std::filesystem::path stats_json;   ///< empty = none
};

/// The options, or nothing when help, with the table of keys, or version was asked for and printed. Throws Error (usage),
/// one sentence.
[[nodiscard]] std::optional<ViewOptions> parse_view_options(int argc, char** argv);

}  // namespace splatray

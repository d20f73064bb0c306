/// What the programs can be told about reading and preprocessing, with the same words in each.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/host/scene.h"

namespace CLI {
class App;
}

namespace splatray {

/// Input files and how they become a scene.
struct BuildOptions {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path>
      data_paths;  ///< folders for models a scene names; SPLATRAY_DATA_DIR comes last
  BuildParams params;
  unsigned threads = 0;  ///< 0 = all cores
};

/// Adds the options. `samples_name` is the option for points sampled on meshes: --samples where that cannot
/// mean samples per pixel, else --points.
void add_build_options(CLI::App& app, BuildOptions& options, const std::string& samples_name);

/// Appends the folder of the variable SPLATRAY_DATA_DIR to the data paths, if it is set.
void add_data_folder(BuildOptions& options);

}  // namespace splatray

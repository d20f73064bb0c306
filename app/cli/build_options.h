/// What the programs can be told about reading and preprocessing, with the same words in each.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "preprocess/points.h"

namespace splatray {

class OptionList;

/// Input files and how they become a scene.
struct BuildOptions {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::filesystem::path> data_paths;  ///< folders for models a scene names
  BuildParams params;
  ScanOptions scans;
  unsigned threads = 0;  ///< 0 = all cores

  bool operator==(const BuildOptions&) const = default;
};

/// Adds the options. `samples_name` is the option for points sampled on meshes: --samples where that cannot
/// mean samples per pixel, else --points.
void add_build_options(OptionList& list, BuildOptions& options, const std::string& samples_name);

/// Folders for models a scene names: the data paths, then the variable SPLATRAY_DATA_DIR where it is set.
[[nodiscard]] std::vector<std::filesystem::path> model_folders(const BuildOptions& options);

/// What reading needs to know of the options.
[[nodiscard]] ReadOptions read_options(const BuildOptions& options, const Progress& progress);

}  // namespace splatray

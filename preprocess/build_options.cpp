#include "preprocess/build_options.h"

#include <cstdlib>

#include "preprocess/option_types.h"

namespace splatray {

void add_build_options(CLI::App& app, BuildOptions& options, const std::string& samples_name) {
  constexpr double MOST_WHOLE = 9007199254740992.0;  // 2^53: whole numbers are exact up to here
  BuildParams& params = options.params;
  app.add_option("--data-path", options.data_paths,
                 "folder searched for models a scene names; repeatable; then the variable SPLATRAY_DATA_DIR")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FOLDER");
  add_number(app, samples_name, params.samples, 0, MOST_WHOLE,
             "points sampled on meshes by area; default 0 = their vertices where fine enough");
  add_number(app, "--leaf-size", params.leaf_size, 1, 65536,
             "most splat centres in an octree leaf; default 10");
  add_choice<Insertion>(
      app, "--insertion", params.insertion,
      {{"overlap", Insertion::overlap}, {"probe", Insertion::probe}, {"centre", Insertion::centre}},
      "leaves a splat goes into; default overlap");
  add_number(app, "--probes", params.probes, 1, 65536,
             "probe rays per leaf for --insertion probe; default 32");
  add_choice<RadiusRule>(app, "--radius-rule", params.radius_rule,
                         {{"coverage", RadiusRule::coverage}, {"knn", RadiusRule::knn}},
                         "radii of points that have none; default coverage");
  add_number(app, "--radius-scale", params.radius_scale, 1e-6, 1e6, "factor on every radius; default 1");
  add_choice<bool>(app, "--normal-fields", params.normal_fields, {{"on", true}, {"off", false}},
                   "how normals change across each disc, where the scene curves; default on");
  add_number(app, "--threads", options.threads, 0, 4096, "threads of the preprocess; default 0 = all cores");
}

void add_data_folder(BuildOptions& options) {
  if (const char* folder = std::getenv("SPLATRAY_DATA_DIR")) options.data_paths.emplace_back(folder);
}

}  // namespace splatray

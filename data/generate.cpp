/// splatray-generate MODEL -o FOLDER: writes the point clouds of a built-in scene or shape, one PLY file per
/// object.
#include <cstdio>

#include "app/cli/option_types.h"
#include "data/models.h"
#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace splatray {
namespace {

struct Options {
  std::string model;
  std::filesystem::path folder;
  Sampling sampling{.count = 1'000'000};
  bool random = false;
  ModelOptions model_options;
};

std::string model_names(const std::string& between = ", ") {
  std::string names;
  for (const auto& [name, make] : models()) names += (names.empty() ? "" : between) + name;
  return names;
}

void add_options(OptionList& list, Options& options) {
  add_text(list, "MODEL", options.model, "one of " + model_names(), model_names("|"));
  list.require("MODEL");
  add_path(list, "-o,--output", options.folder, "folder to write to, made when missing", "FOLDER");
  list.require("--output");
  add_number(list, "--points", options.sampling.count, 1, 1U << 30U, "points in all, about; default 1000000");
  add_number(list, "--seed", options.sampling.seed, 0, 4294967295.0,
             "random sequence, or shift of the even lattice; default 1");
  list.add_switch("--random", options.random,
                  "independent random points (white noise) in place of even ones");
  add_number(list, "--angle", options.model_options.angle_deg, 1.0, 179.0,
             "wedge: opening angle, degrees; default 60");
  list.set_brief("MODEL", "one of " + model_names());
  list.set_brief("--output", "folder to write to");
  list.set_brief("--points", "points in all, about; default 1000000");
  list.set_brief("--random", "independent random points in place of even ones");
  list.set_examples(
      {{"splatray-generate demo -o points", "the scene of the picture that app/demo makes"},
       {"splatray-generate torus -o points --points 100000", "a torus of fewer points"},
       {"splatray-generate sphere -o points --random --seed 7", "points as independent samples have them"}});
}

void generate(const Options& options) {
  const auto maker = models().find(options.model);
  if (maker == models().end()) {
    std::vector<std::string> names;
    for (const auto& [name, make] : models()) names.push_back(name);
    throw Error(ExitCode::usage, "found model '" + options.model + "', expected one of " + model_names() +
                                     did_you_mean(options.model, names));
  }
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure) {
    throw Error(ExitCode::failed, options.folder.string() + ": cannot be made: " + failure.message());
  }
  Sampling sampling = options.sampling;
  sampling.even = !options.random;
  for (const auto& [object, points] : sample(maker->second(options.model_options), sampling)) {
    const std::filesystem::path path = options.folder / (object + ".ply");
    write_ply(points, path);
    std::printf("%9zu points  %s\n", points.position.size(), path.c_str());
  }
}

int run(int argc, char** argv) {
  Options options;
  OptionList list("Writes the point clouds of a built-in scene or shape, one PLY file per object.",
                  "splatray-generate");
  add_options(list, options);
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  generate(options);
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray

int main(int argc, char** argv) { return splatray::run_main("splatray-generate", splatray::run, argc, argv); }

/// splatray-generate MODEL -o FOLDER: writes the point clouds of a built-in scene or shape, one PLY file per
/// object.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "data/models.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

struct Options {
  std::string model;
  std::filesystem::path folder;
  Sampling sampling{.count = 1'000'000};
  bool random = false;
  ModelOptions model_options;
};

std::string model_names() {
  std::string names;
  for (const auto& [name, make] : models()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("MODEL", options.model, "one of " + model_names())->required();
  app.add_option("-o,--output", options.folder, "folder to write to, made when missing")->required();
  app.add_option("--points", options.sampling.count, "points in all, about")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1U << 30));
  app.add_option("--seed", options.sampling.seed, "random sequence, or shift of the even lattice")
      ->capture_default_str();
  app.add_flag("--random", options.random, "independent random points (white noise) in place of even ones");
  app.add_option("--angle", options.model_options.angle_deg, "wedge: opening angle, degrees")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 179.0));
}

void generate(const Options& options) {
  const auto maker = models().find(options.model);
  if (maker == models().end()) {
    throw Error(ExitCode::usage, "found model '" + options.model + "', expected one of " + model_names());
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
  CLI::App app("Writes the point clouds of a built-in scene or shape, one PLY file per object.");
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw Error(ExitCode::usage, std::string(error.what()) + " (--help lists the options)");
  }
  generate(options);
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray

int main(int argc, char** argv) { return splatray::run_main("splatray-generate", splatray::run, argc, argv); }

/// splatray-generate MODEL -o FOLDER: writes the point clouds of a built-in scene or shape, one PLY file per
/// object.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "data/models.h"
#include "engine/host/error.h"

namespace splatray {
namespace {

struct Options {
  std::string model;
  std::filesystem::path folder;
  Sampling sampling{.count = 1'000'000};
  ModelOptions model_options;
};

std::string model_names() {
  std::string names;
  for (const auto& [name, make] : models()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

Options parse(int argc, char** argv) {
  Options options;
  bool random = false;
  CLI::App app("Writes the point clouds of a built-in scene or shape, one PLY file per object",
               "splatray-generate");
  app.add_option("model", options.model, "one of " + model_names())->required();
  app.add_option("-o,--output", options.folder, "folder, made when missing")->required();
  app.add_option("--points", options.sampling.count, "points in all, about")->capture_default_str();
  app.add_option("--seed", options.sampling.seed, "random sequence, or shift of the even lattice")
      ->capture_default_str();
  app.add_flag("--random", random, "independent random points (white noise) in place of even ones");
  app.add_option("--angle", options.model_options.angle_deg, "wedge: opening angle, degrees")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    std::exit(0);
  } catch (const CLI::ParseError& error) {
    throw Error(ExitCode::usage, error.what());
  }
  options.sampling.even = !random;
  return options;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const auto maker = models().find(options.model);
  if (maker == models().end()) {
    throw Error(ExitCode::usage, "found model '" + options.model + "', expected one of " + model_names());
  }
  std::error_code failure;
  std::filesystem::create_directories(options.folder, failure);
  if (failure)
    throw Error(ExitCode::failed, options.folder.string() + ": cannot be made: " + failure.message());
  for (const auto& [object, cloud] : sample(maker->second(options.model_options), options.sampling)) {
    const std::filesystem::path path = options.folder / (object + ".ply");
    write_ply(cloud, path);
    std::printf("%9zu points  %s\n", cloud.position.size(), path.c_str());
  }
  return 0;
}

}  // namespace
}  // namespace splatray

int main(int argc, char** argv) { return splatray::run_main("splatray-generate", splatray::run, argc, argv); }

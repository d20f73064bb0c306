/// splatray-guard WHAT ARGUMENT...: inputs and figures for tests/bench/guard, which says what is measured. Figures are JSON on stdout.
///   model MESH FOLDER, raw MESH|body FOLDER, room FOLDER, walls FOLDER, thinned SCAN FOLDER, bare SCAN PLY, colours SCAN FOLDER: make inputs (inputs.h)
///   picture MESH (CAMERA.json PICTURE.exr)..., points SCAN TRUTH DRAWN.ply, light PICTURE.exr, parts PICTURE.exr N: figures (figures.h)
///   sheet LAST.png SHEET.png PICTURE.png...: contact_sheet.h
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/library/camera_file.h"
#include "engine/base/error.h"
#include "tests/bench/regression/contact_sheet.h"
#include "tests/bench/regression/figures.h"
#include "tests/bench/regression/inputs.h"

namespace splatray::testing {
namespace {

using Arguments = std::vector<std::string>;

void print(const nlohmann::json& json) { std::printf("%s\n", json.dump().c_str()); }

void measure_pictures(const Arguments& given) {
  std::vector<PictureOfMesh> pictures;
  for (std::size_t i = 1; i + 1 < given.size(); i += 2)
    pictures.push_back({given[i + 1], read_camera(given[i])});
  print(picture_figures(given[0], pictures));
}

void make_sheet(const Arguments& given) {
  print(write_contact_sheet({given.begin() + 2, given.end()}, given[0], given[1]));
}

/// What is done with how many arguments at least.
struct Work {
  std::size_t arguments;
  std::function<void(const Arguments&)> run;
};

const std::map<std::string, Work>& works() {
  static const std::map<std::string, Work> WORKS{
      {"model", {2, [](const Arguments& given) { write_model_inputs(given[0], given[1]); }}},
      {"raw",
       {2, [](const Arguments& given) { write_raw_scan(given[0] == "body" ? "" : given[0], given[1]); }}},
      {"room", {1, [](const Arguments& given) { write_room(given[0]); }}},
      {"walls", {1, [](const Arguments& given) { write_walls(given[0]); }}},
      {"thinned", {2, [](const Arguments& given) { write_thinned(given[0], given[1]); }}},
      {"bare", {2, [](const Arguments& given) { write_bare(given[0], given[1]); }}},
      {"colours", {2, [](const Arguments& given) { write_truth_of_colors(given[0], given[1]); }}},
      {"picture", {3, measure_pictures}},
      {"points", {3, [](const Arguments& given) { print(point_figures(given[0], given[1], given[2])); }}},
      {"light", {1, [](const Arguments& given) { print(light_figures(given[0])); }}},
      {"parts",
       {2,
        [](const Arguments& given) {
          print(part_means(given[0], static_cast<std::uint32_t>(std::stoul(given[1]))));
        }}},
      {"sheet", {3, make_sheet}}};
  return WORKS;
}

int run(int argc, char** argv) {
  const Arguments given(argv + std::min(argc, 2), argv + argc);
  const auto work = works().find(argc > 1 ? argv[1] : "");
  if (work == works().end() || given.size() < work->second.arguments) {
    std::string names;
    for (const auto& [name, about] : works()) names += (names.empty() ? "" : ", ") + name;
    throw Error(ExitCode::usage, "expected one of " + names + " and what it is of");
  }
  work->second.run(given);
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-guard", splatray::testing::run, argc, argv);
}

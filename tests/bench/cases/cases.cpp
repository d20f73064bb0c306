#include "tests/bench/cases/cases.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <utility>

namespace splatray::testing {
namespace {

constexpr std::uint64_t MILLION = 1'000'000;
/// Sphere of radius 1: the discs' radii are then 0.011.
constexpr std::uint64_t COARSE = 25'000;
/// Splats whose median radius is 0.011 of the shape's smallest radius of curvature, where the targets for the jump
/// of the normal are stated.
constexpr const char* R_OVER_R = "r/R 0.011";
constexpr std::uint64_t EVEN_SPHERE = 47'000, RANDOM_SPHERE = 110'000, EVEN_TORUS = 364'000;

Variant even(std::uint64_t points) { return {points, true, {}}; }
Variant random(std::uint64_t points) { return {points, false, {}}; }
Variant vertices() { return {0, true, {}}; }

/// Adds a run that differs from the case's first in what `change` does.
template <class Change>
void vary(Case& one, const std::string& knob, const Change& change) {
  Run run = one.runs.front();
  run.varied = knob;
  change(run);
  one.runs.push_back(run);
}

void vary_blend(Case& one) {
  for (const std::uint32_t blend : {BLEND_PAPER, BLEND_NEAREST})
    vary(one, "blend", [=](Run& run) { run.settings.blend = blend; });
}

void vary_kernel(Case& one) {
  vary(one, "kernel", [](Run& run) { run.settings.kernel = KERNEL_GAUSSIAN; });
  for (const float kappa : {0.25F, 0.5F, 2.0F})
    vary(one, "kappa", [=](Run& run) { run.settings.kappa = kappa; });
}

void vary_fields(Case& one) {
  vary(one, "normal_fields", [](Run& run) { run.variant.build.normal_fields = false; });
}

void vary_clip(Case& one) {
  vary(one, "clip", [](Run& run) { run.variant.build.clip = false; });
}

void vary_radius(Case& one) {
  for (const double scale : {0.7, 1.4})
    vary(one, "radius_scale", [=](Run& run) { run.variant.build.radius_scale = scale; });
  vary(one, "radius_rule", [](Run& run) { run.variant.build.radius_rule = RadiusRule::knn; });
}

/// The other rule's curve beside the default's.
void vary_knn_scale(Case& one) {
  for (const double scale : {0.7, 1.4}) {
    vary(one, "radius_rule", [=](Run& run) {
      run.variant.build.radius_rule = RadiusRule::knn;
      run.variant.build.radius_scale = scale;
    });
  }
}

void vary_insertion(Case& one) {
  for (const Insertion insertion : {Insertion::probe, Insertion::centre})
    vary(one, "insertion", [=](Run& run) { run.variant.build.insertion = insertion; });
}

void vary_tree(Case& one) {
  for (const std::uint32_t size : {4U, 10U, 40U})
    vary(one, "leaf_size", [=](Run& run) { run.variant.build.leaf_size = size; });
  vary_insertion(one);
}
/// These numbers of points with each blending.
void vary_points(Case& one, const std::vector<std::uint64_t>& counts) {
  for (const std::uint64_t points : counts) {
    for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_PAPER, BLEND_NEAREST}) {
      vary(one, "splats", [=](Run& run) {
        run.variant.points = points;
        run.settings.blend = blend;
      });
    }
  }
}

Case start(std::string name, std::string scene, Measure measure, Origin origin, std::string source,
           const Variant& variant) {
  Case one;
  one.name = std::move(name);
  one.scene = std::move(scene);
  one.measure = measure;
  one.origin = origin;
  one.source = std::move(source);
  Settings settings;
  settings.samples = 1;
  settings.shadows = false;
  one.runs = {{variant, settings, ""}};
  return one;
}

Case shape_case(const std::string& size, const std::string& scene, Shape shape, const Variant& variant) {
  Case one = start(scene + " " + size, scene, Measure::picture, Origin::model,
                   shape == Shape::sphere ? "sphere" : "torus", variant);
  one.shape = shape;
  vary_blend(one);
  return one;
}

Case mesh_case(const std::string& size, const std::string& model, const Variant& variant) {
  Case one =
      start(model + " " + size, model, Measure::picture, Origin::mesh, "models/" + model + ".ply", variant);
  vary_blend(one);
  return one;
}

Case coarse_sphere() {
  Case one = shape_case(R_OVER_R, "sphere even", Shape::sphere, even(EVEN_SPHERE));
  vary_kernel(one);
  vary_radius(one);
  vary_knn_scale(one);
  vary_tree(one);
  vary_fields(one);
  return one;
}

Case coarse_random_sphere() {
  Case one = shape_case(R_OVER_R, "sphere random", Shape::sphere, random(RANDOM_SPHERE));
  vary_radius(one);
  vary_knn_scale(one);
  vary_fields(one);
  return one;
}

Case coarse_torus() {
  Case one = shape_case(R_OVER_R, "torus", Shape::torus, even(EVEN_TORUS));
  vary_kernel(one);
  vary_fields(one);
  return one;
}

std::vector<Case> fine_shapes() {
  Case sphere = shape_case("1M", "sphere even", Shape::sphere, even(MILLION));
  vary_points(sphere, {10'000, 100'000});
  vary_radius(sphere);
  Case random_sphere = shape_case("1M", "sphere random", Shape::sphere, random(MILLION));
  vary_points(random_sphere, {10'000, 100'000});
  Case torus = shape_case("1M", "torus", Shape::torus, even(MILLION));
  vary_points(torus, {10'000, 100'000});
  return {sphere, random_sphere, torus};
}

std::vector<Case> mesh_cases() {
  std::vector<Case> list;
  for (const auto& [model, size] :
       {std::pair{"bunny", "35k"}, {"armadillo", "43k"}, {"dragon", "100k"}, {"igea", "134k"}}) {
    Case fine = mesh_case("1M", model, even(MILLION));
    vary_points(fine, {10'000, 100'000});
    if (std::string(model) == "bunny") {
      vary_kernel(fine);
      vary_fields(fine);
      vary_radius(fine);
      vary_tree(fine);
    }
    list.push_back(fine);
    list.push_back(mesh_case(size, model, vertices()));
  }
  return list;
}

/// What engineers bring: creases, and vertices so far apart that the meshes are sampled in any case.
std::vector<Case> edged_cases() {
  std::vector<Case> list;
  for (const char* model : {"fandisk", "gears"}) {
    Case fine = mesh_case("1M", model, even(MILLION));
    vary_clip(fine);
    list.push_back(fine);
    Case own = mesh_case("own sampling", model, vertices());
    vary_clip(own);
    list.push_back(own);
  }
  return list;
}

void vary_side(Case& one) {
  vary(one, "side", [](Run& run) { run.settings.side = SIDE_DELTA; });
}

std::vector<Case> bounce_cases() {
  std::vector<Case> list;
  for (const double degrees : {90.0, 30.0}) {
    const std::string name = "mirror wedge " + std::to_string(static_cast<int>(degrees));
    Case wedge = start(name, name, Measure::wedge, Origin::model, "wedge", even(COARSE));
    wedge.wedge_deg = degrees;
    vary_side(wedge);
    list.push_back(wedge);
  }
  Case ball =
      start("mirror ball inside", "mirror ball inside", Measure::ball, Origin::model, "sphere", even(COARSE));
  ball.rays /= 4;
  vary_side(ball);
  vary_blend(ball);
  list.push_back(ball);
  Case glass = start("glass ball", "glass ball", Measure::leaks, Origin::model, "sphere", even(COARSE));
  glass.width = glass.height = 128;
  glass.runs.front().settings.samples = 16;
  vary_side(glass);
  vary_radius(glass);
  vary_insertion(glass);
  list.push_back(glass);
  return list;
}

Case brute_force_case() {
  Case one =
      start("brute force", "brute force", Measure::brute_force, Origin::model, "sphere", random(20'000));
  one.rays = 20'000;
  vary_tree(one);
  return one;
}

Case samples_case() {
  Case one = start("room samples", "room samples", Measure::samples, Origin::scene, "data/scenes/room.gltf",
                   even(300'000));
  one.width = one.height = 64;
  one.fill = 0.0;
  one.runs.front().settings.shadows = true;
  for (const std::uint32_t samples : {4U, 16U, 64U})
    vary(one, "samples", [=](Run& run) { run.settings.samples = samples; });
  vary(one, "side", [](Run& run) {
    run.settings.samples = 64;
    run.settings.side = SIDE_DELTA;
  });
  return one;
}

/// The scenes of Goradia et al. 2010, Tables I and II.
std::vector<Case> table_cases() {
  std::vector<Case> list;
  for (const auto& [name, file] :
       {std::pair{"Table I David", "table1_david"}, {"Table I Dragon", "table1_dragon"}}) {
    Case one = start(name, name, Measure::frame, Origin::scene, std::string("data/scenes/") + file + ".gltf",
                     vertices());
    vary(one, "shadows", [](Run& run) { run.settings.shadows = true; });
    list.push_back(one);
  }
  for (const auto& [name, file] : {std::pair{"Table II Refractive Dragon", "refractive_dragon"},
                                   {"Table II Buddha", "reflective_buddha"},
                                   {"Table II Teapot Scene", "teapot"},
                                   {"Table II Room Scene", "room"}}) {
    const Variant points = std::string(file) == "room" ? even(1'050'000) : vertices();
    Case one = start(name, name, Measure::frame, Origin::scene, std::string("data/scenes/") + file + ".gltf",
                     points);
    one.runs.front().settings.samples = 16;
    one.runs.front().settings.shadows = true;
    list.push_back(one);
  }
  for (Case& one : list) one.fill = 0.0;
  return list;
}

void append(std::vector<Case>& list, std::vector<Case> more) {
  std::move(more.begin(), more.end(), std::back_inserter(list));
}

/// Small pictures of small scenes.
std::vector<Case> quick_cases() {
  constexpr std::uint32_t SIZE = 256;
  Case sphere = shape_case(R_OVER_R, "sphere even", Shape::sphere, even(EVEN_SPHERE));
  vary_fields(sphere);
  vary_radius(sphere);
  vary_tree(sphere);
  std::vector<Case> list{sphere, shape_case(R_OVER_R, "sphere random", Shape::sphere, random(RANDOM_SPHERE)),
                         mesh_case("35k", "bunny", vertices()), mesh_case("43k", "armadillo", vertices())};
  for (Case& one : list) one.width = one.height = SIZE;
  append(list, bounce_cases());
  list.push_back(brute_force_case());
  for (Case& one : list) one.rays /= 4;
  return list;
}

}  // namespace

bool Variant::operator==(const Variant& other) const { return file_name(*this) == file_name(other); }

std::vector<Case> cases(bool quick) {
  if (quick) return quick_cases();
  std::vector<Case> list{coarse_sphere(), coarse_random_sphere(), coarse_torus()};
  append(list, fine_shapes());
  append(list, mesh_cases());
  append(list, edged_cases());
  append(list, bounce_cases());
  list.push_back(brute_force_case());
  list.push_back(samples_case());
  append(list, table_cases());
  return list;
}

std::vector<Variant> variants_of(const Case& one) {
  std::vector<Variant> variants;
  for (const Run& run : one.runs) {
    if (std::find(variants.begin(), variants.end(), run.variant) == variants.end())
      variants.push_back(run.variant);
  }
  return variants;
}

std::string folder_name(const Case& one) {
  std::string name = one.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
  return name;
}

std::string file_name(const Variant& variant) {
  const BuildParams& build = variant.build;
  char text[160];
  std::snprintf(text, sizeof(text), "%s-%llu-%s-%.0f-leaf-%u-%s%s%s.soct", variant.even ? "even" : "random",
                static_cast<unsigned long long>(variant.points), word(build.radius_rule).c_str(),
                100.0 * build.radius_scale, build.leaf_size, word(build.insertion).c_str(),
                build.normal_fields ? "" : "-flat", build.clip ? "" : "-whole");
  return text;
}

std::string word(Insertion insertion) {
  constexpr const char* WORDS[] = {"overlap", "probe", "centre"};
  return WORDS[static_cast<std::size_t>(insertion)];
}

std::string word(RadiusRule rule) {
  constexpr const char* WORDS[] = {"coverage", "knn"};
  return WORDS[static_cast<std::size_t>(rule)];
}

std::string blend_word(std::uint32_t blend) {
  constexpr const char* WORDS[] = {"window", "paper", "nearest", "leaf"};
  return WORDS[blend];
}

std::string kernel_word(std::uint32_t kernel) { return kernel == KERNEL_RIM ? "rim" : "gaussian"; }

std::string side_word(std::uint32_t side) {
  constexpr const char* WORDS[] = {"side", "delta", "none"};
  return WORDS[side];
}

}  // namespace splatray::testing

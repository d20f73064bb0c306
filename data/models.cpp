#include "data/models.h"

#include <cmath>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

Model sphere_model(const ModelOptions&) {
  return {{"sphere", 4.0 * pi, [](const Sampling& sampling) { return sphere(sampling, 1.0); }}};
}

Model torus_model(const ModelOptions&) {
  return {{"torus", torus_area(0.7, 0.3, -pi, pi),
           [](const Sampling& sampling) { return torus(sampling, 0.7, 0.3, -pi, pi); }}};
}

Model knot_model(const ModelOptions&) {
  return {{"knot", tube_area(trefoil, 0.2),
           [](const Sampling& sampling) { return tube(sampling, trefoil, 0.2); }}};
}

Model plane_model(const ModelOptions&) {
  return {rectangle_surface("plane", {-1.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0})};
}

/// Two unit squares that meet in the z axis, open towards +x, facing each other.
Model wedge_model(const ModelOptions& options) {
  const double half = 0.5 * options.angle_deg * pi / 180.0;
  const glm::dvec3 along_z(0.0, 0.0, 1.0);
  const glm::dvec3 upper(std::cos(half), std::sin(half), 0.0);
  const glm::dvec3 lower(std::cos(half), -std::sin(half), 0.0);
  const glm::dvec3 corner = -0.5 * along_z;
  return {rectangle_surface("wedge", corner, upper, along_z),
          rectangle_surface("wedge", corner, along_z, lower)};
}

}  // namespace

const std::map<std::string, ModelMaker>& models() {
  static const std::map<std::string, ModelMaker> table{
      {"demo", [](const ModelOptions&) { return demo_model(); }},
      {"room", [](const ModelOptions&) { return room_model(); }},
      {"sphere", sphere_model},
      {"torus", torus_model},
      {"knot", knot_model},
      {"plane", plane_model},
      {"cube", [](const ModelOptions&) { return box("cube", glm::dvec3(2.0), false); }},
      {"box", [](const ModelOptions&) { return box("box", glm::dvec3(2.0), true); }},
      {"slab",
       [](const ModelOptions&) {
         return box("slab", {2.0, 0.2, 2.0}, false);
       }},
      {"wedge", wedge_model},
  };
  return table;
}

std::map<std::string, OrientedPoints> sample(const Model& model, const Sampling& sampling) {
  double weight = 0.0;
  for (const SurfacePatch& surface : model) weight += surface.area * surface.density;
  std::map<std::string, OrientedPoints> clouds;
  std::uint64_t seed = sampling.seed;
  for (const SurfacePatch& surface : model) {
    const double share = surface.area * surface.density / weight;
    const auto count = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(sampling.count)));
    append(clouds[surface.object], surface.make({count, sampling.even, seed++}));
  }
  return clouds;
}

}  // namespace splatray

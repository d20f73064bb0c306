/// The built-in scene, a still life before a ring of light: a painted amphora as five scans have it, a vase of rough glass, a
/// knot of copper, balls of gold and steel, on a curved backdrop. Materials, lights and camera are in
/// data/scenes/demo.gltf.
#include <cmath>
#include <numbers>

#include "data/amphora.h"
#include "data/models.h"

namespace splatray {
namespace {

using std::numbers::pi;

/// Turns the y axis, the axis of round shapes, to z.
const glm::dmat3 UPRIGHT(glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, -1.0, 0.0));

glm::dmat3 turned(double angle) {
  return {glm::dvec3(std::cos(angle), 0.0, -std::sin(angle)), glm::dvec3(0.0, 1.0, 0.0),
          glm::dvec3(std::sin(angle), 0.0, std::cos(angle))};
}

/// The model on `foot`, turned about the y axis, with `density` points per area.
Model placed(Model model, glm::dvec3 foot, double angle, double density) {
  for (SurfacePatch& patch : model) {
    patch.make = [=, make = patch.make](const Sampling& sampling) {
      return moved(make(sampling), foot, turned(angle));
    };
    patch.density = density;
  }
  return model;
}

/// Distemper on canvas: a warm grey that wanders a little and turns dusky blue upwards.
glm::dvec3 canvas(glm::dvec3 p) {
  const double wander = std::sin(2.1 * p.x + 1.3 * std::sin(1.7 * p.y + 0.9 * p.z)) +
                        0.5 * std::sin(5.3 * p.y + 2.0 * std::sin(3.1 * p.x - 2.3 * p.z));
  const double height = glm::smoothstep(0.05, 1.0, p.y);
  return glm::mix(glm::dvec3(0.20, 0.19, 0.19), glm::dvec3(0.13, 0.17, 0.215), height) *
         (1.0 + 0.06 * wander);
}

/// A floor that bends up into a wall, as photographers have it.
Model backdrop() {
  constexpr double LEFT = -3.4;
  constexpr double WIDTH = 6.8;
  constexpr double FRONT = 3.4;
  constexpr double BEND_Z = -0.95;  ///< where the floor ends and the bend begins
  constexpr double BEND = 0.45;     ///< radius of the bend
  constexpr double HEIGHT = 2.6;    ///< of the wall above it
  const glm::dvec3 along_x(WIDTH, 0.0, 0.0);
  Model model{rectangle_surface("backdrop", {LEFT, 0.0, FRONT}, along_x, {0.0, 0.0, BEND_Z - FRONT}),
              rectangle_surface("backdrop", {LEFT, BEND, BEND_Z - BEND}, along_x, {0.0, HEIGHT, 0.0}),
              {"backdrop", 0.5 * pi * BEND * WIDTH, [=](const Sampling& sampling) {
                 const glm::dmat3 y_to_x(glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(1.0, 0.0, 0.0),
                                         glm::dvec3(0.0, 0.0, 1.0));
                 const OrientedPoints bend = flipped(cylinder(sampling, BEND, WIDTH, 0.0, 0.5 * pi));
                 return moved(bend, {LEFT, BEND, BEND_Z}, y_to_x);
               }}};
  for (SurfacePatch& patch : model)
    patch.make = [make = patch.make](const Sampling& sampling) { return painted(make(sampling), canvas); };
  return model;
}

/// Hangs before the wall, facing the camera.
SurfacePatch ring() {
  constexpr double RADIUS = 0.7;
  constexpr double TUBE = 0.03;
  return {"ring", torus_area(RADIUS, TUBE, -pi, pi),
          [=](const Sampling& sampling) {
            return moved(torus(sampling, RADIUS, TUBE, -pi, pi), {0.22, 0.76, -1.1}, UPRIGHT);
          },
          10.0};
}

/// A closed surface, out and in: the wall is 8 mm thick.
SurfacePatch vase() {
  const Profile profile =
      spline({{0, 0},          {0.069, 0},      {0.115, 0.0046}, {0.149, 0.046},   {0.178, 0.127},
              {0.19, 0.218},   {0.172, 0.322},  {0.121, 0.408},  {0.0736, 0.471},  {0.0575, 0.529},
              {0.0644, 0.586}, {0.0897, 0.621}, {0.0943, 0.628}, {0.0874, 0.63},   {0.0575, 0.592},
              {0.0483, 0.529}, {0.0644, 0.467}, {0.113, 0.402},  {0.163, 0.319},   {0.181, 0.218},
              {0.169, 0.13},   {0.14, 0.0575},  {0.103, 0.0253}, {0.0575, 0.0207}, {0, 0.0207}});
  return {"glass", lathe_area(profile),
          [=](const Sampling& sampling) {
            return moved(lathe(sampling, profile), {0.17, 0.0, 0.05});
          },
          30.0};
}

SurfacePatch knot() {
  constexpr double SIZE = 0.27;
  constexpr double TUBE = 0.2 * SIZE;
  const Curve curve = [](double parameter) { return SIZE * trefoil(parameter); };
  return {"knot", tube_area(curve, TUBE),
          [=](const Sampling& sampling) {
            return moved(tube(sampling, curve, TUBE), {0.8, SIZE + TUBE, -0.3}, turned(-0.5));
          },
          20.0};
}

SurfacePatch ball_on_ground(const std::string& object, double x, double z, double radius) {
  return {object, 4.0 * pi * radius * radius,
          [=](const Sampling& sampling) {
            return moved(sphere(sampling, radius), {x, radius, z});
          },
          20.0};
}

}  // namespace

Model demo_model() {
  Model model = backdrop();
  const Model scanned = placed(amphora(), {-0.5, 0.0, -0.25}, 0.5, 40.0);
  model.insert(model.end(), scanned.begin(), scanned.end());
  for (const SurfacePatch& patch : {ring(), vase(), knot(), ball_on_ground("gold", -0.13, 0.42, 0.13),
                                    ball_on_ground("steel", 0.5, 0.4, 0.14)})
    model.push_back(patch);
  return model;
}

}  // namespace splatray

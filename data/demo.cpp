/// The built-in scene: the corner of a plastered room with an arched niche, a tiled floor, a round mirror,
/// and in it a knot on a plinth, a glass sphere, a gilded sphere and a terracotta ring. Materials, light and
/// camera are in data/scenes/demo.gltf.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/models.h"

namespace splatray {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double TILE = 0.4;   ///< side of a floor tile, m; floor and niche end on whole tiles
constexpr double LEFT = -2.4;  ///< the left wall's x
constexpr double RIGHT = 3.6;  ///< end of floor and back wall, outside the picture
constexpr double BACK = -1.6;  ///< the back wall's z
constexpr double FRONT = 3.2;  ///< end of floor and left wall; seen in the mirror
constexpr double HEIGHT = 3.2;

/// The niche in the back wall: two jambs and a half circle over them.
constexpr double NICHE_X = -0.95;
constexpr double NICHE_RADIUS = 0.58;
constexpr double NICHE_JAMB = 1.3;
constexpr double NICHE_DEPTH = TILE;

/// Turns the y axis, the axis of round shapes, to z.
const glm::dmat3 UPRIGHT(glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, -1.0, 0.0));

bool in_niche(glm::dvec3 position) {
  const double x = position.x - NICHE_X;
  const double y = std::max(0.0, position.y - NICHE_JAMB);
  return x * x + y * y < NICHE_RADIUS * NICHE_RADIUS;
}

/// Lime plaster: a warm white that wanders a little.
glm::dvec3 plaster(glm::dvec3 p) {
  const double wander = std::sin(2.1 * p.x + 1.3 * std::sin(1.7 * p.y + 0.9 * p.z)) +
                        0.5 * std::sin(6.3 * p.y + 2.0 * std::sin(3.1 * p.x - 2.3 * p.z));
  return glm::dvec3(0.34, 0.25, 0.18) * (1.0 + 0.035 * wander);
}

/// Cream and slate tiles; a tile's first row and column of points are its dark joint.
glm::dvec3 tiles(glm::dvec3 p) {
  constexpr double JOINT = 0.006 / TILE;
  const double column = (p.x - LEFT) / TILE;
  const double row = (p.z - BACK) / TILE;
  if (std::min(column - std::floor(column), row - std::floor(row)) < JOINT) return {0.03, 0.03, 0.03};
  const int parity = (static_cast<int>(std::floor(column)) + static_cast<int>(std::floor(row))) & 1;
  return parity == 0 ? glm::dvec3(0.31, 0.275, 0.225) : glm::dvec3(0.030, 0.043, 0.062);
}

/// From ultramarine below to turquoise above.
glm::dvec3 glaze(glm::dvec3 p) {
  const double share = glm::smoothstep(0.6, 1.7, p.y);
  return glm::mix(glm::dvec3(0.008, 0.030, 0.19), glm::dvec3(0.015, 0.20, 0.215), share);
}

SurfacePatch plastered(glm::dvec3 corner, glm::dvec3 edge_u, glm::dvec3 edge_v) {
  SurfacePatch surface = rectangle_surface("walls", corner, edge_u, edge_v);
  surface.make = [make = surface.make](const Sampling& sampling) { return painted(make(sampling), plaster); };
  return surface;
}

Model walls() {
  const double width = 2.0 * NICHE_RADIUS;
  const glm::dvec3 along_z(0.0, 0.0, NICHE_DEPTH);
  const glm::dvec3 jamb(0.0, NICHE_JAMB, 0.0);
  const glm::dvec3 niche_corner(NICHE_X - NICHE_RADIUS, 0.0, BACK - NICHE_DEPTH);
  SurfacePatch left = plastered({LEFT, 0.0, BACK}, {0.0, HEIGHT, 0.0}, {0.0, 0.0, FRONT - BACK});
  SurfacePatch back = plastered({LEFT, 0.0, BACK}, {RIGHT - LEFT, 0.0, 0.0}, {0.0, HEIGHT, 0.0});
  back.make = [make = back.make](const Sampling& sampling) {
    return kept(make(sampling), [](glm::dvec3 position) { return !in_niche(position); });
  };
  SurfacePatch recess = plastered(niche_corner, {width, 0.0, 0.0}, {0.0, NICHE_JAMB + NICHE_RADIUS, 0.0});
  recess.make = [make = recess.make](const Sampling& sampling) { return kept(make(sampling), in_niche); };
  SurfacePatch left_jamb = plastered(niche_corner, jamb, along_z);
  SurfacePatch right_jamb = plastered(niche_corner + glm::dvec3(width, 0.0, 0.0), along_z, jamb);
  SurfacePatch arch{
      "walls", PI * NICHE_RADIUS * NICHE_DEPTH, [](const Sampling& sampling) {
        OrientedPoints half = flipped(cylinder(sampling, NICHE_RADIUS, NICHE_DEPTH, 0.0, PI));
        return painted(moved(half, {NICHE_X, NICHE_JAMB, BACK - NICHE_DEPTH}, UPRIGHT), plaster);
      }};
  return {left, back, recess, left_jamb, right_jamb, arch};
}

/// The moulding that follows the niche's edge.
Model moulding() {
  constexpr double TUBE = 0.035;
  constexpr double DENSITY = 4.0;
  const glm::dvec3 foot(NICHE_X, 0.0, BACK);
  const auto jamb = [=](double side) {
    return SurfacePatch{"moulding", 2.0 * PI * TUBE * NICHE_JAMB,
                        [=](const Sampling& sampling) {
                          return moved(cylinder(sampling, TUBE, NICHE_JAMB, 0.0, 2.0 * PI),
                                       foot + glm::dvec3(side * NICHE_RADIUS, 0.0, 0.0));
                        },
                        DENSITY};
  };
  const SurfacePatch arch{"moulding", torus_area(NICHE_RADIUS, TUBE, -PI, PI),
                          [=](const Sampling& sampling) {
                            const OrientedPoints ring =
                                moved(torus(sampling, NICHE_RADIUS, TUBE, -PI, PI), {}, UPRIGHT);
                            const auto upper = [](glm::dvec3 position) { return position.y >= 0.0; };
                            return moved(kept(ring, upper), foot + glm::dvec3(0.0, NICHE_JAMB, 0.0));
                          },
                          DENSITY};
  return {jamb(-1.0), jamb(1.0), arch};
}

/// A square grid of points with whole rows in each tile, so that the joints are straight.
SurfacePatch floor() {
  const glm::dvec3 corner(LEFT, 0.0, FRONT);
  const glm::dvec3 edge_u(RIGHT - LEFT, 0.0, 0.0);
  const glm::dvec3 edge_v(0.0, 0.0, BACK - NICHE_DEPTH - FRONT);
  const double area = glm::length(glm::cross(edge_u, edge_v));
  return {"floor", area, [=](const Sampling& sampling) {
            const double tile_count = std::round(area / (TILE * TILE));
            const double rows =
                std::max(1.0, std::round(std::sqrt(static_cast<double>(sampling.count) / tile_count)));
            const auto count = static_cast<std::uint64_t>(tile_count * rows * rows);
            return painted(grid({.count = count}, corner, edge_u, edge_v), tiles);
          }};
}

/// The round mirror and its frame, hung on the back wall and leaning forward, so that it shows the floor and
/// what stands on it.
Model mirror() {
  constexpr double RADIUS = 0.66;
  constexpr double FRAME = 0.045;
  constexpr double LEAN = 0.16;
  const glm::dvec3 facing(0.0, -std::sin(LEAN), std::cos(LEAN));
  const glm::dvec3 right(1.0, 0.0, 0.0);
  const glm::dmat3 axes(right, facing, glm::cross(right, facing));
  const glm::dvec3 center(0.95, 1.38, BACK + FRAME + RADIUS * std::sin(LEAN));
  return {
      {"mirror", PI * RADIUS * RADIUS,
       [=](const Sampling& sampling) { return moved(disc(sampling, RADIUS), center, axes); }},
      {"frame", torus_area(RADIUS, FRAME, -PI, PI),
       [=](const Sampling& sampling) { return moved(torus(sampling, RADIUS, FRAME, -PI, PI), center, axes); },
       16.0}};
}

/// A round plinth with a rounded rim, and the knot that stands on it.
Model knot_on_plinth() {
  constexpr double RADIUS = 0.36;
  constexpr double RIM = 0.03;
  constexpr double TOP = 0.6;
  constexpr double SIZE = 0.42;
  constexpr double TUBE = 0.2 * SIZE;
  const glm::dvec3 foot(-0.95, 0.0, -0.85);
  const Curve curve = [](double parameter) { return SIZE * trefoil(parameter); };
  const double turn = 0.35;
  const glm::dmat3 axes(glm::dvec3(std::cos(turn), 0.0, -std::sin(turn)), glm::dvec3(0.0, 1.0, 0.0),
                        glm::dvec3(std::sin(turn), 0.0, std::cos(turn)));
  return {{"plinth", 2.0 * PI * RADIUS * (TOP - RIM),
           [=](const Sampling& sampling) {
             return moved(cylinder(sampling, RADIUS, TOP - RIM, 0.0, 2.0 * PI), foot);
           },
           2.0},
          {"plinth", torus_area(RADIUS - RIM, RIM, 0.0, 0.5 * PI),
           [=](const Sampling& sampling) {
             return moved(torus(sampling, RADIUS - RIM, RIM, 0.0, 0.5 * PI),
                          foot + glm::dvec3(0.0, TOP - RIM, 0.0));
           },
           2.0},
          {"plinth", PI * (RADIUS - RIM) * (RADIUS - RIM),
           [=](const Sampling& sampling) {
             return moved(disc(sampling, RADIUS - RIM), foot + glm::dvec3(0.0, TOP, 0.0));
           },
           2.0},
          {"knot", tube_area(curve, TUBE),
           [=](const Sampling& sampling) {
             const glm::dvec3 center = foot + glm::dvec3(0.0, TOP + SIZE + TUBE, 0.0);
             return painted(moved(tube(sampling, curve, TUBE), center, axes), glaze);
           },
           4.0}};
}

SurfacePatch ball(const std::string& object, glm::dvec3 foot, double radius) {
  return {object, 4.0 * PI * radius * radius,
          [=](const Sampling& sampling) {
            return moved(sphere(sampling, radius), foot + glm::dvec3(0.0, radius, 0.0));
          },
          8.0};
}

SurfacePatch ring() {
  constexpr double RADIUS = 0.25;
  constexpr double TUBE = 0.085;
  return {"ring", torus_area(RADIUS, TUBE, -PI, PI),
          [=](const Sampling& sampling) {
            return moved(torus(sampling, RADIUS, TUBE, -PI, PI), {-0.75, TUBE, 0.55});
          },
          4.0};
}

}  // namespace

Model demo_model() {
  Model model = walls();
  for (const Model& part : {moulding(), mirror(), knot_on_plinth()})
    model.insert(model.end(), part.begin(), part.end());
  model.push_back(floor());
  model.push_back(ring());
  model.push_back(ball("glass", {0.85, 0.0, 0.35}, 0.42));
  model.push_back(ball("gold", {0.05, 0.0, 0.85}, 0.22));
  return model;
}

}  // namespace splatray

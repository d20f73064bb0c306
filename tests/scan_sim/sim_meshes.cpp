#include "tests/scan_sim/sim_meshes.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace splatray::testing {
namespace {

using glm::dvec3;

void add_triangle(Mesh& mesh, const dvec3& a, const dvec3& b, const dvec3& c) {
  const auto first = static_cast<glm::uint>(mesh.vertices.position.size());
  for (const dvec3& corner : {a, b, c}) mesh.vertices.position.push_back(corner);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void add_quad(Mesh& mesh, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

void add_box(Mesh& mesh, const dvec3& low, const dvec3& high) {
  const auto corner = [&](int i) {
    return dvec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
  };
  constexpr int FACES[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : FACES)
    add_quad(mesh, corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]));
}

void add_column(Mesh& mesh, const dvec3& foot, double radius, double height) {
  constexpr int SIDES = 48;
  const auto rim = [&](int i, double z) {
    const double angle = 2.0 * std::numbers::pi * i / SIDES;
    return foot + dvec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < SIDES; ++i)
    add_quad(mesh, rim(i, 0.0), rim(i + 1, 0.0), rim(i + 1, height), rim(i, height));
}

/// A square lattice of `side` x `side` cells, from the parameters (0, 0) to (1, 1).
void add_sheet(Mesh& mesh, int side, const std::function<dvec3(double, double)>& place) {
  const auto at = [&](int i, int j) { return place(double(i) / side, double(j) / side); };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

}  // namespace

Mesh sphere_mesh(int levels) {
  Mesh mesh;
  const std::function<void(const dvec3&, const dvec3&, const dvec3&, int)> add =
      [&](const dvec3& a, const dvec3& b, const dvec3& c, int left) {
        if (left == 0) return add_triangle(mesh, a, b, c);
        const dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
        add(a, ab, ca, left - 1);
        add(ab, b, bc, left - 1);
        add(ca, bc, c, left - 1);
        add(ab, bc, ca, left - 1);
      };
  for (int octant = 0; octant < 8; ++octant) {
    const double x = (octant & 1) != 0 ? -1.0 : 1.0, y = (octant & 2) != 0 ? -1.0 : 1.0,
                 z = (octant & 4) != 0 ? -1.0 : 1.0;
    const bool turned = x * y * z < 0.0;
    add({x, 0, 0}, turned ? dvec3(0, 0, z) : dvec3(0, y, 0), turned ? dvec3(0, y, 0) : dvec3(0, 0, z),
        levels);
  }
  return mesh;
}

Mesh room_mesh() {
  Mesh mesh;
  add_box(mesh, {-6.0, -4.5, 0.0}, {6.0, 4.5, 3.2});
  for (const double x : {-4.0, -1.4, 1.4, 4.0})
    for (const double y : {-2.6, 2.6}) add_column(mesh, {x, y, 0.0}, 0.25, 3.2);
  for (const double x : {-2.7, 2.9}) {
    add_box(mesh, {x - 0.7, -0.4, 0.70}, {x + 0.7, 0.4, 0.74});
    for (const double leg_x : {x - 0.65, x + 0.65})
      for (const double leg_y : {-0.35, 0.35}) add_column(mesh, {leg_x, leg_y, 0.0}, 0.025, 0.7);
  }
  add_box(mesh, {5.5, -3.0, 0.0}, {5.85, -1.0, 2.0});
  return mesh;
}

Mesh wall_mesh(double thickness) {
  Mesh mesh;
  add_quad(mesh, {-2.0, -1.5, 0.0}, {2.0, -1.5, 0.0}, {2.0, 1.5, 0.0}, {-2.0, 1.5, 0.0});
  add_box(mesh, {-1.5, -0.5 * thickness, 0.0}, {1.5, 0.5 * thickness, 2.0});
  return mesh;
}

Mesh corner_mesh() {
  Mesh mesh = sphere_mesh(5);
  for (dvec3& position : mesh.vertices.position) position = CORNER_BALL + CORNER_BALL_RADIUS * position;
  add_quad(mesh, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  add_quad(mesh, {0, 0, 0}, {0, 4, 0}, {0, 4, 4}, {0, 0, 4});
  add_quad(mesh, {0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0});
  add_box(mesh, {0.4, 1.9, 0.0}, {0.9, 2.4, 0.7});
  return mesh;
}

Mesh terrain_mesh() {
  Mesh mesh;
  const auto height = [](double x, double y) {
    return 4.0 * std::sin(0.05 * x) * std::cos(0.07 * y) + 1.5 * std::sin(0.21 * x + 0.13 * y) +
           0.25 * std::sin(0.9 * x) * std::sin(0.8 * y);
  };
  add_sheet(mesh, 240, [&](double u, double v) {
    const double x = 120.0 * (u - 0.5), y = 120.0 * (v - 0.5);
    return dvec3(x, y, height(x, y));
  });
  for (const double x : {-35.0, 0.0, 30.0}) {
    for (const double y : {-25.0, 20.0}) {
      const double ground = height(x, y);
      add_box(mesh, {x - 5.0, y - 4.0, ground - 3.0}, {x + 5.0, y + 4.0, ground + 4.0});
    }
  }
  return mesh;
}

Mesh street_mesh() {
  Mesh mesh;
  const auto height = [](double x, double y) {
    const double off = std::max(std::abs(y) - 8.0, 0.0);
    return 0.03 * off + 0.1 * std::sin(0.05 * x) - 0.01 * std::min(std::abs(y), 5.0);
  };
  add_sheet(mesh, 160, [&](double u, double v) {
    const double x = 160.0 * (u - 0.5), y = 160.0 * (v - 0.5);
    return dvec3(x, y, height(x, y));
  });
  for (const double side : {-1.0, 1.0}) {
    add_box(mesh, {-80.0, side < 0 ? -7.0 : 5.0, -0.5}, {80.0, side < 0 ? -5.0 : 7.0, 0.12});  // pavements
    for (const double x : {-62.0, -36.0, -12.0, 14.0, 41.0, 66.0})
      add_box(mesh, {x - 9.0, side < 0 ? -24.0 : 11.0, -1.0},
              {x + 9.0, side < 0 ? -11.0 : 24.0, 7.0 + 0.05 * x});
    for (const double x : {-31.0, -9.5, 7.0, 24.0}) {
      const double y = side * 3.9;
      add_box(mesh, {x - 2.1, y - 0.85, 0.25}, {x + 2.1, y + 0.85, 0.85});
      add_box(mesh, {x - 1.1, y - 0.75, 0.85}, {x + 0.9, y + 0.75, 1.45});
    }
    for (const double x : {-40.0, -18.0, 3.0, 17.0, 33.0}) {
      add_column(mesh, {x, side * 6.0, 0.0}, 0.08, 5.0);
      add_box(mesh, {x - 0.02, side * 6.0 - 0.4, 2.2}, {x + 0.02, side * 6.0 + 0.4, 3.0});
    }
  }
  return mesh;
}

Wood wood_mesh() {
  constexpr double EDGE = 60.0, LEAF = 0.077;
  constexpr int TREES = 80, LEAVES = 2000;
  const auto height = [](double x, double y) {
    return 0.4 * y + 1.5 * std::sin(0.11 * x) * std::cos(0.09 * y) + 0.15 * std::sin(0.8 * x + 0.5 * y);
  };
  Wood wood;
  add_sheet(wood.mesh, 120, [&](double u, double v) {
    const double x = EDGE * (u - 0.5), y = EDGE * (v - 0.5);
    return dvec3(x, y, height(x, y));
  });
  wood.first_leaf = static_cast<std::uint32_t>(wood.mesh.triangles.size());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
  };
  for (int tree = 0; tree < TREES; ++tree) {
    const double x = EDGE * (unit(random) - 0.5), y = EDGE * (unit(random) - 0.5),
                 size = 0.7 + 0.6 * unit(random);
    const dvec3 middle(x, y, height(x, y) + 7.0 * size);
    for (int leaf = 0; leaf < LEAVES; ++leaf) {
      const dvec3 at = middle + size * dvec3(2.5, 2.5, 3.5) * direction() * std::cbrt(unit(random));
      const dvec3 u = direction(), v = glm::normalize(glm::cross(u, direction()));
      add_triangle(wood.mesh, at + 2.0 * LEAF * u, at - LEAF * u + LEAF * 1.7 * v,
                   at - LEAF * u - LEAF * 1.7 * v);
    }
  }
  return wood;
}

Mesh body_mesh() {
  Mesh mesh;
  add_sheet(mesh, 200, [](double u, double v) {
    const double longitude = 2.0 * std::numbers::pi * u, latitude = std::numbers::pi * (v - 0.5);
    const dvec3 dir(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                    std::cos(latitude) * std::sin(longitude));
    const double bumps = 0.16 * std::sin(3.0 * dir.x + 1.0) * std::cos(4.0 * dir.y) +
                         0.10 * std::sin(6.0 * dir.z + 2.0 * dir.x) +
                         0.03 * std::sin(17.0 * dir.x) * std::sin(15.0 * dir.y) * std::sin(16.0 * dir.z);
    return (0.8 + bumps) * dir * dvec3(1.0, 1.15, 0.8);
  });
  return mesh;
}

}  // namespace splatray::testing

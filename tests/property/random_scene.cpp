#include "tests/property/random_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "data/shapes.h"
#include "preprocess/build.h"
#include "preprocess/tree/root.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double EDGE = 1U << LATTICE_BITS;
constexpr double BORDER = 64.0;  ///< centres keep this from the root's faces, lattice units
constexpr double LEAST_RADIUS = 1.5;
constexpr double MOST_RADIUS = 1e6;

/// A disc in lattice units.
struct Disc {
  dvec3 center, normal;
  double radius;
};
using Discs = std::vector<Disc>;

/// Two small discs in opposite corners, which alone decide the root.
Discs anchors() {
  const dvec3 up(0.0, 0.0, 1.0);
  return {{dvec3(-1.0), up, 1e-4}, {dvec3(1.0), up, 1e-4}};
}

const RootTransform& shared_root() {
  static const RootTransform root = [] {
    DiscBounds bounds;
    for (const Disc& disc : anchors()) bounds.add(disc.center, disc.normal, disc.radius);
    return fit_root(bounds);
  }();
  return root;
}

dvec3 somewhere(Dice& dice) { return dvec3(EDGE / 2.0) + (EDGE / 2.0 - BORDER) * dice.in_cube(); }

dvec3 some_normal(Dice& dice) { return dice.chance(0.25) ? dice.axis() : dice.direction(); }

Discs soup(Dice& dice, std::uint32_t) {
  const dvec3 middle = somewhere(dice);
  const double size = dice.log_between(16.0, EDGE);
  const double most = dice.log_between(LEAST_RADIUS, MOST_RADIUS);
  Discs discs(20 + dice.below(300));
  for (Disc& disc : discs)
    disc = {middle + size * dice.in_cube(), some_normal(dice), dice.log_between(LEAST_RADIUS, most)};
  return discs;
}

Discs shell(Dice& dice, std::uint32_t) {
  const dvec3 middle = dvec3(EDGE / 2.0) + EDGE / 8.0 * dice.in_cube();
  const double radius = dice.log_between(64.0, EDGE / 3.0);
  const std::uint64_t count = 50 + dice.below(800);
  const OrientedPoints points = sphere({count, dice.chance(0.5), dice.seed()}, radius);
  const double disc_radius = radius * std::sqrt(4.0 / double(count)) * dice.between(0.8, 2.5);
  const double outwards = dice.sign();
  Discs discs;
  for (std::size_t i = 0; i < count; ++i)
    discs.push_back({middle + points.position[i], outwards * points.normal[i], disc_radius});
  return discs;
}

/// A grid of centres on corners of cells, in a plane between cells.
Discs cell_plane(Dice& dice, std::uint32_t) {
  const double spacing = std::exp2(2.0 + dice.below(15));
  const auto rows = 3 + dice.below(18);
  const auto low = dvec3(glm::ivec3(dvec3(somewhere(dice)) / spacing)) * spacing;
  const dvec3 normal = dice.axis();
  const int along = std::abs(normal.x) > 0.5 ? 1 : 0;
  const int across = std::abs(normal.z) > 0.5 ? 1 : 2;
  const double radius = spacing * dice.between(0.75, 3.0);
  Discs discs;
  for (std::uint32_t i = 0; i < rows * rows; ++i) {
    dvec3 center = low;
    center[along] += spacing * (i % rows);
    center[across] += spacing * double(i / rows);
    discs.push_back({center, normal, radius});
  }
  return discs;
}

/// Places with several splats each: equal ones, at most `copies` (a tree keeps no more than its leaf size), and others.
Discs coincident(Dice& dice, std::uint32_t copies) {
  Discs discs;
  for (std::uint32_t place = 5 + dice.below(40); place > 0; --place) {
    const Disc disc{somewhere(dice), some_normal(dice), dice.log_between(LEAST_RADIUS, MOST_RADIUS)};
    discs.insert(discs.end(), 1 + dice.below(copies), disc);
    for (std::uint32_t other = dice.below(6); other > 0; --other)
      discs.push_back({disc.center, some_normal(dice), disc.radius * dice.between(0.2, 1.0)});
  }
  return discs;
}

Discs cluster(Dice& dice, std::uint32_t) {
  const dvec3 middle = somewhere(dice);
  const double size = dice.log_between(2.0, 512.0);
  Discs discs(20 + dice.below(200));
  for (Disc& disc : discs)
    disc = {middle + size * dice.unit() * dice.direction(), some_normal(dice),
            dice.log_between(LEAST_RADIUS, 4.0 * size)};
  return discs;
}

/// Discs on a rectangle about `middle`, spanned by u and v, at random places.
void add_sheet(Dice& dice, dvec3 middle, dvec3 u, dvec3 v, double normal_sign, Discs& discs) {
  const std::uint32_t count = 30 + dice.below(200);
  const double radius = std::sqrt(glm::length(glm::cross(u, v)) / count) * dice.between(1.0, 3.0);
  for (std::uint32_t i = 0; i < count; ++i)
    discs.push_back({middle + dice.between(-1.0, 1.0) * u + dice.between(-1.0, 1.0) * v,
                     normal_sign * glm::normalize(glm::cross(u, v)), std::max(radius, LEAST_RADIUS)});
}

/// Two parallel sheets less than a few radii apart.
Discs sheets(Dice& dice, std::uint32_t) {
  const dvec3 middle = dvec3(EDGE / 2.0) + EDGE / 8.0 * dice.in_cube();
  const double size = dice.log_between(64.0, EDGE / 4.0);
  const dvec3 u = size * dice.direction();
  const dvec3 v = size * glm::normalize(glm::cross(u, dice.direction()));
  const double gap = size * dice.log_between(1e-5, 0.3);
  Discs discs;
  add_sheet(dice, middle, u, v, 1.0, discs);
  add_sheet(dice, middle + gap * glm::normalize(glm::cross(u, v)), u, v, dice.sign(), discs);
  return discs;
}

/// Two sheets that meet in an edge at any angle.
Discs wedge(Dice& dice, std::uint32_t) {
  const dvec3 middle = dvec3(EDGE / 2.0) + EDGE / 8.0 * dice.in_cube();
  const double size = dice.log_between(64.0, EDGE / 8.0);
  const dvec3 edge = size * dice.direction();
  Discs discs;
  for (int side = 0; side < 2; ++side) {
    const dvec3 out = size * glm::normalize(glm::cross(edge, dice.direction()));
    add_sheet(dice, middle + out, edge, out, dice.sign(), discs);
  }
  return discs;
}

struct Kind {
  const char* name;
  std::function<Discs(Dice&, std::uint32_t copies)> make;
};

const std::array<Kind, 7> KINDS{{{"soup", soup},
                                 {"shell", shell},
                                 {"cell plane", cell_plane},
                                 {"coincident", coincident},
                                 {"cluster", cluster},
                                 {"sheets", sheets},
                                 {"wedge", wedge}}};

/// Keeps a disc inside what the anchors span, so that the root stays theirs.
Disc inside_root(Disc disc) {
  disc.center = glm::round(glm::clamp(disc.center, dvec3(BORDER), dvec3(EDGE - BORDER)));
  const dvec3 room = glm::min(disc.center, EDGE - disc.center);
  const double most = 0.99 * (std::min({room.x, room.y, room.z}) - BORDER / 2.0);
  disc.radius = std::clamp(disc.radius, LEAST_RADIUS, most);
  return disc;
}

InputObject object_of(Discs discs, Dice& dice, bool colored) {
  constexpr std::array FLAGS{0U,
                             0U,
                             MATERIAL_TWO_SIDED,
                             MATERIAL_DIELECTRIC,
                             MATERIAL_HIDDEN,
                             MATERIAL_TWO_SIDED | MATERIAL_DIELECTRIC};
  InputObject object;
  object.material = test_material(FLAGS[dice.below(FLAGS.size())]);
  object.oriented = dice.chance(0.5);
  const RootTransform& root = shared_root();
  for (Disc disc : discs) {
    disc = inside_root(disc);
    object.points.position.push_back(root.to_world(disc.center));
    object.points.normal.emplace_back(disc.normal);
    object.points.radius.push_back(float(disc.radius * root.unit_world));
    if (colored) object.points.color.emplace_back(0.5 + 0.5 * dice.in_cube());
  }
  return object;
}

/// Lets most discs of a scene end at one or two random lines. Of numbers of its own, so that recorded seeds keep their scenes.
void clip_some(RandomScene& random) {
  Dice dice(random.leaf_sizes[0]);
  for (InputObject& object : random.input.objects) {
    Points& points = object.points;
    points.clip.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const dvec3 normal(points.normal[i]);
      points.clip[i].reach = 2.0F * points.radius[i];
      for (std::uint32_t line = 0, lines = dice.below(3); line < lines; ++line) {
        points.clip[i].dir[line] = glm::vec3(glm::normalize(glm::cross(normal, dice.direction())));
        points.clip[i].distance[line] = points.radius[i] * float(dice.between(0.0, 1.1));
      }
    }
  }
}

/// Lets most discs be shaded with normals that are not theirs, likewise.
void lean_some(RandomScene& random) {
  Dice dice(random.leaf_sizes[1]);
  for (InputObject& object : random.input.objects)
    for (const glm::vec3& normal : object.points.normal)
      object.points.shading.push_back(
          dice.chance(0.3)
              ? glm::vec3(0.0F)
              : glm::normalize(normal + float(dice.between(0.0, 0.4)) * glm::vec3(dice.direction())));
}

InputObject anchor_object() {
  InputObject object;
  object.material = test_material(MATERIAL_TWO_SIDED);
  for (const Disc& disc : anchors()) {
    object.points.position.push_back(disc.center);
    object.points.normal.emplace_back(disc.normal);
    object.points.radius.push_back(float(disc.radius));
  }
  return object;
}

Settings random_settings(Dice& dice) {
  Settings settings;
  settings.blend = dice.chance(0.8) ? BLEND_WINDOW : BLEND_NEAREST;
  settings.kernel = dice.chance(0.5) ? KERNEL_RIM : KERNEL_GAUSSIAN;
  settings.side = dice.chance(0.8) ? SIDE_SIDE : SIDE_NONE;
  settings.kappa = dice.chance(0.3) ? 1.0F : float(dice.log_between(0.1, 4.0));
  return settings;
}

}  // namespace

RandomScene random_scene(Dice& dice) {
  RandomScene random;
  for (std::uint32_t& leaf_size : random.leaf_sizes) leaf_size = std::uint32_t(dice.log_between(1.0, 65.0));
  const std::uint32_t copies = std::min(random.leaf_sizes[0], random.leaf_sizes[1]);
  random.settings = random_settings(dice);
  std::ostringstream text;
  text << "leaf sizes " << random.leaf_sizes[0] << " and " << random.leaf_sizes[1] << ", blend "
       << random.settings.blend << ", kernel " << random.settings.kernel << ", side " << random.settings.side
       << ", kappa " << random.settings.kappa << ':';
  random.input.objects.push_back(anchor_object());
  const bool colored = dice.chance(0.5);
  for (std::uint32_t part = 1 + dice.below(4); part > 0; --part) {
    const Kind& kind = KINDS[dice.below(KINDS.size())];
    random.input.objects.push_back(object_of(kind.make(dice, copies), dice, colored && dice.chance(0.8)));
    const InputObject& object = random.input.objects.back();
    text << ' ' << object.points.size() << " splats of " << kind.name << " with flags "
         << object.material.flags << (object.points.color.empty() ? "," : " and colours,");
  }
  if (random.leaf_sizes[0] % 3 == 0) {
    clip_some(random);
    text << " clipped";
  }
  if (random.leaf_sizes[1] % 3 == 0) {
    lean_some(random);
    text << " leaning";
  }
  random.description = text.str();
  return random;
}

Scene built(const RandomScene& random, std::uint32_t leaf_size) {
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  return build_scene(random.input, params, 0, stats);
}

}  // namespace splatray::testing

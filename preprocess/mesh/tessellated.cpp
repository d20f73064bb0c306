#include "preprocess/mesh/tessellated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "preprocess/base/parallel.h"
#include "preprocess/mesh/edges/mesh_parts.h"

namespace splatray {
namespace {

/// What is foretold may be half of what is, or twice as much. Where curvature grows from nothing along a chord, normals lean at
/// its one end half as much as at the other.
constexpr double MOST_DIFFERENCE = 0.5;
constexpr double UNCERTAIN = 0.01;  // sine, of normals of 8 bits a component
constexpr double CURVED_PARTS = 0.5;
/// Cosine of 3 degrees: edges along which normals turn by less lie within 1/150 of their length on the curve.
constexpr double COARSE_COSINE = 0.9986;
constexpr double NO_AREA = 1e-9;  // least height of a triangle that has a plane, in units of its side

bool alike(double a, double b, double uncertain) {
  return std::abs(a - b) <= MOST_DIFFERENCE * std::max(std::abs(a), std::abs(b)) + uncertain;
}

/// A triangle seen from one of its sides, with the normals that its corners have.
struct SeenTriangle {
  std::array<glm::dvec3, 3> place, normal;  ///< of the side's ends and of the corner opposite to it
};

/// Sines by which the normals at a side's ends lean outwards.
std::array<double, 2> leans(const SeenTriangle& seen) {
  const glm::dvec3 along = glm::normalize(seen.place[1] - seen.place[0]);
  return {-glm::dot(along, seen.normal[0]), glm::dot(along, seen.normal[1])};
}

double most_lean(const SeenTriangle& seen) {
  const auto [from, to] = leans(seen);
  return std::max(std::abs(from), std::abs(to));
}

bool leans_alike(const SeenTriangle& seen) {
  const auto [from, to] = leans(seen);
  return alike(from, to, UNCERTAIN);
}

/// The plane of a triangle with a frame: its first side along u, its third corner before v.
struct Facet {
  explicit Facet(const SeenTriangle& seen) {
    const auto& [a, b, c] = seen.place;
    length = glm::length(b - a);
    u = (b - a) / length;
    apex_x = glm::dot(c - a, u);
    const glm::dvec3 across = c - a - apex_x * u;
    apex_y = glm::length(across);
    v = across / apex_y;
    up = glm::cross(u, v);
    if (glm::dot(up, seen.normal[0] + seen.normal[1] + seen.normal[2]) < 0.0) up = -up;
  }
  [[nodiscard]] bool has_area() const { return apex_y > NO_AREA * length; }

  glm::dvec3 u, v, up;  ///< unit; up on the side of the normals
  double length, apex_x, apex_y;
};

/// Whether the normals foretell how high above the triangle's plane `beyond`, the third corner of the triangle across the side,
/// lies: on the graph of the quadric through the corners that turns along the sides by what the normals do.
bool foretells(const SeenTriangle& seen, const glm::dvec3& beyond) {
  const Facet facet(seen);
  if (!facet.has_area()) return true;
  const double length = facet.length, cx = facet.apex_x, cy = facet.apex_y;
  const auto bend = [&](std::size_t from, std::size_t to) {
    return -glm::dot(seen.place[to] - seen.place[from], seen.normal[to] - seen.normal[from]);
  };
  // z = (uu x^2 + 2 uv x y + vv y^2) / 2 + slope_u x + slope_v y, which is 0 at the corners.
  const double uu = bend(0, 1) / (length * length);
  const double uv =
      (bend(0, 2) - bend(1, 2) - uu * (cx * cx - (cx - length) * (cx - length))) / (2.0 * length * cy);
  const double vv = (bend(0, 2) - uu * cx * cx - 2.0 * uv * cx * cy) / (cy * cy);
  const double slope_u = -0.5 * uu * length, slope_v = -(0.5 * bend(0, 2) + slope_u * cx) / cy;
  const glm::dvec3 offset = beyond - seen.place[0];
  const double x = glm::dot(offset, facet.u), y = glm::dot(offset, facet.v);
  const double foretold = 0.5 * (uu * x * x + 2.0 * uv * x * y + vv * y * y) + slope_u * x + slope_v * y;
  return alike(foretold, glm::dot(offset, facet.up), UNCERTAIN * glm::length(offset));
}

/// Whether `beyond` lies in the triangle's plane.
bool holds(const SeenTriangle& seen, const glm::dvec3& beyond) {
  const Facet facet(seen);
  const glm::dvec3 offset = beyond - seen.place[0];
  return facet.has_area() && std::abs(glm::dot(offset, facet.up)) <= UNCERTAIN * glm::length(offset);
}

/// Asks of the edges of one mesh.
class Chords {
 public:
  Chords(const Mesh& mesh, const std::vector<glm::uint>& weld, const std::vector<glm::vec3>& corners,
         const MeshEdges& edges)
      : mesh_(mesh), weld_(weld), corners_(corners), edges_(edges) {}

  [[nodiscard]] SeenTriangle seen_from(std::uint32_t triangle, std::uint32_t side) const {
    SeenTriangle seen;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = (side + i) % 3;
      seen.place[i] = mesh_.vertices.position[mesh_.triangles[triangle][static_cast<glm::length_t>(corner)]];
      seen.normal[i] = corners_[3 * std::size_t{triangle} + corner];
    }
    return seen;
  }

  /// The same edge, seen from the other triangle at it.
  [[nodiscard]] SeenTriangle seen_from_beside(std::uint32_t triangle, std::uint32_t side) const {
    const std::uint32_t beside = edges_.beside(triangle, side);
    for (std::uint32_t other = 0; other < 3; ++other)
      if (place(beside, other + 2) != place(triangle, side) &&
          place(beside, other + 2) != place(triangle, side + 1))
        return seen_from(beside, other);
    return seen_from(beside, 0);
  }

  [[nodiscard]] bool is_chord(std::uint32_t triangle, std::uint32_t side) const {
    const std::uint32_t beside = edges_.beside(triangle, side);
    const SeenTriangle own = seen_from(triangle, side);
    if (beside == triangle) return leans_alike(own);
    const SeenTriangle other = seen_from_beside(triangle, side);
    if (!leans_alike(own) || !leans_alike(other)) return false;
    return edges_.across(triangle, side) == MeshEdges::NONE ||
           (foretells(own, other.place[2]) && foretells(other, own.place[2]));
  }

  /// Whether the two triangles at a smooth edge lie in one plane.
  [[nodiscard]] bool is_flat(std::uint32_t triangle, std::uint32_t side) const {
    const SeenTriangle own = seen_from(triangle, side), other = seen_from_beside(triangle, side);
    return holds(own, other.place[2]) && holds(other, own.place[2]);
  }

  /// Whether normals turn enough along the edge for its chord to be seen.
  [[nodiscard]] bool is_coarse(std::uint32_t triangle, std::uint32_t side) const {
    const auto turns = [](const SeenTriangle& seen) {
      return glm::dot(seen.normal[0], seen.normal[1]) < COARSE_COSINE;
    };
    return turns(seen_from(triangle, side)) || turns(seen_from_beside(triangle, side));
  }

  /// Whether a smooth edge is curved, as its normals have it.
  [[nodiscard]] bool is_curved(std::uint32_t triangle, std::uint32_t side) const {
    return edges_.across(triangle, side) != MeshEdges::NONE &&
           std::max(most_lean(seen_from(triangle, side)), most_lean(seen_from_beside(triangle, side))) >
               UNCERTAIN;
  }

 private:
  [[nodiscard]] glm::uint place(std::uint32_t triangle, std::uint32_t corner) const {
    return weld_[mesh_.triangles[triangle][static_cast<glm::length_t>(corner % 3)]];
  }

  const Mesh& mesh_;
  const std::vector<glm::uint>& weld_;
  const std::vector<glm::vec3>& corners_;
  const MeshEdges& edges_;
};

/// Leaves out the chords beside what is none. Four corners of a flat wall, or those of a lid, lie on a dome, too, whose normals
/// they have where a file's are means across a bevel; a bevel's long edges look like arches in the same way. The facets beyond
/// show that there is neither. So an edge is bent only where all sides around its two triangles are chords; what is left out amid
/// facets in one plane leaves out its neighbours there, and a border or a crease stays where a facet at it bends towards another.
class LoneChords {
 public:
  LoneChords(const Chords& chords, const MeshEdges& edges, std::vector<std::uint8_t>& chord)
      : edges_(edges), chord_(chord), flat_(chord.size(), 0) {
    tbb::parallel_for(std::size_t{0}, chord.size(), [&](std::size_t i) {
      const auto t = static_cast<std::uint32_t>(i / 3), side = static_cast<std::uint32_t>(i % 3);
      if (chord[i] != 0 && is_smooth(t, side)) flat_[i] = chords.is_flat(t, side) ? 1 : 0;
    });
  }

  void leave_out_flats() {
    sweep([&](std::uint32_t t, std::uint32_t side) {
      return is_smooth(t, side) || bends(t) || bends(edges_.beside(t, side));
    });
    while (sweep([&](std::uint32_t t, std::uint32_t side) {
      return flat_[3 * std::size_t{t} + side] == 0 || is_amid_chords(t, side);
    })) {
    }
  }

  void leave_out_edges_of_none() {
    std::vector<std::uint8_t> kept(chord_.size(), 0);
    tbb::parallel_for(std::size_t{0}, chord_.size(), [&](std::size_t i) {
      const auto t = static_cast<std::uint32_t>(i / 3), side = static_cast<std::uint32_t>(i % 3);
      kept[i] = chord_[i] != 0 && is_amid_chords(t, side) ? 1 : 0;
    });
    chord_ = std::move(kept);
  }

 private:
  [[nodiscard]] bool is_smooth(std::uint32_t triangle, std::uint32_t side) const {
    return edges_.across(triangle, side) != MeshEdges::NONE;
  }
  /// Whether a triangle has a chord towards another, in another plane.
  [[nodiscard]] bool bends(std::uint32_t triangle) const {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::size_t i = 3 * std::size_t{triangle} + side;
      if (is_smooth(triangle, side) && chord_[i] != 0 && flat_[i] == 0) return true;
    }
    return false;
  }
  [[nodiscard]] bool all_chords(std::uint32_t triangle) const {
    const std::size_t i = 3 * std::size_t{triangle};
    return chord_[i] != 0 && chord_[i + 1] != 0 && chord_[i + 2] != 0;
  }
  /// Whether all sides of the triangles that an edge joins smoothly are chords.
  [[nodiscard]] bool is_amid_chords(std::uint32_t triangle, std::uint32_t side) const {
    const std::uint32_t across = edges_.across(triangle, side);
    return all_chords(triangle) && (across == MeshEdges::NONE || all_chords(across));
  }
  /// Keeps those chords that do; whether any did not.
  template <typename Stays>
  bool sweep(const Stays& stays) {
    bool changed = false;
    for (std::size_t i = 0; i < chord_.size(); ++i) {
      if (chord_[i] == 0 || stays(static_cast<std::uint32_t>(i / 3), static_cast<std::uint32_t>(i % 3)))
        continue;
      chord_[i] = 0;
      changed = true;
    }
    return changed;
  }

  const MeshEdges& edges_;
  std::vector<std::uint8_t>& chord_;
  std::vector<std::uint8_t> flat_;
};

/// Whether each part is a tessellated curve.
std::vector<std::uint8_t> curved_parts(const MeshParts& parts, const Chords& chords,
                                       const std::vector<std::uint8_t>& chord) {
  std::vector<double> curved(parts.count, 0.0), agree(parts.count, 0.0);
  for (std::uint32_t t = 0; t < parts.of.size(); ++t)
    for (std::uint32_t side = 0; side < 3; ++side) {
      if (!chords.is_curved(t, side)) continue;
      curved[parts.of[t]] += 1.0;
      agree[parts.of[t]] += chord[3 * std::size_t{t} + side] != 0 ? 1.0 : 0.0;
    }
  std::vector<std::uint8_t> round(parts.count);
  for (std::size_t i = 0; i < round.size(); ++i) round[i] = agree[i] >= CURVED_PARTS * curved[i] ? 1 : 0;
  return round;
}

}  // namespace

std::vector<std::uint8_t> chord_sides(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                      const std::vector<glm::vec3>& corners, const MeshEdges& edges,
                                      const std::vector<bool>* shared) {
  if (mesh.vertices.normal.empty()) return {};
  const Chords chords(mesh, weld, corners, edges);
  const auto ends_at_another = [&](std::uint32_t t, std::uint32_t side) {
    const auto from = static_cast<glm::length_t>(side);
    const glm::uvec3& at = mesh.triangles[t];
    return edges.beside(t, side) == t && shared != nullptr && (*shared)[at[from]] &&
           (*shared)[at[(from + 1) % 3]];
  };
  std::vector<std::uint8_t> chord(3 * mesh.triangles.size(), 0);
  tbb::parallel_for(std::size_t{0}, chord.size(), [&](std::size_t i) {
    const auto t = static_cast<std::uint32_t>(i / 3), side = static_cast<std::uint32_t>(i % 3);
    if (edges.beside(t, side) == MeshEdges::NONE || ends_at_another(t, side)) return;
    chord[i] = chords.is_chord(t, side) ? 1 : 0;
  });
  LoneChords lone(chords, edges, chord);
  lone.leave_out_flats();
  const MeshParts parts = find_parts(
      mesh.triangles.size(), [&](std::uint32_t t, std::uint32_t side) { return edges.beside(t, side); });
  const std::vector<std::uint8_t> round = curved_parts(parts, chords, chord);
  lone.leave_out_edges_of_none();
  tbb::parallel_for(std::size_t{0}, chord.size(), [&](std::size_t i) {
    const auto t = static_cast<std::uint32_t>(i / 3), side = static_cast<std::uint32_t>(i % 3);
    if (chord[i] != 0 && (round[parts.of[t]] == 0 || !chords.is_coarse(t, side))) chord[i] = 0;
  });
  return chord;
}

}  // namespace splatray

/// An object's points, repaired and in an order that depends on the points alone.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "preprocess/base/far_points.h"
#include "preprocess/build_stats.h"
#include "preprocess/points.h"

namespace splatray {

class NearPlaces;

/// Steps of Cloud::coord. Distinct coordinates differ by at least this, so no squared distance underflows.
inline constexpr float COORD_STEP = 0x1p-24F;

/// Points of one object. All arrays that are not empty have the same length. Order: Morton key of the
/// coordinates, then every attribute, so that shuffled input gives the same cloud.
struct Cloud {
  glm::dvec3 center_world{0.0};      ///< centre of the points' bounding box
  double half_extent_world = 1.0;    ///< half its longest side; 1 when all points coincide
  std::vector<glm::dvec3> position;  ///< world units; empty = as `coord` says
  std::vector<glm::vec3> coord;    ///< (position - center) / half_extent in [-1, 1], multiples of COORD_STEP
  std::vector<glm::vec3> normal;   ///< unit; zero = unknown
  std::vector<glm::vec3> shading;  ///< Points::shading
  std::vector<std::uint32_t> color;      ///< pack_color; empty = none
  std::vector<float> radius;             ///< in units of half_extent_world; zero = unknown; empty = all are
  std::vector<glm::vec3> field;          ///< normal field: uu, uv, vv of the change of the unit normal per
                                         ///< half_extent_world in TangentFrame(normal); empty = all flat
  std::vector<PointClip> clip;           ///< in units of half_extent_world; empty = the surface ends nowhere
  std::vector<PointEllipse> ellipse;     ///< in units of half_extent_world; empty = all are discs
  std::vector<ScanKind> kind;            ///< of points that were measured; empty = all are of surfaces
  std::vector<float> radius_most;        ///< of unknown radii, the same units; empty or infinite = no limit
  std::vector<Column> columns;           ///< further attributes
  std::vector<Station> stations;         ///< where the points were measured from; empty = not known
  std::vector<std::uint16_t> station;    ///< indices into `stations`; empty = all points are of the first
  std::vector<std::uint32_t> grid_cell;  ///< Points::grid_cell
  std::vector<std::uint32_t> mean_of;    ///< Points::mean_of
  std::vector<TrackPlace> track;         ///< Points::track
  std::optional<RootTransform> lattice;  ///< Points::lattice, with the words of such points
  std::vector<std::uint32_t> field_words, clip_words;
  bool ends_known = false;  ///< the surface ends, or has a crease, only where `clip` says so
  bool measured = false;    ///< by a scanner: neither a mesh's nor made
  bool on_facets = false;   ///< a mesh's: its points lie on flat facets
  bool oriented = false;    ///< normals point outwards: opposite normals are opposite sheets
  FarPoints far;            ///< as they were found; in the cloud only where it is not measured
  /// The search among these coordinates, all different and on surfaces; null = not looked for yet, or the points have changed since.
  std::shared_ptr<const NearPlaces> near;

  [[nodiscard]] std::size_t size() const { return coord.size(); }
  /// Where a point is, world units.
  [[nodiscard]] glm::dvec3 place_world(std::size_t i) const {
    return position.empty() ? center_world + half_extent_world * glm::dvec3(coord[i]) : position[i];
  }
  /// A place of the world in cloud coordinates.
  [[nodiscard]] glm::dvec3 in_cloud(const glm::dvec3& world) const {
    return (world - center_world) / half_extent_world;
  }
  [[nodiscard]] bool is_ellipse(std::size_t i) const {
    return !ellipse.empty() && ellipse[i].half_length > 0.0F;
  }
  [[nodiscard]] bool on_surface(std::size_t i) const { return kind.empty() || kind[i] == ScanKind::surface; }
  /// The number of a point's station; meant only where there are stations.
  [[nodiscard]] std::size_t station_of(std::size_t i) const { return station.empty() ? 0 : station[i]; }
  /// Where a point's scanner was, cloud coordinates, if that is known.
  [[nodiscard]] std::optional<glm::dvec3> sensor_of(std::size_t i) const {
    const std::size_t s = station_of(i);
    if (s >= stations.size() || !stations[s].sensor_world) return {};
    return in_cloud(*stations[s].sensor_world);
  }
};

/// The box of the places, world units.
[[nodiscard]] Bounds bounds_of(const Cloud& cloud);

/// Takes an object's points: drops positions that are not finite (or beyond 1e100) and, of points that were measured, those
/// that lie far from all others, before anything depends on the box of the points; normalises normals in float64, turns normals
/// and radii that cannot be used into "unknown" and orders the points. Adds to the counts of `stats`.
[[nodiscard]] Cloud make_cloud(Points&& points, bool oriented, bool measured, BuildStats& stats);

/// Leaves one of points that are alike in all that is known of them but COLUMN_INPUT_NUMBER. How many are gone.
std::size_t drop_copies(Cloud& cloud);

/// Leaves the points of these ascending numbers in the cloud; its frame stays.
void keep_points(Cloud& cloud, const std::vector<std::uint32_t>& kept);

/// Adds copies of the points of these numbers behind the others; the cloud is then out of order.
void add_copies(Cloud& cloud, const std::vector<std::uint32_t>& of);

/// Puts points whose normals or places were changed in order again.
void put_in_order(Cloud& cloud);

/// Puts points whose positions were changed, and are known, where these say and in order again; the cloud's frame stays.
void follow_positions(Cloud& cloud);

/// Moves points by this much along their normals (cloud coordinates); the cloud is then out of order, its frame stays.
void move_points(Cloud& cloud, const std::vector<float>& lift);

}  // namespace splatray

/// What a build did.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace splatray {

/// Counts and times of a build; what --stats-json writes and the last lines of splatray-preprocess print.
struct BuildStats {
  std::uint64_t points_read = 0;
  std::uint64_t dropped_non_finite = 0;  ///< position not finite, or beyond 1e100
  std::uint64_t dropped_far = 0;         ///< of scans: a handful far from all others (find_far_points)
  /// Points of scans that are copies of others, and copies of a splat (same 128 bits) beyond 8, or leaf_size if less.
  std::uint64_t dropped_duplicates = 0;
  std::uint64_t dropped_isolated = 0;     ///< strays of scans: far from all others
  std::uint64_t dropped_mixed = 0;        ///< of scans with grids: between the two surfaces that a beam met
  std::uint64_t dropped_unsupported = 0;  ///< of noisy scans: fewer than 6 neighbours on their surface
  std::array<std::uint64_t, 3> kinds{};   ///< of scans without normals: points of each ScanKind
  std::uint64_t smoothed = 0;             ///< points of noisy scans, moved onto their surface
  /// Noise of the noisiest scan without normals: heights off the surface over the distance to the 8th place.
  double noise = 0.0;
  double moved_median_world = 0.0;          ///< how far smoothing moved points
  std::array<std::uint64_t, 5> sides_by{};  ///< scans without normals by what decided their sides (SideRung)
  /// Share of a room's surface whose density the scanner's place that was found explains; 0 = none was found.
  double station_explained = 0.0;
  std::uint64_t sides_unsure = 0;  ///< points whose side is a guess
  std::uint64_t normals_given = 0;
  std::uint64_t normals_estimated = 0;  ///< of points without a usable normal
  std::uint64_t radii_given = 0;
  std::uint64_t radii_repaired = 0;  ///< given radius zero, negative or not finite: computed instead
  /// No neighbour to take a radius from: 1/100 of the scene's diagonal instead.
  std::uint64_t radii_isolated = 0;
  std::uint64_t dots = 0;  ///< of scans: large discs that nothing around them shows to be surface (make_dots)
  std::uint64_t splats = 0;
  std::uint64_t clipped = 0;        ///< splats that end at a border or a crease
  std::uint64_t ellipses = 0;       ///< splats that are longer than wide
  std::uint64_t creased = 0;        ///< points of scans at which a crease was found
  std::uint64_t bordered = 0;       ///< points of scans at which a border was found
  std::uint64_t crease_copies = 0;  ///< points added, as a crease's points lie on several planes
  std::uint64_t references = 0;     ///< data pool entries
  std::uint64_t nodes = 0;
  std::uint64_t filled_leaves = 0;
  std::uint64_t depth = 0;      ///< deepest leaf level
  double growth = 0.0;          ///< references / splats - 1
  double growth_overlap = 0.0;  ///< what policy overlap would give; 0 unless known
  double overlap = 0.0;         ///< sum(pi r^2) / surface area; 0 = area unknown
  double radius_median_world = 0.0;
  double read_ms = 0.0, normals_ms = 0.0, radii_ms = 0.0, octree_ms = 0.0, insertion_ms = 0.0, slabs_ms = 0.0,
         empty_ms = 0.0, total_ms = 0.0;
  /// A sentence each: points far from all others, objects that are too small.
  std::vector<std::string> notes;
};

}  // namespace splatray

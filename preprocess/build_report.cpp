#include "preprocess/build_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/base/json_text.h"
#include "preprocess/scan/sides.h"

namespace splatray {

namespace {

nlohmann::ordered_json sides_json(const BuildStats& stats) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t rung = 0; rung < SIDE_RUNGS; ++rung)
    json[std::string(name_of(static_cast<SideRung>(rung)))] = stats.sides_by[rung];
  return json;
}

nlohmann::ordered_json kinds_json(const BuildStats& stats) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t kind = 0; kind < SCAN_KINDS; ++kind)
    json[std::string(name_of(static_cast<ScanKind>(kind)))] = stats.kinds[kind];
  return json;
}

/// What was repaired of scans, in a line each.
void report_scans(const BuildStats& stats, std::ostringstream& text) {
  if (stats.dropped_isolated + stats.dropped_mixed + stats.dropped_unsupported > 0) {
    text << "  not drawn: " << stats.dropped_isolated << " isolated points, " << stats.dropped_mixed
         << " between two surfaces, " << stats.dropped_unsupported << " with too few neighbours\n";
  }
  const auto [surface, line, scatter] = stats.kinds;
  if (line + scatter > 0) {
    const double percent = 100.0 / static_cast<double>(surface + line + scatter);
    text << "  kinds of points: " << percent * static_cast<double>(surface) << " % surface, "
         << percent * static_cast<double>(line) << " % line, " << percent * static_cast<double>(scatter)
         << " % scatter\n";
  }
  if (stats.smoothed > 0) {
    text << "  " << stats.smoothed << " points smoothed (noise " << stats.noise
         << " of the spacing), moved by " << stats.moved_median_world << " (median)\n";
  }
  if (stats.creased + stats.bordered > 0) {
    text << "  found among points: " << stats.creased << " at creases (" << stats.crease_copies
         << " on several planes), " << stats.bordered << " at borders\n";
  }
  if (stats.dots > 0)
    text << "  " << stats.dots << " large discs that nothing around them shows are small dots\n";
  for (std::size_t rung = 0; rung < SIDE_RUNGS; ++rung) {
    if (stats.sides_by[rung] == 0) continue;
    text << "  sides of normals decided by: " << name_of(static_cast<SideRung>(rung));
    if (stats.sides_unsure > 0) text << " (" << stats.sides_unsure << " points unsure)";
    text << '\n';
  }
  if (stats.station_explained > 0.0)
    text << "  the scanner's place was found: it explains how dense "
         << std::round(100.0 * stats.station_explained) << " % of the surface is\n";
}

}  // namespace

std::string build_stats_json(const BuildStats& stats) {
  const nlohmann::ordered_json json = {{"points_read", stats.points_read},
                                       {"dropped_non_finite", stats.dropped_non_finite},
                                       {"dropped_far", stats.dropped_far},
                                       {"dropped_duplicates", stats.dropped_duplicates},
                                       {"dropped_isolated", stats.dropped_isolated},
                                       {"dropped_mixed", stats.dropped_mixed},
                                       {"dropped_unsupported", stats.dropped_unsupported},
                                       {"kinds", kinds_json(stats)},
                                       {"smoothed", stats.smoothed},
                                       {"noise", stats.noise},
                                       {"moved_median_world", stats.moved_median_world},
                                       {"sides_by", sides_json(stats)},
                                       {"station_explained", stats.station_explained},
                                       {"sides_unsure", stats.sides_unsure},
                                       {"normals_given", stats.normals_given},
                                       {"normals_estimated", stats.normals_estimated},
                                       {"radii_given", stats.radii_given},
                                       {"radii_repaired", stats.radii_repaired},
                                       {"radii_isolated", stats.radii_isolated},
                                       {"dots", stats.dots},
                                       {"splats", stats.splats},
                                       {"clipped", stats.clipped},
                                       {"ellipses", stats.ellipses},
                                       {"creased", stats.creased},
                                       {"bordered", stats.bordered},
                                       {"crease_copies", stats.crease_copies},
                                       {"references", stats.references},
                                       {"nodes", stats.nodes},
                                       {"filled_leaves", stats.filled_leaves},
                                       {"depth", stats.depth},
                                       {"growth", stats.growth},
                                       {"growth_overlap", stats.growth_overlap},
                                       {"overlap", stats.overlap},
                                       {"radius_median_world", stats.radius_median_world},
                                       {"read_ms", stats.read_ms},
                                       {"normals_ms", stats.normals_ms},
                                       {"radii_ms", stats.radii_ms},
                                       {"octree_ms", stats.octree_ms},
                                       {"insertion_ms", stats.insertion_ms},
                                       {"slabs_ms", stats.slabs_ms},
                                       {"empty_ms", stats.empty_ms},
                                       {"total_ms", stats.total_ms}};
  return json_text(json, 2);
}

std::string build_summary(const BuildStats& stats, const std::filesystem::path& path) {
  std::ostringstream text;
  text.precision(4);
  text << stats.points_read << " points -> " << stats.splats << " splats, median radius "
       << stats.radius_median_world << '\n';
  const auto repair = [&](std::uint64_t count, const char* what) {
    if (count > 0) text << "  " << count << ' ' << what << '\n';
  };
  repair(stats.dropped_non_finite, "points dropped: position not finite or beyond 1e100");
  repair(stats.dropped_far, "points dropped: far from all others");
  repair(stats.dropped_duplicates, "points dropped: copies of others");
  repair(stats.normals_estimated, "normals estimated");
  report_scans(stats, text);
  repair(stats.radii_repaired, "given radii computed anew: zero, negative or not finite");
  repair(stats.radii_isolated, "points without neighbours: radius relative to the scene");
  repair(stats.clipped, "splats end at a border or a crease");
  repair(stats.ellipses, "splats are ellipses");
  text << "  " << stats.nodes << " nodes, " << stats.filled_leaves << " filled leaves, depth " << stats.depth
       << ", " << stats.references << " references: growth " << 100.0 * stats.growth << " %";
  if (stats.growth_overlap > stats.growth) text << " (overlap: " << 100.0 * stats.growth_overlap << " %)";
  if (stats.overlap > 0.0) text << ", disc area / surface area " << stats.overlap;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  text << "\n  " << path.string() << ": " << bytes / 1e6 << " MB, "
       << bytes / static_cast<double>(stats.splats) << " bytes per splat; read " << stats.read_ms / 1e3
       << " s, build " << stats.total_ms / 1e3 << " s\n";
  return text.str();
}

}  // namespace splatray

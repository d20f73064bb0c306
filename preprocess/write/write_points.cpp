#include "preprocess/write/write_points.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/scene/clip.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/write/point_output.h"

namespace splatray {
namespace {

struct PointFormat {
  const char* extension;
  void (*write)(const PointTable& table, PointOutput& out);
  /// Whether it has a place for each; files without an up direction are read with z up.
  bool has_up, has_system, has_sensors, has_ellipses;
};

constexpr PointFormat WRITTEN_FORMATS[] = {{".ply", write_ply, true, true, true, true},
                                           {".las", write_las, false, true, false, false},
                                           {".csv", write_csv, false, false, false, false},
                                           {".vtp", write_vtp, true, true, true, true}};

const PointFormat* point_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  for (const PointFormat& format : WRITTEN_FORMATS)
    if (extension == format.extension) return &format;
  return nullptr;
}

}  // namespace

void PointOutput::report(double share) const {
  if (progress_ && !progress_("writing", share))
    throw Error(ExitCode::interrupted, "writing the points was interrupted");
}

bool is_point_output(const std::filesystem::path& path) {
  if (point_format(path) != nullptr) return true;
  if (lower_extension(path) != ".soct")
    throw Error(ExitCode::usage, "found output '" + path.string() +
                                     "', expected .soct, or .ply, .las, .csv or .vtp for the points");
  return false;
}

std::string lost_by_format(const Scene& scene, const std::filesystem::path& path) {
  const PointFormat& format = *point_format(path);
  const bool has_sensors =
      std::any_of(scene.stations.begin(), scene.stations.end(),
                  [](const Station& station) { return station.sensor_world.has_value(); });
  std::string lost;
  const auto add = [&lost](const std::string& what) { lost += (lost.empty() ? "" : ", ") + what; };
  if (!format.has_up && scene.up != glm::dvec3(0.0, 0.0, 1.0))
    add("the up direction " + number_text(scene.up) + " (it is read with 0,0,1)");
  if (!format.has_system && !scene.crs.empty()) add("the coordinate system");
  if (!format.has_sensors && has_sensors) add("the places of scanners");
  if (!format.has_ellipses && clip_content(scene.clip_pool).ellipses)
    add("the ellipses of splats (they are read as discs of their length)");
  return lost.empty() ? lost : path.string() + ": its format does not hold " + lost + "; .ply and .vtp do";
}

void write_points(const PointTable& table, const std::filesystem::path& path, const Progress& progress) {
  AtomicFile file(path);
  PointOutput out(file, progress, table.size);
  point_format(path)->write(table, out);
  file.commit();
}

}  // namespace splatray

#include "preprocess/levels/divide_points.h"

#include <algorithm>
#include <limits>

#include "engine/base/error.h"
#include "preprocess/base/bounds.h"
#include "preprocess/base/parallel.h"

namespace splatray {
namespace {

void report(const Progress& progress, const char* stage, std::size_t done, std::size_t of) {
  Stage{stage, progress}.report(static_cast<double>(done) / static_cast<double>(of));
}

/// Cuts what was written after the parts' sizes were kept.
void cut_parts(const DividedSoFar& divided, const LevelFolder& folder) {
  for (std::size_t part = 0; part < divided.bytes.size(); ++part) {
    const std::filesystem::path& file = folder.records(part);
    std::error_code error;
    const bool is_there = std::filesystem::exists(file, error);
    const std::uint64_t bytes = is_there ? std::filesystem::file_size(file, error) : 0;
    if (bytes < divided.bytes[part])
      throw Error(ExitCode::failed, file.string() + ": found " + std::to_string(bytes) +
                                        " bytes, expected at least " + std::to_string(divided.bytes[part]) +
                                        "; ept-build can be removed to begin anew");
    if (is_there) std::filesystem::resize_file(file, divided.bytes[part], error);
    if (error) throw Error(ExitCode::failed, file.string() + ": " + error.message());
  }
}

constexpr std::size_t NO_STATION = std::numeric_limits<std::size_t>::max();

/// Points without a station beside others with one are of one that no one knows.
void name_unknown_stations(LevelJob& job) {
  const bool are_some =
      std::find(job.first_stations.begin(), job.first_stations.end(), NO_STATION) != job.first_stations.end();
  std::replace(job.first_stations.begin(), job.first_stations.end(), NO_STATION, job.stations.size());
  if (are_some && !job.stations.empty()) job.stations.emplace_back();
}

/// Records of some points, those of a part together.
std::vector<std::vector<unsigned char>> records_by_part(const Points& points, std::size_t first_station,
                                                        const LevelJob& job) {
  std::vector<unsigned char> records;
  append_records(points, job.schema, first_station, records);
  std::vector<std::vector<unsigned char>> parts(job.plan.parts.size());
  const std::size_t bytes = job.schema.record_bytes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const unsigned char* record = records.data() + i * bytes;
    const std::size_t part = job.plan.part_of(job.plan.lattice.place(job.schema.position(record)));
    if (part == parts.size())
      throw Error(ExitCode::input_unreadable, "found a point that was not counted: a file has changed");
    parts[part].insert(parts[part].end(), record, record + bytes);
  }
  return parts;
}

}  // namespace

LevelJob plan_levels(PointBatches& batches, std::uint64_t most_part_points, const Progress& progress) {
  LevelJob job;
  CellCounts counts;
  Bounds box;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    report(progress, "counting", i, batches.size());
    const Points points = batches.read(i);
    counts.add(points.position);
    for (const glm::dvec3& position : points.position) box.add(position);
    job.first_stations.push_back(points.stations.empty() ? NO_STATION : job.stations.size());
    job.stations.insert(job.stations.end(), points.stations.begin(), points.stations.end());
    widen_schema(job.schema, tile_schema_of(points, batches.step_world(), batches.origin_world()));
  }
  name_unknown_stations(job);
  if (counts.points() == 0)
    throw Error(ExitCode::input_unreadable,
                batches.files().front().string() + ": found no points, expected some for levels");
  job.plan = counts.plan(most_part_points);
  job.crs = batches.crs();
  job.points = counts.points();
  job.box_low = box.low;
  job.box_high = box.high;
  return job;
}

void divide_points(PointBatches& batches, const LevelJob& job, const LevelFolder& folder,
                   const Progress& progress) {
  DividedSoFar divided = folder.divided(job.plan.parts.size());
  if (divided.batches >= batches.size()) return;
  cut_parts(divided, folder);
  for (; divided.batches < batches.size(); folder.keep(divided)) {
    report(progress, "dividing", divided.batches, batches.size());
    const std::vector<std::vector<unsigned char>> parts =
        records_by_part(batches.read(divided.batches), job.first_stations[divided.batches], job);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (parts[part].empty()) continue;
      write_records(parts[part], folder.records(part), /*append=*/true);
      divided.bytes[part] += parts[part].size();
    }
    ++divided.batches;
  }
}

}  // namespace splatray

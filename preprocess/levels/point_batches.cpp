#include "preprocess/levels/point_batches.h"

#include <algorithm>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/file/file_roles.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/scan/input_files.h"
#include "preprocess/read/scan/no_data.h"

namespace splatray {
namespace {

bool is_las(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  return format != nullptr && format->read_scan == &read_las;
}

/// The points of a file that is read at once.
ScanFile read_whole(const std::filesystem::path& path, const ReadOptions& options,
                    const ReadListener& listener) {
  const Format* format = find_format(path);
  if (format != nullptr && format->read_scan != nullptr) return format->read_scan(path, options, listener);
  if (format == nullptr || format->read_mesh == nullptr)
    throw Error(ExitCode::input_unreadable, path.string() + ": found no scan, expected points for levels");
  Mesh mesh = format->read_mesh(path, options, listener);
  if (!mesh.triangles.empty())
    throw Error(ExitCode::input_unreadable, path.string() + ": found a mesh, expected points for levels");
  ScanFile file;
  file.counts.stored = mesh.vertices.size();
  file.points = std::move(mesh.vertices);
  return file;
}

/// What readers give of points that levels have no place for, for people; empty where that is nothing.
std::string lost_by_levels(const Points& points) {
  std::string lost;
  const auto add = [&lost](const std::string& what) { lost += (lost.empty() ? "" : ", ") + what; };
  if (std::any_of(points.radius.begin(), points.radius.end(), [](float radius) { return radius > 0.0F; }))
    add("radii");
  if (std::any_of(points.ellipse.begin(), points.ellipse.end(),
                  [](const PointEllipse& one) { return one.half_length > 0.0F; }))
    add("ellipses");
  if (!points.field_words.empty() || !points.clip_words.empty()) add("normal fields and clip lines");
  if (points.up && *points.up != glm::dvec3(0.0, 0.0, 1.0))
    add("up direction " + number_text(*points.up) + " (it is read with 0,0,1)");
  return lost;
}

}  // namespace

PointBatches::PointBatches(const std::vector<std::filesystem::path>& inputs, const ReadOptions& options)
    : options_(options) {
  for (const InputFile& file : input_files(inputs)) {
    note_input(file.path);
    files_.push_back(file.path);
  }
  for (std::size_t file = 0; file < files_.size(); ++file) {
    if (is_las(files_[file]))
      add_las(file);
    else
      step_world_ = glm::dvec3(0.0), batches_.push_back({file, 0});
  }
}

void PointBatches::open(std::size_t file) {
  if (las_ != nullptr && opened_ == file) return;
  las_ = std::make_unique<LasBatches>(files_[file], options_, ReadListener{notes_, options_.progress});
  opened_ = file;
}

void PointBatches::add_las(std::size_t file) {
  open(file);
  require_one_system(files_[file], las_->crs(), las_->in_degrees().value_or(false));
  const LasHeader& header = las_->header();
  if (file == 0) step_world_ = header.scale, origin_world_ = header.offset;
  if (header.scale != step_world_ || header.offset != origin_world_) step_world_ = glm::dvec3(0.0);
  for (std::size_t part = 0; part < las_->size(); ++part) batches_.push_back({file, part});
}

void PointBatches::require_one_system(const std::filesystem::path& path, const std::string& crs,
                                      bool in_degrees) {
  if (in_degrees || describe_crs(crs).is_degrees)
    throw Error(
        ExitCode::input_unreadable,
        path.string() + ": found coordinates in degrees, expected lengths: the nodes of levels are cubes");
  if (!crs.empty() && !crs_.empty() && !is_same_crs(crs, crs_))
    throw Error(ExitCode::input_unreadable, path.string() + ": found the coordinate system '" +
                                                describe_crs(crs).name + "' beside '" +
                                                describe_crs(crs_).name + "', expected one");
  if (crs_.empty()) crs_ = crs;
}

void PointBatches::note_lost(const std::filesystem::path& path, const Points& points) {
  const std::string lost = lost_by_levels(points);
  std::string note = path.string() + ": levels do not hold the " + lost + " of its points; a .soct does";
  if (!lost.empty() && std::find(notes_.begin(), notes_.end(), note) == notes_.end())
    notes_.push_back(std::move(note));
}

Points PointBatches::read(std::size_t i) {
  const Batch& batch = batches_[i];
  const std::filesystem::path& path = files_[batch.file];
  if (i == 0) counts_ = {}, notes_.clear();
  const ReadListener listener{notes_, options_.progress};
  if (is_las(path)) {
    open(batch.file);
    Points points = las_->read(batch.part, counts_, listener);
    note_lost(path, points);
    return points;
  }
  ScanFile file = read_whole(path, options_, listener);
  require_one_system(path, file.points.crs, file.in_degrees.value_or(false));
  remove_no_data(path, file.points, file.counts, listener);
  counts_ += file.counts;
  note_lost(path, file.points);
  return std::move(file.points);
}

}  // namespace splatray

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/one_line.h"
#include "engine/base/utf8.h"
#include "engine/file/file_roles.h"
#include "engine/scene/phong.h"
#include "preprocess/base/counted_list.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/base/thread_limit.h"
#include "preprocess/mesh/mesh_points.h"
#include "preprocess/points.h"
#include "preprocess/read/adjust_points.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/join_scans.h"
#include "preprocess/read/one_system.h"
#include "preprocess/read/read_mesh.h"
#include "preprocess/read/scan/empty_stations.h"
#include "preprocess/read/scan/input_files.h"
#include "preprocess/read/scan/missing_attributes.h"
#include "preprocess/read/scan/no_data.h"
#include "preprocess/read/text/read_track.h"

namespace splatray {
namespace {

Input read_geometry(const std::filesystem::path& path, const ReadOptions& options,
                    const ReadListener& listener) {
  Input input;
  InputObject object;
  object.name = path_text(path.stem());
  object.meshes.push_back(read_mesh(path, options, listener));
  if (object.meshes.front().triangles.empty())
    remove_no_data(path, object.meshes.front().vertices, input.scan_counts, listener);
  listener.show(object.meshes.front().vertices, object.meshes.front().triangles.empty());
  input.crs = object.meshes.front().vertices.crs;
  input.up = object.meshes.front().vertices.up;
  object.material = default_material(!object.meshes.front().vertices.color.empty());
  input.objects.push_back(std::move(object));
  return input;
}

/// What became of the points where none is left; empty where there were none.
std::string fate_of(const ScanCounts& counts) {
  const std::pair<std::uint64_t, const char*> lost[] = {{counts.withheld, "withheld"},
                                                        {counts.noise, "of the classes of noise"},
                                                        {counts.no_return, "without a finite position"},
                                                        {counts.missing, "missing or damaged"}};
  return counted_list(lost);
}

/// What is found where no point is left of those counted.
std::string no_points_found(const ScanCounts& counts) {
  const std::string fate = fate_of(counts);
  return fate.empty() ? "found no points"
                      : "found no points to keep: of " + std::to_string(counts.stored) + " points, " + fate;
}

/// Keeps a scan until all are read, unless it has no points; what it says of the whole input. An empty one says nothing but
/// what was left out of it.
Input add_scan(const std::filesystem::path& path, ScanFile file, const ReadListener& listener,
               std::vector<NamedScan>& scans) {
  Input input;
  remove_no_data(path, file.points, file.counts, listener);
  input.scan_counts = file.counts;
  if (file.points.size() == 0) {
    listener.note(path, no_points_found(file.counts) + "; it was left out");
    return input;
  }
  const std::vector<std::string> empty = remove_empty_stations(file.points);
  if (!empty.empty()) listener.note(path, "found no points in " + quoted_list(empty) + "; left out");
  input.up = file.up;
  input.crs = file.points.crs;
  scans.push_back({path_text(path.stem()), std::move(file), path});
  return input;
}

template <class T>
void move_append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

void merge(Input& to, Input&& more) {
  move_append(to.objects, more.objects);
  move_append(to.lights, more.lights);
  move_append(to.notes, more.notes);
  to.camera = to.camera ? to.camera : more.camera;
  to.up = to.up ? to.up : more.up;
  to.scan_counts += more.scan_counts;
  to.environment_path = to.environment_path.empty() ? more.environment_path : to.environment_path;
}

/// build_scene numbers the dielectrics modulo 32.
void note_many_dielectrics(Input& input) {
  const auto count = std::count_if(input.objects.begin(), input.objects.end(), [](const InputObject& object) {
    return (object.material.flags & MATERIAL_DIELECTRIC) != 0;
  });
  if (count > std::ptrdiff_t{MASK_BITS}) {
    input.notes.push_back("found " + std::to_string(count) +
                          " dielectric objects; those whose numbers agree modulo 32 must not overlap");
  }
}

/// Puts the camera's target beside the middle of what there is, so that turning about it makes sense.
void aim_camera(Input& input) {
  if (!input.camera) return;
  glm::dvec3 sum{0.0};
  double count = 0.0;
  for (const InputObject& object : input.objects) {
    for (const glm::dvec3& position : object.points.position) {
      const bool finite = glm::dot(position, position) < INFINITY;
      sum += finite ? position : glm::dvec3(0.0);
      count += finite ? 1.0 : 0.0;
    }
  }
  if (count > 0.0) {
    const glm::dvec3 ahead = input.camera->target - input.camera->eye;
    const double distance = glm::dot(sum / count - input.camera->eye, ahead);
    input.camera->target = input.camera->eye + ahead * (distance > 0.0 ? distance : 1.0);
  }
}

void drop_empty_objects(Input& input) {
  std::erase_if(input.objects, [&](const InputObject& object) {
    if (object.points.size() == 0) {
      input.notes.push_back(object.name + ": left out, it got no points");
    }
    return object.points.size() == 0;
  });
}

std::string join(const std::vector<InputFile>& files) {
  std::string text;
  for (const InputFile& file : files) text += (text.empty() ? "" : ", ") + file.path.string();
  return text;
}

Input read_file(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener,
                std::vector<NamedScan>& scans) {
  const Format* format = find_format(path);
  if (format != nullptr && format->read_scan != nullptr) {
    ScanFile file = format->read_scan(path, options, listener);
    listener.show(file.points, true, file.up);
    return add_scan(path, std::move(file), listener, scans);
  }
  if (format != nullptr && format->read_scene != nullptr) {
    Input scene = format->read_scene(path, options, listener);
    if (scene.objects.empty()) listener.note(path, "found no points");
    return scene;
  }
  return read_geometry(path, options, listener);
}

/// `notes`: what was said of the files, of which the first says what is damaged.
[[noreturn]] void refuse_no_points(const std::vector<InputFile>& files, const ScanCounts& counts,
                                   const std::vector<std::string>& notes) {
  std::string found = join(files) + ": " + no_points_found(counts);
  found += fate_of(counts).empty() ? " and no triangles" : "; expected at least one other";
  if (counts.withheld + counts.noise > 0) found += " (--keep-withheld keeps those withheld or of noise)";
  if (counts.missing > 0 && !notes.empty()) found += "; " + one_line(notes.front());
  throw Error(ExitCode::input_unreadable, found);
}

/// Gives all points that have times the track that they were measured from.
void add_track(Input& input, const ReadOptions& options) {
  const std::filesystem::path& path = options.scans.trajectory;
  const std::vector<TrackPlace> track = read_track(path, {input.notes, options.progress, 1.0, 1.0});
  bool used = false;
  for (InputObject& object : input.objects) {
    const Column* time = find_column(object.points.columns, COLUMN_TIME);
    for (std::size_t i = 0; time != nullptr && i < time->size() && object.points.track.empty(); ++i)
      if (time->number(i) >= track.front().time && time->number(i) <= track.back().time)
        object.points.track = track;
    used = used || !object.points.track.empty();
  }
  if (!used) throw_unreadable(path, "found no point that has a time of this trajectory, expected some");
}

bool has_attribute(const InputObject& object, const std::string& name) {
  return has_attribute(object.points.columns, name) ||
         std::any_of(object.meshes.begin(), object.meshes.end(),
                     [&](const Mesh& mesh) { return has_attribute(mesh.vertices.columns, name); });
}

/// Names those of the attributes asked for that no file has.
void note_missing_attributes(Input& input, const std::vector<std::string>& asked) {
  const std::string note = missing_attributes(asked, [&input](const std::string& name) {
    return std::any_of(input.objects.begin(), input.objects.end(),
                       [&](const InputObject& object) { return has_attribute(object, name); });
  });
  if (!note.empty()) input.notes.push_back(note);
}

}  // namespace

Material default_material(bool colored) {
  Material material{};
  material.phong.diffuse = colored ? glm::vec3(0.9F) : glm::vec3(0.64F, 0.61F, 0.57F);
  material.phong.specular = 0.05F;
  material.phong.tint = glm::vec3(1.0F);
  material.phong.shininess = 40.0F;
  material.ior = 1.5F;
  material.flags = MATERIAL_TWO_SIDED;
  follow_phong(material);
  return material;
}

void finish_objects(Input& input, const ReadOptions& options) {
  const ThreadLimit limit(options.threads);
  if (!options.scans.trajectory.empty()) add_track(input, options);
  for (InputObject& object : input.objects) adjust_points(object, options.scans);
  points_from_meshes(input, options);
}

Input read_input(const std::vector<std::filesystem::path>& named, const ReadOptions& options) {
  if (named.empty()) {
    throw Error(ExitCode::usage, "no input file was named");
  }
  const std::vector<InputFile> files = input_files(named);
  for (const InputFile& file : files) note_input(file.path);  // before the first is read
  const ThreadLimit limit(options.threads);
  Input input;
  std::vector<NamedScan> scans;
  std::vector<NamedCrs> systems;
  std::optional<Error> left_out;  // the first of a folder's files that are something else
  const auto share = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(files.size());
  };
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<std::string> notes;
    std::size_t seen = 0;
    const ReadListener listener{notes, options.progress, share(i), share(i + 1), &options.points, &seen};
    try {
      Input more = read_file(files[i].path, options, listener, scans);
      more.notes = std::move(notes);
      systems.push_back({files[i].path, more.crs});
      merge(input, std::move(more));
    } catch (const Error& error) {
      if (!files[i].may_be_left_out || error.code() != ExitCode::input_unreadable) throw;
      input.notes.push_back(std::string(error.what()) + "; it was left out");
      if (!left_out) left_out = error;
    }
  }
  if (left_out && scans.empty() && input.objects.empty()) throw Error(*left_out);
  require_one_system(scans);
  input.crs = one_crs(systems, input.notes);
  if (options.scans.z_scale != 1.0) input.crs = horizontal_crs(input.crs);
  if (!scans.empty())
    input.objects.push_back(join_scans(std::move(scans), input.notes, options.scans.attributes));
  note_missing_attributes(input, options.scans.attributes);
  finish_objects(input, options);
  drop_empty_objects(input);
  if (input.objects.empty()) {
    refuse_no_points(files, input.scan_counts, input.notes);
  }
  note_many_dielectrics(input);
  aim_camera(input);
  for (std::string& note : input.notes) note = one_line(note);
  return input;
}

}  // namespace splatray

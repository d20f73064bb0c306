#include "preprocess/mesh/mesh_points.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "preprocess/base/parallel.h"
#include "preprocess/base/point_arrays.h"
#include "preprocess/base/usable_position.h"
#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/mesh/mesh_orientation.h"
#include "preprocess/mesh/sample_mesh.h"
#include "preprocess/mesh/texture/texture_detail.h"

namespace splatray {
namespace {

/// A mesh, where its points go, and how many are sampled on it.
struct MeshPart {
  InputObject* object = nullptr;
  Mesh* mesh = nullptr;
  double area = 0.0;
  bool sampled = false;  ///< by area; otherwise at the vertices
  std::uint64_t samples = 0;
};

void drop_unusable_triangles(Mesh& mesh, const std::string& name, std::vector<std::string>& notes) {
  const auto usable = [&](glm::uint vertex) { return is_usable_position(mesh.vertices.position[vertex]); };
  const std::size_t dropped = std::erase_if(mesh.triangles, [&](const glm::uvec3& triangle) {
    return !usable(triangle.x) || !usable(triangle.y) || !usable(triangle.z);
  });
  if (dropped > 0) {
    notes.push_back(name + ": dropped " + std::to_string(dropped) +
                    " triangles with vertices that are not finite or beyond 1e100");
  }
}

/// Turns a closed mesh of a dielectric outwards, or with `turn` of any object; whether the mesh is closed and its normals are
/// known to point outwards.
bool orient_mesh(Mesh& mesh, const std::vector<glm::uint>& weld, const InputObject& object, bool turn,
                 std::vector<std::string>& notes) {
  const bool dielectric = turn || (object.material.flags & MATERIAL_DIELECTRIC) != 0;
  MeshOrientation found = measure_orientation(mesh, weld);
  if (dielectric && found.is_closed() && found.signed_volume < 0.0) {
    flip_mesh(mesh);
    found.signed_volume = -found.signed_volume;
    notes.push_back(object.name + ": wound inwards, turned outwards because it is a dielectric");
  }
  if (dielectric && found.is_closed() && found.agreeing_share < 0.5) {
    std::for_each(mesh.vertices.normal.begin(), mesh.vertices.normal.end(), [](glm::vec3& n) { n = -n; });
    found.agreeing_share = 1.0 - found.agreeing_share;
    notes.push_back(object.name +
                    ": given normals pointed inwards, turned outwards because it is a dielectric");
  }
  return found.is_closed() && found.signed_volume > 0.0 && found.agreeing_share >= 0.5;
}

/// Splits `total` over these parts by area, so that the sum is exact.
void share_samples(const std::vector<MeshPart*>& parts, std::uint64_t total) {
  double area = 0.0;
  for (const MeshPart* part : parts) {
    area += part->area;
  }
  double passed = 0.0;
  std::uint64_t given = 0;
  for (MeshPart* part : parts) {
    passed += part->area;
    const auto until =
        static_cast<std::uint64_t>(std::llround(static_cast<double>(total) * std::min(passed / area, 1.0)));
    part->samples = until - std::min(given, until);
    given = std::max(given, until);
  }
}

template <class Condition>
std::vector<MeshPart*> sampled_parts(std::vector<MeshPart>& parts, const Condition& condition) {
  std::vector<MeshPart*> chosen;
  for (MeshPart& part : parts) {
    if (part.sampled && condition(part)) {
      chosen.push_back(&part);
    }
  }
  return chosen;
}

/// Appends; of no points, all else that is known of `more` comes with them.
void append_objects_points(Points& to, Points&& more) {
  if (to.size() == 0)
    to = std::move(more);
  else
    append_points(to, std::move(more));
}

std::vector<MeshPart> list_parts(Input& input, const ReadOptions& options) {
  std::vector<MeshPart> parts;
  for (InputObject& object : input.objects) {
    for (Mesh& mesh : object.meshes) {
      drop_unusable_triangles(mesh, object.name, input.notes);
      MeshPart part{&object, &mesh};
      part.area = surface_area(mesh);
      part.sampled =
          part.area > 0.0 && std::isfinite(part.area) &&
          (options.samples > 0 || object.samples > 0 || is_coarse(mesh) || is_finer_than_vertices(mesh));
      parts.push_back(part);
    }
  }
  return parts;
}

/// Meshes without triangles are point sets.
void move_out_points(InputObject& object) {
  for (Mesh& mesh : object.meshes) {
    if (!mesh.triangles.empty()) continue;
    append_objects_points(object.points, std::move(mesh.vertices));
  }
  std::erase_if(object.meshes, [](const Mesh& mesh) { return mesh.triangles.empty(); });
}

/// Coarse meshes share AUTOMATIC_SAMPLES; none gets fewer points than it has vertices, nor too few for it to
/// be seen.
void sample_coarse_parts(const std::vector<MeshPart*>& coarse, std::vector<std::string>& notes) {
  constexpr std::uint64_t FEWEST = 500;
  if (coarse.empty()) {
    return;
  }
  share_samples(coarse, AUTOMATIC_SAMPLES);
  for (MeshPart* part : coarse) {
    part->samples = std::max({part->samples, FEWEST, std::uint64_t{part->mesh->vertices.size()}});
  }
  const std::string which = coarse.size() == 1
                                ? "a mesh is too coarse, or its texture too fine, for splats at "
                                  "its vertices and was"
                                : std::to_string(coarse.size()) +
                                      " meshes are too coarse, or their textures too fine, for "
                                      "splats at their vertices and were";
  notes.push_back(which + " sampled by area, about " + std::to_string(AUTOMATIC_SAMPLES) +
                  " points in all; --mesh-points asks for another number");
}

/// How many points each part gets: options.samples over all, else what the scene asks for object by object.
void choose_samples(std::vector<MeshPart>& parts, Input& input, const ReadOptions& options) {
  if (options.samples > 0) {
    share_samples(sampled_parts(parts, [](const MeshPart&) { return true; }), options.samples);
    return;
  }
  sample_coarse_parts(sampled_parts(parts, [](const MeshPart& part) { return part.object->samples == 0; }),
                      input.notes);
  for (const InputObject& object : input.objects) {
    if (object.samples > 0) {
      share_samples(sampled_parts(parts, [&](const MeshPart& part) { return part.object == &object; }),
                    object.samples);
    }
  }
}

/// Which vertices of each part lie where other parts have some too.
std::vector<std::vector<bool>> shared_vertices(const std::vector<MeshPart>& parts) {
  using Place = std::tuple<double, double, double, std::size_t, std::size_t>;
  std::vector<Place> places;
  std::vector<std::vector<bool>> shared(parts.size());
  if (parts.size() < 2) return shared;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto& position = parts[part].mesh->vertices.position;
    shared[part].resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i)
      if (is_usable_position(position[i]))
        places.emplace_back(position[i].x, position[i].y, position[i].z, part, i);
  }
  tbb::parallel_sort(places.begin(), places.end());
  const auto same_place = [](const Place& a, const Place& b) {
    return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b) &&
           std::get<2>(a) == std::get<2>(b);
  };
  for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
    while (end < places.size() && same_place(places[begin], places[end])) ++end;
    if (std::get<3>(places[begin]) == std::get<3>(places[end - 1])) continue;
    for (std::size_t i = begin; i < end; ++i) shared[std::get<3>(places[i])][std::get<4>(places[i])] = true;
  }
  return shared;
}

void points_from_part(const MeshPart& part, const std::vector<bool>& shared, const ReadOptions& options,
                      std::uint64_t seed, const Stage& stage, double share, std::vector<std::string>& notes) {
  stage.report(share);
  InputObject& object = *part.object;
  const std::vector<glm::uint> weld = weld_positions(part.mesh->vertices.position);
  stage.report(share);
  object.oriented = orient_mesh(*part.mesh, weld, object, options.turn_outwards, notes) && object.oriented;
  object.surface_area += part.area;
  stage.report(share);
  const MeshCreases creases{std::cos(glm::radians(options.crease_degrees)), options.clip,
                            shared.empty() ? nullptr : &shared};
  append_objects_points(object.points, part.sampled
                                           ? sample_surface(*part.mesh, weld, part.samples, seed, creases)
                                           : vertex_points(*part.mesh, weld, creases));
}

}  // namespace

void points_from_meshes(Input& input, const ReadOptions& options) {
  for (InputObject& object : input.objects) {
    move_out_points(object);
    object.oriented = object.points.size() == 0;
  }
  const Stage stage{"sampling", options.progress};
  stage.report(0.0);
  std::vector<MeshPart> parts = list_parts(input, options);
  choose_samples(parts, input, options);
  const std::vector<std::vector<bool>> shared = shared_vertices(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(parts.size());
    points_from_part(parts[i], shared[i], options, options.seed + i, stage, share, input.notes);
    if (!options.keep_meshes) {
      *parts[i].mesh = Mesh{};
    }
  }
  for (InputObject& object : input.objects) {
    if (!options.keep_meshes) {
      object.meshes.clear();
    }
  }
}

}  // namespace splatray

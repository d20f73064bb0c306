/// What readers deliver and preprocess works on: objects of points in world space, float64.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/scene.h"

namespace splatray {

struct Texture;

/// A point set. All arrays that are not empty have the same length.
struct Points {
  std::vector<glm::dvec3> position;  ///< world units
  std::vector<glm::vec3> normal;     ///< any length; empty = none given. A zero normal means "estimate me"
  std::vector<glm::vec3> color;      ///< linear rgb, 0..1; empty = none
  std::vector<float> radius;         ///< world units; empty = none given

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Triangles over points (attributes per vertex). Also the truth that pictures are measured against.
struct Mesh {
  Points vertices;                         ///< position, maybe normal and colour
  std::vector<glm::vec2> texcoord;         ///< beside vertices, or empty
  std::vector<glm::uvec3> triangles;       ///< indices < vertices.size()
  std::shared_ptr<const Texture> texture;  ///< base colour by texcoord, times the vertex colour; null = none
};

/// One object of the input: points, and what they are made of.
struct InputObject {
  std::string name;
  Points points;
  Material material{vec3(0.0F), 0.0F, vec3(0.0F), 1.0F, 0.0F, 1.0F, 0, 0};  ///< black
  bool oriented =
      false;  ///< normals are known to point outwards (closed mesh); else they may be turned either way
  double surface_area = 0.0;  ///< of the source mesh, world units^2; 0 = unknown
  std::uint64_t samples = 0;  ///< points the scene asks for on this object's meshes; 0 = it does not say
  std::vector<Mesh> meshes;   ///< source triangles in world space, kept only when ReadOptions::keep_meshes
};

/// Everything read from the input files.
struct Input {
  std::vector<InputObject> objects;
  std::vector<SceneLight> lights;
  std::optional<Camera> camera;
  std::optional<glm::dvec3> up;  ///< the format's own up axis (glTF: +y)
  std::string environment_path;  ///< resolved path of the environment map the scene names; empty = none
  std::vector<std::string>
      notes;  ///< one sentence each: unknown properties, skipped parts, ignored extensions
};

struct ReadOptions {
  std::uint64_t samples =
      0;  ///< points to sample on all meshes together, by area; 0 = one point per used vertex
  std::uint64_t seed = 1;
  std::vector<std::filesystem::path>
      data_paths;  ///< folders searched for models a scene names, after the scene's own folder
  bool keep_meshes = false;
  bool turn_outwards = false;  ///< closed meshes of all objects, not only of dielectrics, are turned outwards
  unsigned threads = 0;        ///< 0 = all cores
  Progress progress{};         ///< of the stages "reading" and "sampling"; may be empty
};

/// Reads one or more files into one Input (several files: one object each; glTF: its own objects), by their
/// extensions (read/formats.h). Throws Error (input_unreadable), one sentence with path, found and expected, or
/// (interrupted) when `options.progress` says so.
[[nodiscard]] Input read_input(const std::vector<std::filesystem::path>& paths, const ReadOptions& options);

/// The material of an object whose file says nothing: light grey, a soft highlight, two-sided.
[[nodiscard]] Material default_material();

}  // namespace splatray

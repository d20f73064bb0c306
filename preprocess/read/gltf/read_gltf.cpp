#include "preprocess/read/gltf/read_gltf.h"

#include <algorithm>
#include <map>

#include "preprocess/mesh/mesh_transform.h"
#include "preprocess/read/find_file.h"
#include "preprocess/read/gltf/gltf_file.h"
#include "preprocess/read/gltf/gltf_material.h"
#include "preprocess/read/gltf/gltf_primitive.h"
#include "preprocess/read/gltf/gltf_view.h"
#include "preprocess/read/read_mesh.h"

namespace splatray {
namespace {

/// Walks the scene's nodes and collects what they carry.
class SceneReader {
 public:
  SceneReader(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener)
      : options_(options),
        listener_(listener),
        file_(load_gltf(path, listener.part(0.0, FILE_SHARE))),
        materials_(file_, listener.notes) {}

  Input read() {
    input_.up = glm::dvec3(0.0, 1.0, 0.0);
    visited_.assign(file_.model.nodes.size(), false);
    read_scene_extras();
    std::vector<Visit> stack;
    for (const int root : root_nodes()) {
      push(stack, root, glm::dmat4(1.0));
      while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const ReadListener part = node_part();
        part.report(0.0);
        const tinygltf::Node& node = file_.model.nodes[visit.node];
        read_node(node, visit.to_world, part);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
          push(stack, *child, visit.to_world);
        }
      }
    }
    note_cameras();
    return std::move(input_);
  }

 private:
  static constexpr double FILE_SHARE = 0.2;  ///< of the work that the file itself is; its nodes are the rest

  /// The next node's share of reading.
  ReadListener node_part() {
    const double step = (1.0 - FILE_SHARE) / static_cast<double>(file_.model.nodes.size());
    const double from = FILE_SHARE + step * static_cast<double>(nodes_done_++);
    return listener_.part(from, from + step);
  }

  struct Visit {
    std::size_t node;
    glm::dmat4 to_world;
  };

  void push(std::vector<Visit>& stack, int node, const glm::dmat4& parent_to_world) {
    const std::size_t index = file_.checked(node, file_.model.nodes.size(), "node");
    if (visited_[index]) {
      file_.fail("node " + std::to_string(index) + " has more than one parent");
    }
    visited_[index] = true;
    stack.push_back({index, parent_to_world * node_transform(file_, file_.model.nodes[index])});
  }

  const tinygltf::Scene* scene() const {
    if (file_.model.scenes.empty()) {
      return nullptr;
    }
    const int index = std::max(file_.model.defaultScene, 0);
    return &file_.model.scenes[file_.checked(index, file_.model.scenes.size(), "scene")];
  }

  /// The scene's roots; without a scene every node that is no child.
  std::vector<int> root_nodes() const {
    if (scene() != nullptr) {
      return scene()->nodes;
    }
    std::vector<bool> is_child(file_.model.nodes.size(), false);
    for (const tinygltf::Node& node : file_.model.nodes) {
      for (const int child : node.children) {
        is_child[file_.checked(child, is_child.size(), "node")] = true;
      }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) {
        roots.push_back(static_cast<int>(i));
      }
    }
    return roots;
  }

  void read_scene_extras() {
    if (scene() == nullptr) {
      return;
    }
    scene_hint_ = text_in(scene()->extras, "hint");
    const std::string environment = text_in(scene()->extras, "environment");
    if (!environment.empty()) {
      const FileReference reference{environment, "the scene's environment", scene_hint_, file_.path};
      input_.environment_path = find_scene_file(reference, options_.data_paths).string();
    }
  }

  void read_node(const tinygltf::Node& node, const glm::dmat4& to_world, const ReadListener& part) {
    if (const auto light = read_light(file_, node, to_world)) {
      if (input_.lights.size() == LIGHTS_MOST)
        file_.fail("found more than " + std::to_string(LIGHTS_MOST) + " lights, expected at most as many");
      input_.lights.push_back(*light);
    }
    if (const auto camera = read_camera(file_, node, to_world)) {
      ++camera_count_;
      if (!input_.camera) {
        input_.camera = camera;
      }
    }
    if (!text_in(node.extras, "points").empty()) {
      read_points_file(node, to_world, part);
    } else if (node.mesh >= 0) {
      read_mesh_node(node, to_world, part);
    }
  }

  const tinygltf::Mesh& mesh_of(const tinygltf::Node& node) const {
    return file_.model.meshes[file_.checked(node.mesh, file_.model.meshes.size(), "mesh")];
  }

  std::string name_of(const tinygltf::Node& node) const {
    if (!node.name.empty()) {
      return node.name;
    }
    const std::string mesh = node.mesh >= 0 ? mesh_of(node).name : "";
    return mesh.empty() ? "object " + std::to_string(input_.objects.size()) : mesh;
  }

  void read_mesh_node(const tinygltf::Node& node, const glm::dmat4& to_world, const ReadListener& part) {
    std::map<int, std::vector<Mesh>> by_material;
    for (const tinygltf::Primitive& primitive : mesh_of(node).primitives) {
      part.report(0.0);
      if (auto mesh = read_primitive(file_, primitive, materials_, listener_.notes)) {
        transform_mesh(*mesh, to_world);
        by_material[primitive.material].push_back(std::move(*mesh));
      }
    }
    for (auto& [material, meshes] : by_material) {
      InputObject object;
      object.name = name_of(node);
      if (by_material.size() > 1 && material >= 0) {
        object.name += "/" + file_.model.materials[static_cast<std::size_t>(material)].name;
      }
      const bool colored = make_colors_complete(meshes, material);
      object.material = materials_.material(material, colored, sampled_maps(meshes, material));
      object.meshes = std::move(meshes);
      object.samples = by_material.size() == 1 ? requested_samples(node) : 0;
      input_.objects.push_back(std::move(object));
    }
  }

  /// extras.samples of a node; 0 = none.
  static std::uint64_t requested_samples(const tinygltf::Node& node) {
    return static_cast<std::uint64_t>(std::clamp(number_in(node.extras, "samples").value_or(0.0), 0.0, 1e9));
  }

  /// Whether the object brings colours; then meshes without any get the material's.
  bool make_colors_complete(std::vector<Mesh>& meshes, int material) const {
    const auto has_color = [](const Mesh& mesh) { return mesh.texture || !mesh.vertices.color.empty(); };
    const bool colored = std::any_of(meshes.begin(), meshes.end(), has_color);
    for (Mesh& mesh : meshes) {
      if (colored && !has_color(mesh)) {
        mesh.vertices.color.assign(mesh.vertices.size(), materials_.base_color(material));
      }
    }
    return colored;
  }

  /// Which of a material's textures of factors some mesh has coordinates for.
  std::vector<bool> sampled_maps(const std::vector<Mesh>& meshes, int material) {
    std::vector<bool> sampled;
    for (const GltfMaterials::Map& known : materials_.maps(material))
      sampled.push_back(std::any_of(meshes.begin(), meshes.end(), [&](const Mesh& mesh) {
        return std::any_of(mesh.maps.begin(), mesh.maps.end(),
                           [&](const SurfaceMap& map) { return map.texture == known.map.texture; });
      }));
    return sampled;
  }

  void read_points_file(const tinygltf::Node& node, const glm::dmat4& to_world, const ReadListener& part) {
    const std::string source = text_in(node.extras, "source");
    const FileReference reference{text_in(node.extras, "points"), "points of node '" + name_of(node) + "'",
                                  source.empty() ? scene_hint_ : source, file_.path};
    Mesh mesh = read_mesh(find_scene_file(reference, options_.data_paths), options_, part);
    transform_mesh(mesh, to_world);
    int material = -1;
    if (const auto chosen = number_in(node.extras, "material")) {
      material = static_cast<int>(std::clamp(*chosen, 0.0, 1e9));
    } else if (node.mesh >= 0 && !mesh_of(node).primitives.empty()) {
      material = mesh_of(node).primitives.front().material;
    }
    const glm::vec3 base = materials_.base_color(material);
    for (glm::vec3& color : mesh.vertices.color) {
      color *= base;
    }
    InputObject object;
    object.name = name_of(node);
    object.material = materials_.material(material, !mesh.vertices.color.empty());
    object.meshes.push_back(std::move(mesh));
    object.samples = requested_samples(node);
    input_.objects.push_back(std::move(object));
  }

  void note_cameras() {
    if (camera_count_ > 1) {
      listener_.notes.push_back(file_.path.string() + ": the first of " + std::to_string(camera_count_) +
                                " cameras is used");
    }
  }

  const ReadOptions& options_;
  const ReadListener& listener_;
  Input input_;
  GltfFile file_;
  GltfMaterials materials_;
  std::vector<bool> visited_;
  std::string scene_hint_;
  std::size_t camera_count_ = 0;
  std::size_t nodes_done_ = 0;
};

}  // namespace

Input read_gltf(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener) {
  return SceneReader(path, options, listener).read();
}

}  // namespace splatray

/// A scene on the device, and the materials, lights and environment it is seen with.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/device/device.h"
#include "engine/gpu/features.h"
#include "engine/gpu/pools.h"
#include "engine/image/look.h"
#include "engine/image/view.h"
#include "engine/light/light_tree.h"
#include "engine/scene/clip.h"
#include "engine/scene/sky/sky_table.h"
#include "engine/scene/tree.h"

namespace splatray {

/// Called once all is known of a scene that programs depend on, before its pools are uploaded.
using Planned = std::function<void()>;

/// An array that lies where a scene has it.
struct WalkedArray {
  std::uint32_t binding;  ///< BIND_DATA_POOL of the wide tree's nodes, too, which come first
  std::span<const std::byte> bytes;
};

class DeviceScene {
 public:
  /// Nothing yet, black all around. The device and the queue must outlive it.
  DeviceScene(const Device& device, Queue& queue, const PoolRequest& request);

  /// As the tracer's functions of these names.
  void upload(const Scene& scene, const Planned& planned = {}) { upload(scene, nullptr, planned); }
  void upload_and_free(Scene& scene, const Planned& planned = {}) { upload(scene, &scene, planned); }
  /// Uploads the parts of the look that changed; the scene's pools are there. Throws Error (failed) for a look of other objects, or
  /// with too many lights.
  void show(const Look& look);

  /// Whether there is a scene, or one is being uploaded.
  [[nodiscard]] bool uploaded() const { return bindings_ != nullptr; }
  /// Throws Error (input_unreadable) where the scene lies in a file that has changed since: what was traced is worth nothing.
  void require_whole() const;
  /// Bindings of the uploaded scene; its own are set by bind().
  [[nodiscard]] Bindings& bindings() { return *bindings_; }
  void bind();
  /// Says that so many rays of a camera are about to be traced. Where the host walks the scene, copies what they wait for into huge
  /// pages, once that is worth it (worth_huge_pages).
  void expect_rays(std::uint64_t rays);

  [[nodiscard]] PoolBytes bytes() const;
  /// What the features of a pipeline depend on.
  [[nodiscard]] SceneContent content() const;
  /// Parameters of a picture, and of ray queries.
  [[nodiscard]] FrameParams picture_params(const View& view, const Settings& settings) const;
  [[nodiscard]] FrameParams query_params(const Settings& settings) const;

 private:
  /// `spent`: as upload_pools has it.
  void upload(const Scene& scene, Scene* spent, const Planned& planned);
  void plan(const Scene& scene, const PoolRequest& request);
  void list_walked(const Scene& scene);
  void copy_walked();
  void upload_tables(const SkyTable& sky);
  void show_materials(const std::vector<Material>& materials);
  void show_lights(const Look& look);
  void upload_tree(const Emitters& emitters);
  void show_environment(const Environment& environment);
  void set_sky(const Settings& settings, FrameParams& frame) const;

  const Device& device_;
  Queue& queue_;
  const PoolRequest request_;
  std::unique_ptr<Bindings> bindings_;  ///< of the pools

  Scene outline_;  ///< the scene without its arrays: transform, bounds, up, mapping
  std::size_t object_count_ = 0;
  PoolPlan plan_;
  PoolBuffers pools_;
  std::unique_ptr<Buffer> wide_nodes_;  ///< null where programs walk the octree
  /// What rays on the host wait for and was not copied: the wide tree, then pools beside the splats.
  std::vector<WalkedArray> walked_;
  std::uint64_t walked_bytes_ = 0, rays_ = 0;  ///< of all those; expected since the upload
  ClipContent clip_content_;
  bool leans_ = false;       ///< any_leans
  Look shown_;               ///< as uploaded
  bool shows_look_ = false;  ///< else the pools are another scene's
  MaterialContent material_content_;
  std::unique_ptr<Buffer> material_buffer_, light_buffer_, table_buffer_, tree_buffer_;
  std::uint32_t lights_ = 0;
  std::uint32_t lights_sized_ = 0, lights_met_ = 0;
  LightTree tree_;  ///< without its arrays
  std::uint32_t tree_nodes_ = 0;
  std::vector<bool> two_sided_;    ///< of each object, whether its light leaves both faces
  double light_irradiance_ = 0.0;  ///< at the scene's centre, facing all, the mean of rgb
  std::unique_ptr<DeviceTexture> environment_;
  bool environment_texture_ = false;
  glm::vec3 environment_constant_{0.0F};
  SkyTable sky_;  ///< without its words
  std::array<glm::vec3, 9> irradiance_{};
};

}  // namespace splatray

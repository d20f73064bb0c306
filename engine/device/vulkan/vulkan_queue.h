/// Memory of a Vulkan device, and the compute programs that run on it.
#pragma once
#include "engine/device/queue.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/pipeline.h"

namespace splatray {

class VulkanQueue final : public Queue {
 public:
  /// The device must outlive it.
  VulkanQueue(const VulkanDevice& vulkan, const QueueOptions& options);

  [[nodiscard]] bool fuses() const override { return fuses_; }
  [[nodiscard]] std::unique_ptr<Buffer> make_buffer(std::uint64_t bytes) override;
  [[nodiscard]] std::unique_ptr<DeviceTexture> make_texture(const Environment& environment) override;
  [[nodiscard]] std::unique_ptr<Bindings> make_bindings(const Paging& paging) override;
  void upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin) override;
  void download(const Buffer& buffer, std::span<std::byte> bytes) override;
  Ran run(const Dispatch& dispatch, const Bindings& bindings) override;
  void begin(const Dispatch& dispatch, const Bindings& bindings) override;
  Ran end() override { return {commands_.end(), {}}; }
  void finish() override { commands_.finish(); }
  void prepare(const Dispatch& dispatch, const Bindings& bindings) override;
  [[nodiscard]] std::uint32_t programs_built() const override { return pipelines_.built(); }

 private:
  void record(const Dispatch& dispatch, const VulkanBindings& bound, VkCommandBuffer commands);

  const VulkanDevice& vulkan_;
  PipelineCache pipelines_;
  VulkanBuffer frame_, counters_;
  CommandQueue commands_;  ///< behind what its work uses
  const bool fuses_;
};

}  // namespace splatray

#include "engine/device/vulkan/device_filter.h"

#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/device/program.h"
#include "engine/device/vulkan/pipeline.h"
#include "shaders/spirv.h"

namespace splatray {
namespace {

constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

void reserve(const VulkanDevice& vulkan, VulkanBuffer& buffer, VkDeviceSize bytes) {
  if (buffer.get() == VK_NULL_HANDLE || buffer.size() < bytes) buffer = VulkanBuffer(vulkan, bytes, STORAGE);
}

DenoiseParams params_of(const NoisyPicture& picture) {
  DenoiseParams params{};
  params.width = picture.width;
  params.height = picture.height;
  params.weight = picture.weight;
  return params;
}

}  // namespace

DeviceFilter::DeviceFilter(const VulkanDevice& vulkan)
    : vulkan_(vulkan),
      set_(vulkan, std::array<DescriptorSet::Binding, DENOISE_BINDINGS>{}),
      params_(vulkan, sizeof(DenoiseParams), STORAGE),
      queue_(vulkan) {
  for (std::uint32_t step = 0; step < programs_.size(); ++step) {
    PipelineKey constants;
    constants.constants[DENOISE_SPEC_STEP] = step;
    programs_[step] = make_pipeline(vulkan, constants, DENOISE, set_.layout()->get(), VK_NULL_HANDLE);
  }
  set_.write(DENOISE_BIND_PARAMS, params_.get());
}

void DeviceFilter::wait() {
  if (is_begun_) queue_.end();
  is_begun_ = false;
}

void DeviceFilter::take(const NoisyPicture& picture) {
  wait();
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  const std::uint64_t bytes = DENOISE_PLANES * pixels * sizeof(vec4);
  if (bytes > vulkan_.limits().storage_bytes)
    throw Error(ExitCode::out_of_memory, "filtering a picture takes a buffer of " + bytes_text(bytes) +
                                             ", the device has at most " +
                                             bytes_text(vulkan_.limits().storage_bytes));
  reserve(vulkan_, part_, pixels * sizeof(vec4));
  reserve(vulkan_, planes_, bytes);
  reserve(vulkan_, words_, DENOISE_WORDS * pixels * sizeof(std::uint32_t));
  reserve(vulkan_, result_, pixels * sizeof(vec4));
  set_.write(DENOISE_BIND_MEANS, picture.means->get());
  set_.write(DENOISE_BIND_BEFORE, picture.before->get());
  set_.write(DENOISE_BIND_PART, part_.get());
  set_.write(DENOISE_BIND_PLANES, planes_.get());
  set_.write(DENOISE_BIND_WORDS, words_.get());
  set_.write(DENOISE_BIND_RESULT, result_.get());
}

void DeviceFilter::keep(const NoisyPicture& part) {
  take(part);
  set_.write(DENOISE_BIND_BASE, part_.get());  // not read
  set_.write(DENOISE_BIND_AOV, part_.get());
  queue_.begin([&](VkCommandBuffer commands) {
    record_bound(commands);
    record_step(DENOISE_KEEP, part.width * part.height, params_of(part), commands);
  });
  is_begun_ = true;
}

const VulkanBuffer& DeviceFilter::run(const NoisyPicture& picture, float part_share, const Buffer& base,
                                      const Buffer& aov) {
  take(picture);
  set_.write(DENOISE_BIND_BASE, static_cast<const VulkanBuffer&>(base).get());
  set_.write(DENOISE_BIND_AOV, static_cast<const VulkanBuffer&>(aov).get());
  DenoiseParams params = params_of(picture);
  params.share = part_share;
  queue_.begin([&](VkCommandBuffer commands) { record(params, commands); });
  is_begun_ = true;
  return result_;
}

void DeviceFilter::record_bound(VkCommandBuffer commands) const {
  const VkDescriptorSet set = set_.get();
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, set_.layout()->get(), 0, 1, &set, 0,
                          nullptr);
}

void DeviceFilter::record(DenoiseParams params, VkCommandBuffer commands) const {
  const std::uint32_t pixels = params.width * params.height;
  record_bound(commands);
  params.light = DENOISE_PLANE_LIGHT + 3;
  params.filtered = DENOISE_PLANE_LIGHT;
  record_step(DENOISE_FINITE, pixels, params, commands);
  record_step(DENOISE_PIECES, groups(params.width, DENOISE_PIECE) * params.height, params, commands);
  record_step(DENOISE_TAKE, pixels, params, commands);
  record_step(DENOISE_VARIANCE, pixels, params, commands);
  for (std::uint32_t pass = 0; pass < DENOISE_PASSES; ++pass) {
    params.stride = 1U << pass;
    record_step(DENOISE_GUIDE, pixels, params, commands);
    record_step(DENOISE_PASS, pixels, params, commands);
    std::swap(params.light, params.filtered);
  }
  record_step(DENOISE_JOIN, pixels, params, commands);
  record_step(DENOISE_RIMS, pixels, params, commands);
}

void DeviceFilter::record_step(std::uint32_t step, std::uint32_t threads, const DenoiseParams& params,
                               VkCommandBuffer commands) const {
  Dispatch dispatch;
  dispatch.set_groups(groups(threads, GROUP_SIZE));
  record_barrier(commands);
  vkCmdUpdateBuffer(commands, params_.get(), 0, sizeof(params), &params);
  record_barrier(commands);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, programs_[step].get());
  vkCmdDispatch(commands, dispatch.groups_x, dispatch.groups_y, 1);
}

}  // namespace splatray

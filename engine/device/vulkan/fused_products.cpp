#include "engine/device/vulkan/fused_products.h"

#include <cmath>
#include <cstring>
#include <span>

#include "engine/device/vulkan/pipeline.h"
#include "engine/device/vulkan/texture.h"
#include "shaders/spirv.h"

namespace splatray {

ExactProducts exact_products() {
  ExactProducts products{};
  int i = 0;
  for (ExactProduct& product : products) {
    // Odd integers of 24 bits, of which no product has 24, times powers of two from 2^-30 to 2^30.
    const auto odd = [i](int step) { return static_cast<float>(((i + 1) * step) % (1 << 23) | 1 << 23 | 1); };
    product.a = std::ldexp(odd(1234567), 7 * i % 61 - 30 - 23);
    product.b = (i % 2 == 0 ? 1.0F : -1.0F) * std::ldexp(odd(7654321), -(5 * i % 61 - 30) - 23);
    const double exact = double(product.a) * double(product.b);
    product.high = static_cast<float>(exact);
    product.low = static_cast<float>(exact - double(product.high));
    ++i;
  }
  return products;
}

bool finds_remainders(const VulkanDevice& vulkan, CommandQueue& commands, const ExactProducts& products) {
  static_assert(sizeof(ExactProduct) == sizeof(vec4));
  FrameParams frame{};
  std::memcpy(frame.region, products.data(), sizeof(products));
  Paging paging;
  paging.pages.fill(1);
  VulkanBindings bindings(vulkan, commands, paging);
  const VulkanBuffer unused(vulkan, sizeof(uvec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  for (std::uint32_t binding = 0; binding < BINDINGS; ++binding)
    if (binding != BIND_ENVIRONMENT) bindings.bind(binding, unused, 0);
  const EnvironmentTexture no_environment(vulkan, commands, {1, 1, {glm::vec3(0.0F)}, glm::vec3(0.0F)});
  bindings.bind(no_environment);
  VulkanBuffer frame_buffer(vulkan, sizeof(FrameParams), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  VulkanBuffer counters(vulkan, COUNTER_COUNT * sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  bindings.bind(BIND_FRAME, frame_buffer, 0);
  bindings.bind(BIND_COUNTERS, counters, 0);
  const auto pipeline = make_pipeline(vulkan, {}, FUSED, bindings.layout()->get(), VK_NULL_HANDLE);
  std::array<std::uint32_t, COUNTER_COUNT> counted{};
  commands.upload(frame_buffer, std::as_bytes(std::span(&frame, 1)));
  commands.upload(counters, std::as_bytes(std::span(counted)));
  commands.run([&](VkCommandBuffer recorded) {
    const VkDescriptorSet set = bindings.set();
    vkCmdBindPipeline(recorded, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    vkCmdBindDescriptorSets(recorded, VK_PIPELINE_BIND_POINT_COMPUTE, bindings.layout()->get(), 0, 1, &set, 0,
                            nullptr);
    vkCmdDispatch(recorded, 1, 1, 1);
  });
  commands.download(counters, std::as_writable_bytes(std::span(counted)));
  return counted[COUNT_LOST] == 0;
}

}  // namespace splatray

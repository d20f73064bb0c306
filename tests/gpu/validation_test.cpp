#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// Asks the loader itself, so that a device that fails for another reason is no reason to skip.
bool layer_is_installed() {
  std::uint32_t count = 0;
  if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return true;
  std::vector<VkLayerProperties> layers(count);
  if (vkEnumerateInstanceLayerProperties(&count, layers.data()) != VK_SUCCESS) return true;
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::string(layer.layerName) == "VK_LAYER_KHRONOS_validation";
  });
}

class Validation : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!layer_is_installed()) GTEST_SKIP() << "the validation layer is not installed";
  }
};

TEST_F(Validation, MistakesAreCountedAndPrinted) {
  const auto device = std::make_unique<VulkanDevice>("", true);
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  ::testing::internal::CaptureStderr();
  vkCreateBuffer(device->device, &info, nullptr, &buffer);
  EXPECT_NE(::testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(device->validation_messages(), 0U);
  vkDestroyBuffer(device->device, buffer, nullptr);
}

TEST_F(Validation, NothingIsSaidOfAWholeLifeAndNothingIsLeftBehind) {
  ::testing::internal::CaptureStderr();
  {
    const auto device = std::make_unique<VulkanDevice>("", true);
    ShownTracer tracer(*device);
    tracer.upload(disc_scene());
    tracer.set_environment({2, 1, std::vector<glm::vec3>(2, glm::vec3(0.5F)), {}});
    Settings settings = plain_settings();
    settings.aov = true;
    settings.counters = true;
    (void)tracer.render(disc_view(20, 10), settings);
    const std::vector<RayQuery> rays(5);
    (void)tracer.intersect(rays, settings);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace splatray

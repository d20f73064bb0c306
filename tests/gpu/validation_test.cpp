#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "engine/base/error.h"
#include "engine/gpu/tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// A context with validation, or null where the layer is not installed.
std::unique_ptr<Context> validated_context() {
  try {
    return std::make_unique<Context>("", true);
  } catch (const Error& error) {
    if (error.code() == ExitCode::no_device) throw;
    return nullptr;
  }
}

TEST(Validation, MistakesAreCountedAndPrinted) {
  const std::unique_ptr<Context> context = validated_context();
  if (!context) GTEST_SKIP() << "the validation layer is not installed";
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  testing::internal::CaptureStderr();
  vkCreateBuffer(context->device, &info, nullptr, &buffer);
  EXPECT_NE(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(context->validation_messages(), 0U);
  vkDestroyBuffer(context->device, buffer, nullptr);
}

TEST(Validation, NothingIsSaidOfAWholeLifeAndNothingIsLeftBehind) {
  testing::internal::CaptureStderr();
  {
    const std::unique_ptr<Context> context = validated_context();
    if (!context) GTEST_SKIP() << "the validation layer is not installed";
    Tracer tracer(*context);
    tracer.upload(disc_scene());
    tracer.set_environment({2, 1, std::vector<glm::vec3>(2, glm::vec3(0.5F)), {}});
    Settings settings = plain_settings();
    settings.aov = true;
    settings.counters = true;
    (void)tracer.render(disc_view(20, 10), settings);
    const std::vector<RayQuery> rays(5);
    (void)tracer.intersect(rays, settings);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace splatray

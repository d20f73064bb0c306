/// The scene of the engine's tests, small enough to know every pixel of: one disc in one leaf, or a few.
#pragma once
#include <gtest/gtest.h>

#include "engine/device/vulkan/vulkan_device.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray {

/// World length of the root's edge; the root is centred on the world's origin.
inline constexpr double ROOT_EDGE_WORLD = 2.0;
/// World radius of the discs.
inline constexpr double DISC_RADIUS_WORLD = 0.5;

/// `objects` equal discs facing +z, object i in the plane z = -0.2 i, all in one leaf. White, one-sided,
/// matte; one light from +z.
[[nodiscard]] Scene disc_scene(std::uint32_t objects = 1);

/// Looks at the discs from +z, orthographic, 2 world units high.
[[nodiscard]] View disc_view(std::uint32_t width, std::uint32_t height);

/// One sample without shadows.
[[nodiscard]] Settings plain_settings();

/// Whether the centre of a pixel of disc_view sees the disc; nothing is said of pixels whose centre is at the
/// rim.
enum class Coverage { inside, outside, rim };
[[nodiscard]] Coverage disc_coverage(const View& view, std::uint32_t x, std::uint32_t y);

/// A test with a device of its own, which must end without validation messages.
class DeviceTest : public ::testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(device.validation_messages(), 0U); }

  VulkanDevice device;
};

}  // namespace splatray

// Whether fma() rounds once is asked of the device: programs compiled for one that does not find other hits.
#include <gtest/gtest.h>

#include "engine/device/vulkan/fused_products.h"
#include "engine/device/vulkan/vulkan_queue.h"

namespace splatray {
namespace {

TEST(FusedProducts, AreExactAndLeaveSomethingOut) {
  for (const ExactProduct& product : exact_products()) {
    EXPECT_EQ(double(product.a) * double(product.b), double(product.high) + double(product.low));
    EXPECT_EQ(product.a * product.b, product.high);
    EXPECT_NE(product.low, 0.0F);
  }
}

TEST(FusedProducts, AreFoundOrNotByWhatTheDeviceMakesOfThem) {
  const VulkanDevice device;
  CommandQueue commands(device);
  ExactProducts products;
  products.fill({3.0F, 5.0F, 15.0F, 0.0F});
  EXPECT_TRUE(finds_remainders(device, commands, products)) << "which leave out nothing on any device";
  products.back().low = 0x1p-40F;
  EXPECT_FALSE(finds_remainders(device, commands, products)) << "one of them is wrong";
}

TEST(FusedProducts, AreUsedWhereTheDeviceFindsThem) {
  const VulkanDevice device;
  CommandQueue commands(device);
  const bool finds = finds_remainders(device, commands, exact_products());
  EXPECT_EQ(device.make_queue()->fuses(), finds);
}

}  // namespace
}  // namespace splatray

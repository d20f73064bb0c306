/// Whether a device's fma() rounds once, as IEEE 754 asks for and Vulkan does not: then it finds what a product leaves out
/// (shaders/lang/double_float.glsl).
#pragma once
#include <array>

#include "engine/device/vulkan/command_queue.h"

namespace splatray {

/// A product of two float32, a b = high + low exactly.
struct ExactProduct {
  float a, b, high, low;
};
using ExactProducts = std::array<ExactProduct, FUSED_ROWS>;

/// Products of all signs and sizes that a ray's arithmetic has, whose lows are not 0: where fma() rounds twice, it finds 0.
[[nodiscard]] ExactProducts exact_products();

/// Whether the device's fma() finds the lows of products. Throws Error as check() does.
[[nodiscard]] bool finds_remainders(const VulkanDevice& vulkan, CommandQueue& commands,
                                    const ExactProducts& products);

}  // namespace splatray

/// The size of a picture, by its header alone.
#pragma once
#include <cstdint>
#include <optional>
#include <span>

namespace splatray {

/// Width times height of a PNG or JPEG, glTF's two formats; empty for anything else or a header that ends early.
[[nodiscard]] std::optional<std::uint64_t> image_pixels(std::span<const unsigned char> bytes);

}  // namespace splatray

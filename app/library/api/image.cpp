#include <cstring>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/codec/picture_format.h"
#include "app/library/image_file.h"
#include "engine/base/memory.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"
#include "preprocess/base/file_extension.h"

namespace splatray::api {
namespace {

splatray::Display inner_display(const Image& image) {
  for (std::size_t i = 0; i < TONE_NAMES.size(); ++i)
    if (image.tone == TONE_NAMES[i]) return {image.exposure, static_cast<splatray::Tone>(i)};
  refuse("tone '" + image.tone + "'", "neutral, agx, soft or none");
}

void check(const Image& image) {
  constexpr double MOST_STOPS = 60.0;
  const std::size_t pixels = std::size_t{image.width} * image.height;
  const auto is_none_or_all = [pixels](std::size_t size) { return size == 0 || size == pixels; };
  if (pixels == 0 || image.pixels.size() != pixels || !is_none_or_all(image.depth.size()) ||
      image.normal.size() != image.depth.size() || image.object.size() != image.depth.size() ||
      !is_none_or_all(image.error.size()) || !is_none_or_all(image.albedo.size()))
    refuse("a picture whose arrays do not fit its size of " + std::to_string(image.width) + " x " +
               std::to_string(image.height),
           "as many elements as pixels");
  if (!(image.exposure >= -MOST_STOPS && image.exposure <= MOST_STOPS))
    refuse("an exposure of " + std::to_string(image.exposure) + " stops", "-60 to 60");
}

/// Throws splatray::Error (out_of_memory) where there is not so much memory a pixel for writing the picture.
void require_pixel_memory(const Image& image, std::uint64_t bytes) {
  const std::uint64_t copy = sizeof(vec4) + (image.depth.empty() ? 0 : sizeof(AovPixel));
  require_memory(image.pixels.size() * (copy + bytes), "writing a picture of " + std::to_string(image.width) +
                                                           "x" + std::to_string(image.height) + " pixels");
}

splatray::Image inner_image(const Image& image) {
  splatray::Image inner{image.width, image.height, {}, {}, image.error};
  inner.rgba.resize(image.pixels.size());
  std::memcpy(inner.rgba.data(), image.pixels.data(), image.pixels.size() * sizeof(vec4));
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    AovPixel& pixel = inner.aov.emplace_back();
    pixel.z = image.depth[i];
    pixel.normal = vector(image.normal[i]);
    pixel.object = image.object[i] < 0 ? NO_OBJECT : static_cast<std::uint32_t>(image.object[i]);
  }
  for (const Float3& albedo : image.albedo) inner.albedo.emplace_back(vector(albedo), 1.0F);
  return inner;
}

}  // namespace

void Image::save(const std::filesystem::path& file) const {
  guarded([&] {
    check(*this);
    require_no_input(file);
    const bool shown = is_display_format(file), channels = !depth.empty();
    if (!is_picture_format(file))
      refuse("output '" + file.string() + "'", std::string("a name ending in ") + PICTURE_NAMES);
    require_pixel_memory(*this, shown ? DISPLAY_WRITING_BYTES : exr_writing_bytes(channels ? 13 : 8));
    const splatray::Image inner = inner_image(*this);
    if (shown) {
      const auto bytes = encode_display(display_image(inner, inner_display(*this)), {}, file);
      return write_file(bytes.data(), bytes.size(), file);
    }
    write_exr(inner, aovs_of(inner), {}, file);
  });
}

std::vector<unsigned char> Image::png() const {
  return guarded([&] {
    check(*this);
    require_pixel_memory(*this, DISPLAY_WRITING_BYTES);
    return encode_png(display_image(inner_image(*this), inner_display(*this)), {});
  });
}

}  // namespace splatray::api

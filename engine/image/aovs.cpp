#include "engine/image/aovs.h"

namespace splatray {
namespace {

void put_depth(const Image& image, std::size_t pixel, std::vector<float>& values) {
  values.push_back(image.aov[pixel].z);
}

void put_normal(const Image& image, std::size_t pixel, std::vector<float>& values) {
  const vec3& normal = image.aov[pixel].normal;
  values.insert(values.end(), {normal.x, normal.y, normal.z});
}

void put_object(const Image& image, std::size_t pixel, std::vector<float>& values) {
  const std::uint32_t object = image.aov[pixel].object;
  values.push_back(object == NO_OBJECT ? -1.0F : static_cast<float>(object));
}

void put_error(const Image& image, std::size_t pixel, std::vector<float>& values) {
  values.push_back(image.error[pixel]);
}

/// Whether one of the set is estimated of the samples' noise, or not.
bool any_of(AovSet set, bool of_noise) {
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_aov(set, i) && all_aovs()[i].of_noise == of_noise) return true;
  return false;
}

}  // namespace

std::span<const Aov> all_aovs() {
  static const std::vector<Aov> AOVS = {
      {"depth", "distance from the eye", {"Z"}, false, put_depth},
      {"normal", "unit, world space", {"N.X", "N.Y", "N.Z"}, false, put_normal},
      {"id", "object's index, -1 on a miss", {"id"}, false, put_object},
      {"error", "estimated, of the radiance", {"error"}, true, put_error}};
  return AOVS;
}

bool needs_centre_rays(AovSet set) { return any_of(set, false); }
bool needs_noise(AovSet set) { return any_of(set, true); }

AovSet aovs_of(const Image& image) {
  AovSet set = 0;
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (!(all_aovs()[i].of_noise ? image.error.empty() : image.aov.empty())) set |= 1U << i;
  return set;
}

std::size_t count_channels(AovSet set) {
  std::size_t channels = 0;
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_aov(set, i)) channels += all_aovs()[i].channels.size();
  return channels;
}

}  // namespace splatray

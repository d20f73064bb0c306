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

void put_albedo(const Image& image, std::size_t pixel, std::vector<float>& values) {
  const vec4& albedo = image.albedo[pixel];
  values.insert(values.end(), {albedo.x, albedo.y, albedo.z});
}

bool has_source(const Image& image, AovSource source) {
  if (source == AovSource::noise) return !image.error.empty();
  return source == AovSource::albedo ? !image.albedo.empty() : !image.aov.empty();
}

}  // namespace

std::span<const Aov> all_aovs() {
  static const std::vector<Aov> AOVS = {
      {"depth", "distance from the eye", {"Z"}, AovSource::centre_ray, put_depth},
      {"normal", "unit, world space", {"N.X", "N.Y", "N.Z"}, AovSource::centre_ray, put_normal},
      {"id", "object's index, -1 on a miss", {"id"}, AovSource::centre_ray, put_object},
      {"error", "estimated, of the radiance", {"error"}, AovSource::noise, put_error},
      {"albedo",
       "base colour, linear, 0 to 1",
       {"albedo.R", "albedo.G", "albedo.B"},
       AovSource::albedo,
       put_albedo}};
  return AOVS;
}

bool needs(AovSet set, AovSource source) {
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_aov(set, i) && all_aovs()[i].source == source) return true;
  return false;
}

AovSet aovs_of(const Image& image) {
  AovSet set = 0;
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_source(image, all_aovs()[i].source)) set |= 1U << i;
  return set;
}

std::size_t count_channels(AovSet set) {
  std::size_t channels = 0;
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_aov(set, i)) channels += all_aovs()[i].channels.size();
  return channels;
}

}  // namespace splatray

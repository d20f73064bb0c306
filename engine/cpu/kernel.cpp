#include "engine/cpu/kernel.h"

#include "shaders/lang/albedo_layout.h"

namespace splatray {
namespace {

std::array<float, 3> numbers_of(const vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

WideLight wide_light_of(const KernelWork& work) {
  const FrameParams& frame = work.frame;
  const auto at = [&]<class Value>(std::uint32_t binding, const Value*& values) {
    values = reinterpret_cast<const Value*>(work.bound[binding]);
  };
  WideLight light{};
  at(BIND_MATERIALS, light.materials);
  at(BIND_LIGHT_TABLES, light.albedo);
  at(BIND_LIGHT_TABLES, light.sky);
  at(BIND_ENVIRONMENT, light.environment);
  light.sky += ALBEDO_WORDS;
  light.sky_width = has(work.constants, FEATURE_SKY) ? frame.sky_width : 0;
  light.sky_height = frame.sky_height;
  light.environment_width = work.environment_width;
  light.environment_height = work.environment_height;
  light.right = numbers_of(frame.environment_right);
  light.up = numbers_of(frame.environment_up);
  light.back = numbers_of(glm::cross(frame.environment_right, frame.environment_up));
  light.factor = numbers_of(frame.environment);
  light.seed = frame.seed;
  light.layered = has(work.constants, FEATURE_SPECULAR);
  return light;
}

}  // namespace splatray

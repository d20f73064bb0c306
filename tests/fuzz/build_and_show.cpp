#include "tests/fuzz/build_and_show.h"

#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/device/host/host_device.h"
#include "engine/scene/scene_check.h"
#include "preprocess/build.h"
#include "tests/fuzz/require.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {
namespace {

/// Takes one of `count` choices from the digits of `choice`.
std::uint64_t take_digit(std::uint64_t& choice, std::uint64_t count) {
  const std::uint64_t digit = choice % count;
  choice /= count;
  return digit;
}

BuildParams params_of(std::uint64_t choice) {
  BuildParams params;
  params.leaf_size = take_digit(choice, 2) == 0 ? 0 : 1 + static_cast<std::uint32_t>(take_digit(choice, 16));
  params.insertion =
      std::array{Insertion::overlap, Insertion::probe, Insertion::centre}.at(take_digit(choice, 3));
  params.radius_rule = take_digit(choice, 4) == 0 ? RadiusRule::knn : RadiusRule::coverage;
  params.normal_fields = take_digit(choice, 4) != 0;
  params.clip = take_digit(choice, 4) != 0;
  params.smooth_world = std::array{-1.0, -1.0, 0.0, 1e-3, 1.0, 1e6}.at(take_digit(choice, 6));
  return params;
}

void show(const Scene& scene, std::uint32_t look) {
  static const HostDevice device;
  ShownTracer tracer(device);
  tracer.upload(scene);
  tracer.look.lights = scene.lights;
  tracer.set_environment({0, 0, {}, vec3(1.0F)});
  View view{default_camera(scene, 1.0), 8, 8};
  Settings settings;
  settings.samples = 1;
  settings.look = look;
  for (const vec4& pixel : tracer.render(view, settings).rgba)
    for (int channel = 0; channel < 4; ++channel) require(std::isfinite(pixel[channel]), "pixels are finite");
}

}  // namespace

void build_and_show(Input input, std::uint64_t choice) {
  const std::uint32_t look = std::array{LOOK_LIT, LOOK_SCAN, LOOK_PAPER, LOOK_AO}.at(take_digit(choice, 4));
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), params_of(choice), 1, stats);
  require(!scene.data_pool.empty() && !find_scene_defect(scene), "a scene that was built may be walked");
  try {
    show(scene, look);
  } catch (const Error& error) {
    // Of a scene whose size is near the smallest number, no camera can be said in float32.
    require(error.code() == ExitCode::usage, "a picture is made, or its camera refused", error.what());
  }
}

}  // namespace splatray::testing

#include "tests/bench/measure/splatray_racer.h"

#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/measure/speed_record.h"
#include "tests/bench/measure/warm_up.h"

namespace splatray::testing {
namespace {

Material material_of(Frame frame) {
  Material material = scale_material();
  material.phong.mirror = frame == Frame::inside || frame == Frame::mirror ? 1.0F : 0.0F;
  return material;
}

bool is_outside(Frame frame) { return frame == Frame::primary || frame == Frame::shadow; }

}  // namespace

SplatrayRacer::SplatrayRacer(const Device& device, ShownTracer& tracer, const Course& course,
                             std::uint32_t blend)
    : device_(device), tracer_(tracer), course_(course), blend_(blend) {}

Settings SplatrayRacer::settings_of(Frame frame) const {
  Settings settings;
  settings.samples = 1;
  settings.blend = blend_;
  settings.shadows = frame == Frame::shadow;
  settings.max_bounces = frame == Frame::mirror ? MIRRORED : 0;
  return settings;
}

Image SplatrayRacer::render(Frame frame, const Settings& settings) {
  tracer_.set_materials({{material_of(frame)}});
  if (is_outside(frame)) tracer_.look.lights = {course_.light};
  if (!is_outside(frame)) tracer_.look.lights = {};
  return tracer_.render(is_outside(frame) ? course_.outside : course_.inside, settings);
}

void SplatrayRacer::trace(Frame frame, const Settings& settings) {
  if (frame == Frame::random) {
    static_cast<void>(tracer_.intersect(course_.probes.rays(), settings));
  } else {
    static_cast<void>(render(frame, settings));
  }
}

void SplatrayRacer::warm() {
  warm_up([&](std::uint32_t samples) {
    Settings settings = settings_of(Frame::primary);
    settings.samples = samples;
    static_cast<void>(render(Frame::primary, settings));
  });
}

double SplatrayRacer::run(Frame frame) {
  trace(frame, settings_of(frame));
  return tracer_.stats().trace_ms;
}

std::uint64_t SplatrayRacer::count_rays(Frame frame) {
  Settings settings = settings_of(frame);
  settings.counters = true;
  trace(frame, settings);
  const auto& count = tracer_.stats().counters;
  return frame == Frame::random ? count[COUNT_PRIMARY] : count[COUNT_SHADOW] + count[COUNT_REFLECTED];
}

Image SplatrayRacer::picture() {
  Settings settings = settings_of(Frame::primary);
  settings.aov = true;
  return render(Frame::primary, settings);
}

std::vector<RayHit> SplatrayRacer::intersect(std::span<const RayQuery> rays) {
  std::vector<RayQuery> turned(rays.begin(), rays.end());
  for (RayQuery& ray : turned) ray.from_normal = -ray.from_normal;  // the discs' own normals point outwards
  return tracer_.intersect(turned, settings_of(Frame::random));
}

std::uint64_t SplatrayRacer::false_shadows() {
  const Image lit = render(Frame::primary, settings_of(Frame::primary));
  const Image shadowed = render(Frame::shadow, settings_of(Frame::shadow));
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < lit.rgba.size(); ++i) count += lit.rgba[i] != shadowed.rgba[i] ? 1 : 0;
  return count;
}

void SplatrayRacer::describe(Json& record) {
  Settings settings = settings_of(Frame::primary);
  settings.counters = true;
  trace(Frame::primary, settings);
  record["method"] = blend_word(blend_);
  record["settings"]["blend"] = blend_word(blend_);
  add_device(record, device_);
  add_work(record["speed"], tracer_.stats());
  record["speed"]["bytes_per_splat"] = bytes_per_splat(tracer_, course_.splats);
}

}  // namespace splatray::testing

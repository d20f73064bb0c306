#include "tests/bench/measure/scale_rays.h"

#include "engine/file/scene_file.h"
#include "tests/bench/measure/splatray_racer.h"

namespace splatray::testing {
namespace {

void append(std::vector<Json>& list, std::vector<Json> more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<Json> measure_rays(const Device& device, const Case& one, const std::filesystem::path& folder,
                               const PeerMakers& makers) {
  const PreparedCase prepared = read_case(folder);
  ShownTracer tracer(device);
  tracer.set_environment(read_environment_file(folder / "environment.bin"));
  std::optional<Course> course;
  std::vector<PeerMaker> peers;
  {
    const Scene scene = read_scene(folder / file_name(one.runs.front().variant));
    tracer.upload(scene);
    course.emplace(one, prepared, scene);
    if (makers) peers = makers(scene);
  }
  std::vector<Json> records;
  for (const PeerMaker& peer : peers) {
    SplatrayRacer own(device, tracer, *course, peer.blend);
    const std::unique_ptr<Racer> other = peer.make(*course);
    append(records, race(one, *course, {&own, other.get()}, peer.secondary));
  }
  if (peers.empty()) {
    SplatrayRacer window(device, tracer, *course, BLEND_WINDOW);
    SplatrayRacer nearest(device, tracer, *course, BLEND_NEAREST);
    append(records, race(one, *course, {&window}, true));
    append(records, race(one, *course, {&nearest}, false));
  }
  return records;
}

}  // namespace splatray::testing

#include "app/library/shot/sequence.h"

#include <algorithm>

#include "app/library/camera_file.h"
#include "app/library/image_file.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

/// All frames there are.
FrameRange whole_range(const Sequence& sequence) {
  if (!sequence.path.empty()) return {sequence.path.front().frame, sequence.path.back().frame};
  return {0, sequence.turntable - 1};
}

/// The frames that are asked for.
std::vector<std::uint32_t> wanted_frames(const Sequence& sequence, const Request::Output& output) {
  const FrameRange whole = whole_range(sequence);
  if (output.frames.empty()) return listed_frames({whole});
  for (const FrameRange& range : output.frames)
    if (range.first < whole.first || range.last > whole.last)
      throw Error(ExitCode::usage, "found --frames " + frame_list_text(output.frames) +
                                       ", expected some of " + frame_list_text({whole}) + ", which " +
                                       (sequence.path.empty() ? "--turntable" : "the camera path") + " has");
  return listed_frames(output.frames);
}

}  // namespace

Plan plan_pictures(const Request& request) {
  Plan plan;
  if (!request.output.many()) {
    plan.frames.push_back({0, request.output.path});
    return plan;
  }
  Sequence& sequence = plan.sequence;
  if (!request.output.camera_path.empty()) sequence.path = read_camera_path(request.output.camera_path);
  sequence.turntable = request.output.turntable;
  for (const std::uint32_t number : wanted_frames(sequence, request.output))
    plan.frames.push_back({number, frame_file(request.output.path, number)});
  return plan;
}

}  // namespace splatray

#include "app/cli/sequence.h"

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
std::vector<std::uint32_t> wanted_frames(const Sequence& sequence, const SequenceOptions& options) {
  const FrameRange whole = whole_range(sequence);
  if (options.frames.empty()) return listed_frames({whole});
  for (const FrameRange& range : options.frames)
    if (range.first < whole.first || range.last > whole.last)
      throw Error(ExitCode::usage, "found --frames " + frame_list_text(options.frames) +
                                       ", expected some of " + frame_list_text({whole}) + ", which " +
                                       (sequence.path.empty() ? "--turntable" : "the camera path") + " has");
  return listed_frames(options.frames);
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& pattern, std::uint32_t number) {
  const std::string name = pattern.filename();
  const std::size_t begin = name.find('#');
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  if (begin == std::string::npos || name.find('#', end) != std::string::npos)
    throw Error(ExitCode::usage,
                "found output '" + pattern.string() +
                    "' for a sequence, expected a name with one run of # such as out.####.png");
  std::string digits = std::to_string(number);
  digits.insert(0, std::max(end - begin, digits.size()) - digits.size(), '0');
  return pattern.parent_path() / (name.substr(0, begin) + digits + name.substr(end));
}

Sequence plan_sequence(const RenderOptions& options) {
  Sequence sequence;
  if (options.sequence.many()) {
    if (!options.sequence.camera_path.empty()) sequence.path = read_camera_path(options.sequence.camera_path);
    sequence.turntable = options.sequence.turntable;
    for (const std::uint32_t number : wanted_frames(sequence, options.sequence))
      sequence.frames.push_back({number, frame_file(options.output, number)});
  } else {
    sequence.frames.push_back({0, options.output});
  }
  return sequence;
}

Camera frame_camera(const Sequence& sequence, std::uint32_t frame, const Camera& still,
                    const glm::dvec3& up) {
  if (!sequence.path.empty()) return camera_at(sequence.path, frame);
  if (sequence.turntable > 0) return turned_camera(still, up, double(frame) / sequence.turntable);
  return still;
}

}  // namespace splatray

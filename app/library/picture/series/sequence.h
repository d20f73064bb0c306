/// Which pictures a run makes, and from where each is seen.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/library/camera_path.h"
#include "app/library/request/request.h"

namespace splatray {

/// One picture of a run.
struct SequenceFrame {
  std::uint32_t number = 0;  ///< 0 for a still
  std::filesystem::path output;
};

struct Sequence {
  std::vector<SequenceFrame> frames;  ///< to be made
  CameraPath path;                    ///< empty without --camera-path
  std::uint32_t turntable = 0;        ///< frames of a full turn; 0 = none
};

/// Reads the camera path. With --skip-existing, without the frames whose file is a whole picture; a broken one, of a crash or
/// of another program, is made again. Throws Error: input_unreadable, or usage for frames beyond the sequence.
[[nodiscard]] Sequence plan_sequence(const Request& request);

/// The camera of a frame. `still`: the camera without a sequence; `up`: the scene's up direction.
[[nodiscard]] Camera frame_camera(const Sequence& sequence, std::uint32_t frame, const Camera& still,
                                  const glm::dvec3& up);

}  // namespace splatray

/// Which pictures a run makes, and from where each is seen.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/cli/options.h"
#include "app/library/camera_path.h"

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

/// The pattern with its one run of # replaced by the number, padded with zeros to the run's length. Throws Error (usage)
/// unless the file's name has exactly one run.
[[nodiscard]] std::filesystem::path frame_file(const std::filesystem::path& pattern, std::uint32_t number);

/// Reads the camera path. With --skip-existing, without the frames whose file is a whole picture; a broken one, of a crash or
/// of another program, is made again. Throws Error: input_unreadable, or usage for frames beyond the sequence.
[[nodiscard]] Sequence plan_sequence(const RenderOptions& options);

/// The camera of a frame. `still`: the camera without a sequence; `up`: the scene's up direction.
[[nodiscard]] Camera frame_camera(const Sequence& sequence, std::uint32_t frame, const Camera& still,
                                  const glm::dvec3& up);

}  // namespace splatray

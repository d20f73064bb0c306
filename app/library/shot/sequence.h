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

/// Pictures along a path or all around.
struct Sequence {
  CameraPath path;              ///< empty without --camera-path
  std::uint32_t turntable = 0;  ///< frames of a full turn; 0 = none
};

/// The pictures of a run and their files; of a still one, frame 0.
struct Plan {
  Sequence sequence;
  std::vector<SequenceFrame> frames;
};

/// Reads the camera path. Throws Error: input_unreadable, or usage for frames beyond the sequence.
[[nodiscard]] Plan plan_pictures(const Request& request);

}  // namespace splatray

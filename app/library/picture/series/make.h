/// A shot made: its pictures, one after the other, from a scene that is loaded and uploaded once.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/library/picture/make_picture.h"

namespace splatray {

/// A picture that was made.
struct PictureRecord {
  SequenceFrame frame;
  std::size_t lights = 0;
  RenderStats stats;
  double write_ms = 0.0;
  double denoise_ms = 0.0;  ///< 0 without --denoise
};

/// A picture that could not be made.
struct FailedPicture {
  SequenceFrame frame;
  std::string reason;  ///< a sentence
};

struct SequenceRecord {
  std::vector<PictureRecord> made;
  std::vector<FailedPicture> failed;
  std::size_t skipped = 0;  ///< left out, as they were there
  Image last;               ///< the picture made last
};

/// Who hears of a run, on its thread.
struct SequenceListener {
  /// Called with the picture being made, how many came before it, and the share of it done, 0..1; returns false to stop.
  std::function<bool(const SequenceFrame& frame, std::size_t before, double share)> progress;
  std::function<void(const std::string&)> note;      ///< a sentence
  std::function<void(const FailedPicture&)> failed;  ///< of several, as soon as one is
  /// What becomes of a still picture that is stopped: a signal's is kept, one that a person gives up is not.
  Stopped stopped = Stopped::dropped;
};

/// Beside a picture other than an EXR that a signal stopped, the EXR of its samples: NAME.unfinished.exr.
[[nodiscard]] std::filesystem::path unfinished_file(std::filesystem::path picture);

/// Makes the pictures of a shot and writes their files. Each is the still of its camera, default lights included. One of several that
/// cannot be made is recorded, and the others go on; of a single one throws the Error. Throws Error (interrupted) when the listener
/// stops it, and after a signal.
[[nodiscard]] SequenceRecord make(const Shot& shot, SceneOnDevice& shown, const SequenceListener& listener);

/// Throws Error (failed) when a picture failed.
void require_all_made(const SequenceRecord& record);

}  // namespace splatray

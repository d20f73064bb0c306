/// The pictures of a run, made one after the other from a scene that is loaded and uploaded once.
#pragma once
#include <vector>

#include "app/cli/sequence.h"
#include "app/library/scene_source.h"
#include "engine/base/progress.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// A picture that was made.
struct PictureRecord {
  SequenceFrame frame;
  std::size_t lights = 0;
  RenderStats stats;
  double write_ms = 0.0;
  double denoise_ms = 0.0;  ///< 0 without --denoise
};

struct SequenceRecord {
  std::vector<PictureRecord> made;
  std::vector<SequenceFrame> failed;
  Image last;  ///< the picture made last
};

/// Makes the pictures with an uploaded tracer; the scene's pools are not looked at. `still`: the camera without a sequence. Each is the still of its camera, default lights included. One of several
/// that cannot be made is told on stderr, and the others go on; of a single one throws the Error. Always throws Error
/// (interrupted) after a signal.
[[nodiscard]] SequenceRecord render_sequence(const RenderOptions& options, const Sequence& sequence,
                                             const LoadedScene& loaded, const Camera& still,
                                             const Context& context, Tracer& tracer, ProgressLine& progress);

/// Throws Error (failed) when a picture failed.
void require_all_made(const SequenceRecord& record);

}  // namespace splatray

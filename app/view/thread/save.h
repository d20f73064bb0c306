/// What is seen, written as splatray-render would.
#pragma once
#include <functional>
#include <string>

#include "app/cli/options.h"
#include "app/view/thread/live_scene.h"
#include "app/view/ui/panels.h"

namespace splatray {

/// Pictures that are to be made.
struct SaveJob {
  Document document;
  RenderOptions options;  ///< of the document; with output, size, samples, AOVs and sequence
};

[[nodiscard]] SaveJob save_job(const Document& document, const SaveRequest& request);
[[nodiscard]] SaveJob save_job(const Document& document, const RecordRequest& request);

/// Told what is made and the share of the job done, 0..1; returns false to stop.
using SaveProgress = std::function<bool(const Work&)>;

/// Traces the pictures and writes their files: bit for bit those of splatray-render with the same options. Returns a
/// sentence about what was written. Throws Error: usage, input_unreadable for a camera path, failed, or interrupted when
/// `progress` says so.
[[nodiscard]] std::string save_pictures(const SaveJob& job, LiveScene& live, const Context& context,
                                        const SaveProgress& progress);

}  // namespace splatray

/// What is seen, written as splatray-render would.
#pragma once
#include <functional>
#include <string>

#include "app/library/request/request.h"
#include "app/view/model/panel_state.h"
#include "app/view/thread/live_scene.h"

namespace splatray {

/// Pictures that are to be made.
struct SaveJob {
  Document document;
  Request request;  ///< of the document; with output, size, samples, AOVs, and sequence or sheet
};

/// The document's pictures, as saved_request has them.
[[nodiscard]] SaveJob save_job(const Document& document, const Request& asked);

/// Called with what is being made and the share of the job done, 0..1; returns false to stop.
using SaveProgress = std::function<bool(const Work&)>;

/// Traces the pictures and writes their files: bit for bit those of splatray-render with the same options. Returns a
/// sentence about what was written. Throws Error: usage, input_unreadable for a camera path, failed, or interrupted when
/// `progress` says so.
[[nodiscard]] std::string save_pictures(const SaveJob& job, LiveScene& live, const SaveProgress& progress);

}  // namespace splatray

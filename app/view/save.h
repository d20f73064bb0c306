/// What is seen, written as splatray-render would.
#pragma once
#include "app/view/document.h"
#include "app/view/live_scene.h"
#include "app/view/panels.h"

namespace splatray {

/// Traces the document, which the live scene matches in ViewMode::shaded, and writes it as the request says: bit for bit
/// the picture of splatray-render with the same options. Throws Error: failed, or interrupted when `progress` says so.
void save_picture(const Document& document, const SaveRequest& request, LiveScene& live, const Context& context,
                  const Tracer::Progress& progress);

}  // namespace splatray

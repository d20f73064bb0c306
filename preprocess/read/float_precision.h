/// What float32 positions lose.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// float32 positions far from the origin lose detail: notes it when the loss exceeds 1e-5 of the points' extent.
void note_float_precision(const Points& points, const std::filesystem::path& path,
                          const ReadListener& listener);

}  // namespace splatray

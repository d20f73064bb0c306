/// Measures a case on a device.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/device/device.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

/// One record (record.h) for each of the case's runs, in order, from what prepare_case left in `folder`. Throws Error.
[[nodiscard]] std::vector<Json> measure_case(const Device& device, const Case& one,
                                             const std::filesystem::path& folder);

}  // namespace splatray::testing

/// A benchmark's cases, one after the other.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

/// The case of that name; all of them where the name is empty.
[[nodiscard]] std::vector<Case> named(std::vector<Case> cases, const std::string& name);

/// Measures a case from what splatray-bench prepare left for it in a folder. Throws Error (out_of_memory) where it does not fit.
using CaseMeasure = std::function<std::vector<Json>(const Case& one, const std::filesystem::path& prepared)>;

/// Measures cases prepared under `folder` and writes all their records to `output`; says on stdout what became of each. Those
/// that were not prepared or do not fit are left out.
void measure_cases(const std::vector<Case>& cases, const std::filesystem::path& folder,
                   const std::filesystem::path& output, const CaseMeasure& measure);

}  // namespace splatray::testing

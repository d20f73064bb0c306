/// What is odd about a picture that is asked for, in sentences.
#pragma once
#include <string>
#include <vector>

#include "app/library/request/request.h"
#include "app/library/shot/sheet.h"
#include "engine/image/look.h"

namespace splatray {

/// A sentence for each option that differs from its default and that the look (LOOK_*) does not use.
[[nodiscard]] std::vector<std::string> ignored_options(const Request& request, std::uint32_t look);

/// Sentences about light that is not there: that lights have no power, and that nothing sends out light, so that the picture is
/// black. None for looks that need no light.
[[nodiscard]] std::vector<std::string> missing_light(const Look& look, const Settings& settings);

/// Sentences about a sheet that may be another than is meant: its unit is not known, or its cut meets nothing, but for an atlas' page, as
/// a roof's is.
[[nodiscard]] std::vector<std::string> odd_sheet(const Sheet& sheet);

/// Whether some object that is shown sends out light.
[[nodiscard]] bool sends_out_light(const std::vector<Material>& materials);

}  // namespace splatray

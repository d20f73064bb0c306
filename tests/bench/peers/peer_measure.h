/// Measures the peers on a case.
#pragma once
#include <filesystem>
#include <vector>

#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

/// Whether peers are measured on the case: pictures with a truth.
[[nodiscard]] bool has_peers(const Case& one);

/// Records (record.h) of each peer on one thread and on all, from what prepare_case left in `folder`; times in rounds as
/// for splatray's own (frames.h), without shading. Methods, at every number of splats that the case is tried at:
/// "embree nearest" and "embree window" (peer_embree_discs.h) with the splats' normal fields, and the latter of flat discs
/// with the Gaussian kernel; at the first number also nearest and window of flat discs, "embree mesh" where the case
/// has one, and unless `quick` "embree user" (peer_embree_clusters.h; settings.leaf_size = discs of a primitive).
/// `data`: folder of the models. Throws Error.
[[nodiscard]] std::vector<Json> measure_peers(const Case& one, const std::filesystem::path& folder,
                                              const std::filesystem::path& data, bool quick);

}  // namespace splatray::testing

/// Which source a program was built from.
#pragma once

namespace splatray {

/// Abbreviated git commit, "-dirty" when files differed from it, "unknown" without git.
extern const char* const COMMIT;

}  // namespace splatray

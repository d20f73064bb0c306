/// Damaged scene files made so that their damage is met behind the form.
#pragma once
#include "tests/format/scene_bytes.h"

namespace splatray::testing {

/// The bytes with a scene file's form: magic, version, sizes, section table, gaps, end marker and checksums are put right; counts are
/// cut. All else stays, for the reader to judge. `good`, of version 15, stays what it is.
[[nodiscard]] Bytes with_form(Bytes bytes, const Bytes& good);

/// The same of version 10.
[[nodiscard]] Bytes with_old_form(Bytes bytes, const Bytes& good);

}  // namespace splatray::testing

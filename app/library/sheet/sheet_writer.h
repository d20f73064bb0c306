/// The library that writes sheets, loaded when it is first asked for.
#pragma once
#include "app/library/codec/sheet_codec.h"

namespace splatray {

/// Throws Error (failed), which says what to install, where it is not there.
[[nodiscard]] const SheetCodec& sheet_codec();

}  // namespace splatray

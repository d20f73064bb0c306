#include "app/library/sheet/sheet_writer.h"

#include "engine/base/error.h"
#include "engine/base/module.h"

namespace splatray {

const SheetCodec& sheet_codec() {
  static void* const function =
      module_function("splatray_sheet", "splatray_sheet_codec", ExitCode::failed,
                      "cannot load what writes sheets", ": the package splatray-sheet");
  return *reinterpret_cast<decltype(&splatray_sheet_codec)>(function)();
}

}  // namespace splatray

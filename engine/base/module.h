/// Libraries of this project that are loaded when a file needs them, as others' libraries that they need are large.
#pragma once
#include <string>

#include "engine/base/error.h"

namespace splatray {

/// A function of a module, never nullptr. `name` is the module's, such as "splatray_vtk": its file's name has the project's
/// version, so that no other version is loaded. It is looked for beside this code, where it is installed to from a library or a
/// program, and where the system looks; any thread. Throws Error (`code`) that begins with `purpose`, such as "cannot read
/// a.tif", and ends with `remedy`, what to install.
[[nodiscard]] void* module_function(const char* name, const char* function, ExitCode code,
                                    const std::string& purpose, const std::string& remedy);

}  // namespace splatray

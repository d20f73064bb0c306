#include "engine/base/module.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <filesystem>

namespace splatray {
namespace {

/// The folder of the program, library or module of another language that holds this code.
std::filesystem::path own_folder() {
  Dl_info own{}, program{};
  const auto within_program = getauxval(AT_PHDR);
  // The loader knows a program only by the name it was started with.
  const bool in_program =
      dladdr(reinterpret_cast<void*>(&own_folder), &own) == 0 ||
      (dladdr(reinterpret_cast<void*>(within_program), &program) != 0 && own.dli_fbase == program.dli_fbase);
  if (in_program) return std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return std::filesystem::absolute(own.dli_fname).parent_path();
}

}  // namespace

void* module_function(const char* name, const char* function, ExitCode code, const std::string& purpose,
                      const std::string& remedy) {
  const std::string file = "lib" + std::string(name) + "-" SPLATRAY_VERSION ".so";
  const std::filesystem::path folder = own_folder();
  void* library = nullptr;
  std::string reason;
  for (const auto& place : {folder / file, folder / "splatray" / file, folder / MODULE_FOLDER / file,
                            std::filesystem::path(file)}) {
    if (library != nullptr) break;
    library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr && (reason.empty() || std::filesystem::exists(place))) reason = dlerror();
  }
  void* symbol = library == nullptr ? nullptr : dlsym(library, function);
  if (symbol == nullptr)
    throw Error(code, purpose + ": found " + (library == nullptr ? reason : dlerror()) +
                          ", expected it in '" + folder.string() + "' or installed" + remedy);
  return symbol;
}

}  // namespace splatray

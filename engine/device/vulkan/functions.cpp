#include "engine/device/vulkan/functions.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "engine/base/error.h"

namespace splatray {
namespace {

constexpr const char* LOADER = "libvulkan.so.1";

constexpr std::array NAMES = {
#define SPLATRAY_NAME(name) #name,
    SPLATRAY_VULKAN_FUNCTIONS(SPLATRAY_NAME)
#undef SPLATRAY_NAME
};
using Functions = std::array<PFN_vkVoidFunction, NAMES.size()>;

/// Null where the library or a function is missing. The library stays: drivers leave threads and exit handlers behind.
Functions find_functions() {
  Functions functions{};
  void* library = dlopen(LOADER, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return functions;
  std::transform(NAMES.begin(), NAMES.end(), functions.begin(), [library](const char* name) {
    return reinterpret_cast<PFN_vkVoidFunction>(dlsym(library, name));
  });
  return functions;
}

struct Loader {
  Functions functions = find_functions();
  pid_t process = getpid();  ///< that loaded it
};

const Loader& loader() {
  static const Loader loaded;
  return loaded;
}

const Functions& functions() { return loader().functions; }

}  // namespace

bool vulkan_is_installed() {
  return std::find(functions().begin(), functions().end(), nullptr) == functions().end();
}

void refuse_vulkan_of_parent() {
  if (loader().process != getpid())
    throw Error(ExitCode::no_device,
                "found a process that was forked off after Vulkan was used, expected one that started anew "
                "(in Python: "
                "multiprocessing's start method 'spawn'), or the device 'cpu'");
}

PFN_vkVoidFunction vulkan_function(VulkanFunctionNumber number) {
  const PFN_vkVoidFunction function = functions()[static_cast<std::size_t>(number)];
  if (function == nullptr)
    throw Error(ExitCode::no_device,
                std::string("found no Vulkan loader with ") + NAMES[static_cast<std::size_t>(number)] +
                    ", expected " + LOADER +
                    " (Debian's packages libvulkan1 and mesa-vulkan-drivers; the device 'cpu' needs none)");
  return function;
}

}  // namespace splatray

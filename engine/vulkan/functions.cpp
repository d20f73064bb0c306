#include "engine/vulkan/functions.h"

#include <dlfcn.h>

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

const Functions& functions() {
  static const Functions found = find_functions();
  return found;
}

}  // namespace

bool vulkan_is_installed() {
  return std::find(functions().begin(), functions().end(), nullptr) == functions().end();
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

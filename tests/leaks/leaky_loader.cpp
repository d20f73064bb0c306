/// Stands for the Vulkan loader: a library that loads a driver and unloads it.
#include <dlfcn.h>

extern "C" int use_driver(const char* path) {
  void* driver = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  void* start = driver == nullptr ? nullptr : dlsym(driver, "start_driver");
  if (start == nullptr) return 1;
  reinterpret_cast<void (*)()>(start)();
  return dlclose(driver);
}

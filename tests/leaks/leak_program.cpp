/// leak_program driver FILE | own: loads and unloads a library that keeps memory, or loses memory of its own.
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int use_driver(const char* path);

namespace {

/// Overwritten before the program ends, so that nothing is left of the pointer.
[[gnu::noinline]] void lose_memory() {
  void* volatile lost = std::malloc(128);
  std::printf("lost %d bytes\n", lost == nullptr ? 0 : 128);
  lost = nullptr;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "";
  if (what == "driver" && count == 3) return use_driver(arguments[2]);
  if (what == "own") lose_memory();
  return what == "own" ? 0 : 2;
}

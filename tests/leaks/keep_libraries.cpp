/// Libraries stay loaded until the process ends: linked into each program of the builds whose leaks are looked for, in place of
/// the C library's function. Mesa's drivers allocate memory that only their own variables point to (on AMD processors of the
/// families 23 and 25 a mask for each L3 cache, of a window's surface 112 bytes); once the Vulkan loader has unloaded a driver,
/// LeakSanitizer would report it as leaked, from an unknown module.
extern "C" int dlclose(void* /*library*/) noexcept { return 0; }

/// What VTK's readers and filters leave behind, of damaged files and of sound ones, is not ours to free, nor are the fonts that
/// Fontconfig, which Cairo asks for letters, keeps until the process ends, nor what the validation layers note of synchronization.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libvtk\nleak:libfontconfig\nleak:libVkLayer_khronos_validation\n";
}

/// Some tests ask that a program says nothing.
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }

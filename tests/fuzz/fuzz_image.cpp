// The targets that read pictures, parts of them and environments. OpenImageIO is not instrumented: the fuzzer sees our part alone, and
// crashes of either.
#include <cmath>
#include <string_view>

#include "app/farm/join_tiles.h"
#include "app/library/image_file.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets.h"

namespace splatray::testing {

void fuzz_image(FuzzBytes bytes) {
  static const MemoryFolder folder;
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const char* name = start.starts_with("#?")                 ? "fuzzed.hdr"
                     : start.starts_with("\x76\x2f\x31\x01") ? "fuzzed.exr"
                                                             : "fuzzed.png";
  const std::filesystem::path path = folder.write(name, bytes);
  read_or_refuse([&] {
    for (const auto& texel : read_environment(path).texels)
      for (int channel = 0; channel < 3; ++channel)
        require(texel[channel] >= 0.0F && std::isfinite(texel[channel]), "light is finite and not negative");
  });
  read_or_refuse([&] { (void)read_metadata(path); });
}

void fuzz_part(FuzzBytes bytes) {
  static const MemoryFolder folder;
  const std::filesystem::path path = folder.write("part.exr", bytes);
  read_or_refuse([&] {
    const ExrPicture whole = join_tiles({path});
    require(whole.values.size() == std::size_t{whole.width} * whole.height * whole.channels.size(),
            "a joined picture has all its values");
  });
}

}  // namespace splatray::testing

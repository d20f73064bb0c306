// What the fuzzers started from and what they found, once more: each file of the corpus through its target.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/targets.h"

namespace splatray::testing {
namespace {

/// Runs every file of a corpus folder; a finding ends the program.
void replay(const char* name, void (*target)(FuzzBytes)) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(CORPUS) / name)) {
    SCOPED_TRACE(entry.path());
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
    target({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ++files;
  }
  EXPECT_GT(files, 0U);
}

TEST(FuzzReplay, SceneFiles) { replay("scene_file", fuzz_scene_file); }
TEST(FuzzReplay, Ply) { replay("ply", fuzz_ply); }
TEST(FuzzReplay, Gltf) { replay("gltf", fuzz_gltf); }

}  // namespace
}  // namespace splatray::testing

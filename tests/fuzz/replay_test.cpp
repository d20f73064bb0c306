// What the fuzzers started from and what they found, once more: each file of the corpus through its target.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/targets.h"

namespace splatray::testing {
namespace {

/// Every target of the table, with its folder of the corpus.
class FuzzReplay : public ::testing::TestWithParam<FuzzTarget> {};

/// A finding ends the program.
TEST_P(FuzzReplay, Corpus) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(CORPUS) / GetParam().name)) {
    SCOPED_TRACE(entry.path());
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
    GetParam().run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ++files;
  }
  EXPECT_GT(files, 0U);
}

INSTANTIATE_TEST_SUITE_P(, FuzzReplay, ::testing::ValuesIn(FUZZ_TARGETS),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace splatray::testing

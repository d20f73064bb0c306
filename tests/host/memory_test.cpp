#include "engine/base/memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

class MemoryTest : public ::testing::Test {
 protected:
  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((root.path() / file).parent_path());
    std::ofstream(root.path() / file) << text;
  }

  TempFolder root;
};

constexpr std::uint64_t NO_LIMIT = std::numeric_limits<std::uint64_t>::max();

TEST_F(MemoryTest, OfTheMachine) {
  EXPECT_EQ(available_memory(root.path()), NO_LIMIT) << "nothing is known";
  write("proc/meminfo", "MemTotal: 900 kB\nMemAvailable: 600 kB\nSwapFree: 100 kB\n");
  EXPECT_EQ(available_memory(root.path()), 700U * 1024);
  EXPECT_GT(available_memory(), 0U);
}

TEST_F(MemoryTest, OfControlGroupsAndThoseAround) {
  write("proc/meminfo", "MemAvailable: 600 kB\n");
  write("proc/self/cgroup", "0::/outer/inner\n");
  write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  write("sys/fs/cgroup/outer/inner/memory.current", "90000\n");
  EXPECT_EQ(available_memory(root.path()), 600U * 1024);
  write("sys/fs/cgroup/outer/memory.max", "100000\n");
  write("sys/fs/cgroup/outer/memory.current", "95000\n");
  write("sys/fs/cgroup/outer/memory.stat", "anon 70000\ninactive_file 20000\nactive_file 1000\n");
  EXPECT_EQ(available_memory(root.path()), 26000U) << "the cache of files can be taken back";
  write("sys/fs/cgroup/outer/memory.current", "200000\n");
  EXPECT_EQ(available_memory(root.path()), 0U);
}

TEST_F(MemoryTest, OfTheFirstVersionAndInContainers) {
  write("proc/self/cgroup", "5:cpu:/a\n4:hugetlb,memory:/docker/0123\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "50000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "30000\n");
  write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 5000\n");
  EXPECT_EQ(available_memory(root.path()), 25000U);
}

TEST_F(MemoryTest, IsWatched) {
  int heard = 0;
  const auto hear = [&](const char*, double) { return ++heard < 2; };
  write("proc/meminfo", "MemAvailable: 100000 kB\n");
  const Progress plenty = watching_memory(hear, root.path());
  EXPECT_TRUE(plenty("a", 0.0));
  EXPECT_FALSE(plenty("a", 0.5));
  EXPECT_TRUE(watching_memory({}, root.path())("a", 0.0));
  write("proc/meminfo", "MemAvailable: 40000 kB\n");
  try {
    (void)watching_memory(hear, root.path())("a", 0.0);
    FAIL() << "the memory was not looked at";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::out_of_memory);
  }
}

TEST(Memory, IsAskedFor) {
  EXPECT_NO_THROW(require_memory(1, "a byte"));
  try {
    require_memory(std::uint64_t{1} << 60U, "a picture");
    FAIL() << "an exbibyte was there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::out_of_memory);
    EXPECT_EQ(std::string(error.what()).find("a picture needs 1073741824.00 GiB of memory, found "), 0U);
  }
}

}  // namespace
}  // namespace splatray

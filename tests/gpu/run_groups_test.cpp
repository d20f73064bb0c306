#include "engine/cpu/run_groups.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <thread>

namespace splatray {
namespace {

std::mutex mutex;
std::set<std::thread::id> threads;
std::set<std::uint32_t> groups;

void note_thread(const KernelWork&, std::uint32_t group, Counts& counts) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::lock_guard lock(mutex);
  threads.insert(std::this_thread::get_id());
  groups.insert(group);
  ++counts[0];
}

TEST(RunGroups, TakesAsManyThreadsAsItMay) {
  for (const unsigned most : {1U, 3U}) {
    threads.clear();
    groups.clear();
    std::array<std::uint64_t, COUNTER_COUNT> counts{};
    run_groups(note_thread, {}, 200, most, counts);
    EXPECT_EQ(groups.size(), 200U);
    EXPECT_EQ(counts[0], 200U);
    EXPECT_LE(threads.size(), most);
    EXPECT_TRUE(threads.contains(std::this_thread::get_id()));
  }
  EXPECT_GT(threads.size(), 1U);
}

}  // namespace
}  // namespace splatray

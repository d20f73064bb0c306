#include "engine/base/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t NO_LIMIT = std::numeric_limits<std::uint64_t>::max();

std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// The number behind a name in lines "NAME NUMBER", 0 where there is none.
std::uint64_t value_of(const fs::path& file, const std::string& name) {
  std::ifstream lines(file);
  for (std::string word; lines >> word;)
    if (std::uint64_t value = 0; word == name && lines >> value) return value;
  return 0;
}

/// The number that a file consists of; no limit where it has none, such as "max".
std::uint64_t number_in(const fs::path& file) {
  std::uint64_t value = 0;
  return std::ifstream(file) >> value ? value : NO_LIMIT;
}

std::uint64_t left_of_machine(const fs::path& root) {
  constexpr std::uint64_t KIB = 1024;
  const fs::path file = root / "proc/meminfo";
  const std::uint64_t available = value_of(file, "MemAvailable:");
  return available == 0 ? NO_LIMIT : KIB * (available + value_of(file, "SwapFree:"));
}

/// The names of a control group's files; the two versions have their own.
struct GroupFiles {
  const char *limit, *used, *inactive, *active;
};

/// Memory left to a control group by its own limit and those around it. In a container the group's own path may not be there: its root then is.
std::uint64_t left_of_groups(const fs::path& top, std::string group, const GroupFiles& files) {
  std::uint64_t left = NO_LIMIT;
  for (;; group.resize(group.find_last_of('/') == std::string::npos ? 0 : group.find_last_of('/'))) {
    const fs::path folder = top / fs::path(group).relative_path();
    const std::uint64_t limit = number_in(folder / files.limit), used = number_in(folder / files.used);
    const fs::path statistics = folder / "memory.stat";
    if (limit != NO_LIMIT && used != NO_LIMIT)
      left = std::min(left, difference(limit, difference(used, value_of(statistics, files.inactive) +
                                                                   value_of(statistics, files.active))));
    if (group.empty()) return left;
  }
}

std::uint64_t left_of_groups(const fs::path& root) {
  constexpr GroupFiles FIRST{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file",
                             "total_active_file"};
  constexpr GroupFiles SECOND{"memory.max", "memory.current", "inactive_file", "active_file"};
  std::uint64_t left = NO_LIMIT;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // NUMBER:CONTROLLERS:PATH
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string path = line.substr(second + 1);
    if (controllers.empty()) left = std::min(left, left_of_groups(root / "sys/fs/cgroup", path, SECOND));
    if (("," + controllers + ",").find(",memory,") != std::string::npos)
      left = std::min(left, left_of_groups(root / "sys/fs/cgroup/memory", path, FIRST));
  }
  return left;
}

std::uint64_t left_of_address_space(const fs::path& root) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return NO_LIMIT;
  const std::uint64_t pages = number_in(root / "proc/self/statm");
  return pages == NO_LIMIT
             ? NO_LIMIT
             : difference(limit.rlim_cur, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

std::uint64_t available_memory(const fs::path& root) {
  return std::min({left_of_machine(root), left_of_groups(root), left_of_address_space(root)});
}

Progress watching_memory(Progress progress, const fs::path& root) {
  using Clock = std::chrono::steady_clock;
  return [progress = std::move(progress), root, last = Clock::time_point()](const char* stage,
                                                                            double share) mutable {
    constexpr auto PAUSE = std::chrono::milliseconds(20);
    constexpr std::uint64_t LEAST = std::uint64_t{48} << 20U;
    if (Clock::now() - last > PAUSE) {
      last = Clock::now();
      if (const std::uint64_t available = available_memory(root); available < LEAST)
        throw Error(ExitCode::out_of_memory, "found " + bytes_text(available) +
                                                 " of memory left at the stage '" + stage +
                                                 "', expected room for a scene of this size");
    }
    return !progress || progress(stage, share);
  };
}

void require_memory(std::uint64_t bytes, const std::string& what) {
  constexpr std::uint64_t SMALL = std::uint64_t{4} << 20U;  // is not worth the question
  if (bytes <= SMALL) return;
  const std::uint64_t kept = mallinfo2().fordblks;  // free, and not given back to the system
  const std::uint64_t left = available_memory(), available = left > NO_LIMIT - kept ? NO_LIMIT : left + kept;
  if (bytes > available)
    throw Error(ExitCode::out_of_memory,
                what + " needs " + bytes_text(bytes) + " of memory, found " + bytes_text(available));
}

}  // namespace splatray

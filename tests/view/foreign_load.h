/// What else a machine does, so that a test of rates does not judge a program by the load that others make.
#pragma once
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace splatray {

/// Linux only: from /proc/stat, less what this process and the children that it has waited for took.
class ForeignLoad {
 public:
  /// Share of all CPUs that others took since the construction, 0..1.
  [[nodiscard]] double share() const {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    return (foreign_s() - foreign_s_) / (elapsed_s * std::thread::hardware_concurrency());
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }

  static double foreign_s() {
    std::ifstream file("/proc/stat");
    std::string label;
    double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, wait = 0.0, irq = 0.0, soft_irq = 0.0,
           stolen = 0.0;
    file >> label >> user >> nice >> system >> idle >> wait >> irq >> soft_irq >> stolen;
    double own_s = 0.0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
      rusage usage{};
      getrusage(who, &usage);
      own_s += seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
    const auto ticks_per_s = static_cast<double>(sysconf(_SC_CLK_TCK));
    return (user + nice + system + irq + soft_irq + stolen) / ticks_per_s - own_s;
  }

  Clock::time_point start_ = Clock::now();
  double foreign_s_ = foreign_s();
};

}  // namespace splatray

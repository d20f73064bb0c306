/// The processor that peers run on.
#pragma once
#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace splatray::testing {

/// "Intel(R) Xeon(R) Processor", from Linux; "CPU" elsewhere.
[[nodiscard]] inline std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "CPU";
}

[[nodiscard]] inline unsigned processor_threads() {
  return std::max(std::thread::hardware_concurrency(), 1U);
}

}  // namespace splatray::testing

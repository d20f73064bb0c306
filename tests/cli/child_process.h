/// Programs run as their users run them, and what is expected of those that fail.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/temp_folder.h"

namespace splatray {

struct ChildResult {
  int code = 0;  ///< exit status; 128 + signal number when a signal ended it
  std::string out, err;
};

/// Under what a program runs. Each file it writes may have `most_bytes`, where not 0: a write beyond fails, as on a full disk.
/// Root has no leave to write where others may not with `bound_by_permissions`.
struct Limits {
  std::uint64_t most_bytes = 0;
  bool bound_by_permissions = false;
};

/// The environment that programs under test run in: this process's without leak checking, and further variables, NAME=VALUE.
/// To be called in the child.
void set_child_environment(const std::vector<std::string>& environment);

/// Runs a program to its end. `environment`: further variables, NAME=VALUE. `interrupt_when`: the program gets `signal` once
/// it catches that and this says so.
[[nodiscard]] ChildResult run_program(const std::vector<std::string>& command,
                                      const std::vector<std::string>& environment = {},
                                      const std::function<bool()>& interrupt_when = {}, int signal = SIGINT,
                                      const Limits& limits = {});

/// A test with a folder of its own, gone afterwards.
class CliTest : public ::testing::Test {
 protected:
  /// Path of a file in the folder.
  [[nodiscard]] std::string file(const std::string& name) const { return (folder / name).string(); }
  /// Writes a file into the folder; returns its path.
  std::string write(const std::string& name, const std::string& content) const;
  /// Names of the files in the folder, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

  /// Renders `arguments` to out.png, 16 x 16, one sample, on the CPU's kernels, which start in half the time of Vulkan's.
  [[nodiscard]] ChildResult render(std::vector<std::string> arguments,
                                   const std::vector<std::string>& environment = {}) const;
  [[nodiscard]] ChildResult preprocess(std::vector<std::string> arguments) const;

  /// Expects the exit code, one sentence on stderr that holds `words`, and no file made.
  template <typename Run>
  void expect_refused(Run run, int code, const std::string& words) const {
    const auto before = names();
    const ChildResult result = run();
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_NE(result.err.find(": error: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(names(), before);
  }

  const TempFolder own;
  const std::filesystem::path& folder = own.path();
};

/// ASCII PLY of points; each line of `vertices` holds x y z and, when `normals`, nx ny nz.
[[nodiscard]] std::string ascii_ply(const std::vector<std::string>& vertices, bool normals);
/// ASCII PLY of a 12 x 12 grid of points with normals, spacing `step`, at an offset on every axis.
[[nodiscard]] std::string grid_ply(bool normals, double offset = 0.0, double step = 0.1);

/// The same as splats of a model, as splatray writes them: with normals, radii and their lattice, where points alone are a scan.
[[nodiscard]] std::string splat_grid_ply(double offset = 0.0, double step = 0.1);

}  // namespace splatray

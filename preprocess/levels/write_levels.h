/// Scans of any size as an octree of files: Entwine point tiles (Hobu and Manning, 1.0, 2019) of binary records, in bounded memory.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// Which steps are made; each needs those before it. The second can be shared by several processes.
struct LevelSteps {
  bool divide = true;
  bool build = true;
  bool join = true;
  std::size_t share = 0, shares = 1;           ///< build: those parts whose number modulo `shares` is this
  std::uint64_t most_part_points = 4'000'000;  ///< what is built at once, in memory
};

/// Reads "divide", "2/16" (the second of 16 shares of the parts) or "join". Throws Error (usage).
[[nodiscard]] LevelSteps level_steps(const std::string& text);

struct LevelsMade {
  std::uint64_t points = 0;
  std::size_t parts = 0;
  std::size_t nodes = 0;  ///< 0 before they are joined
  std::vector<std::string> notes;
};

/// Whether a file is one that write_levels writes: it is called ept.json.
[[nodiscard]] bool is_levels_output(const std::filesystem::path& path);

/// Writes the points of scans as they are, with all that LAS and EPT have names for, as levels: `ept.json` with its folders beside it.
/// Where the scanners stood is kept, grids are not; nor are radii, ellipses, normal fields, clip lines and an up direction, which a note says.
/// Takes, beside one batch (point_batches.h), memory for some four million points a thread, unless more than that lie in a millionth of the
/// scan's places. What was interrupted or killed goes on where it was when it is
/// called again with the same inputs and options, and gives the same bytes. Throws Error (usage) where the folder holds an ept.json or
/// the making of another, (input_unreadable) as readers do, (failed) where a file cannot be written, (interrupted) as options.progress
/// says, called with the stages "counting", "dividing", "building" and "joining".
LevelsMade write_levels(const std::vector<std::filesystem::path>& inputs, const ReadOptions& options,
                        const LevelSteps& steps, const std::filesystem::path& ept_json);

}  // namespace splatray

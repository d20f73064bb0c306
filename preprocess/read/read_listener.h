/// What readers say while they read.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/progress.h"
#include "preprocess/points.h"

namespace splatray {

/// Hears of one file: how far it is read, and sentences about what is odd in it.
struct ReadListener {
  std::vector<std::string>& notes;
  const Progress& progress;  ///< may be empty
  double begin = 0.0;        ///< the file's part of all reading, as shares of it
  double end = 1.0;
  const PointsListener* points = nullptr;  ///< null: no one hears of the file's points
  std::size_t* seen = nullptr;             ///< how many of them were heard of

  void note(const std::filesystem::path& path, const std::string& sentence) const {
    notes.push_back(path.string() + ": " + sentence);
  }

  /// Reports the share of the file that is read; throws Error (interrupted) when the receiver asks to stop.
  void report(double share) const {
    if (progress && !progress("reading", begin + share * (end - begin)))
      throw Error(ExitCode::interrupted, "reading was interrupted");
  }

  /// Shows the points that the file has so far; those shown before are still the first.
  void show(const Points& so_far, bool measured = true, const glm::dvec3& up = {0.0, 0.0, 1.0}) const {
    if (points == nullptr || !*points || so_far.size() == 0) return;
    (*points)({so_far, *seen, measured, up});
    *seen = so_far.size();
  }

  /// The same for what reads the file from share `from` to share `to` of it.
  [[nodiscard]] ReadListener part(double from, double to) const {
    return {notes, progress, begin + from * (end - begin), begin + to * (end - begin), points, seen};
  }
};

}  // namespace splatray

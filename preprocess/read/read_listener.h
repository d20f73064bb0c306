/// What readers say while they read.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/progress.h"

namespace splatray {

/// Hears of one file: how far it is read, and sentences about what is odd in it.
struct ReadListener {
  std::vector<std::string>& notes;
  const Progress& progress;  ///< may be empty
  double begin = 0.0;        ///< the file's part of all reading, as shares of it
  double end = 1.0;

  void note(const std::filesystem::path& path, const std::string& sentence) const {
    notes.push_back(path.string() + ": " + sentence);
  }

  /// Reports the share of the file that is read; throws Error (interrupted) when the receiver asks to stop.
  void report(double share) const {
    if (progress && !progress("reading", begin + share * (end - begin)))
      throw Error(ExitCode::interrupted, "reading was interrupted");
  }

  /// The same for what reads the file from share `from` to share `to` of it.
  [[nodiscard]] ReadListener part(double from, double to) const {
    return {notes, progress, begin + from * (end - begin), begin + to * (end - begin)};
  }
};

}  // namespace splatray

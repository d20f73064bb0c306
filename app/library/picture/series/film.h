/// A film of a sequence's pictures, by ffmpeg where that is installed.
#pragma once
#include <vector>

#include "app/library/shot/sequence.h"

namespace splatray {

/// Throws Error (usage), one sentence, where a film is asked for and no program named ffmpeg is found in PATH.
void require_film_maker(const Request::Output& output);

/// The folder in which a film's pictures lie until it is made: there as long as this, and longer while it holds files.
class FilmFolder {
 public:
  /// Nothing where no film is asked for. Throws as require_film_maker.
  explicit FilmFolder(const Request::Output& output);
  FilmFolder(const FilmFolder&) = delete;
  FilmFolder& operator=(const FilmFolder&) = delete;
  ~FilmFolder();

 private:
  std::filesystem::path folder_;
};

/// Writes `output.film`, H.264 in the colours of BT.709, 25 pictures a second, of these PNG files in their order, and removes them.
/// It replaces an older film when it is whole. Throws Error (failed), one sentence, where ffmpeg fails: the pictures stay
/// then.
void write_film(const Request::Output& output, const std::vector<SequenceFrame>& frames);

}  // namespace splatray

/// Lines of numbers: the one tokenizer of all text formats of points.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/text/cell_form.h"
#include "preprocess/read/text/line_blocks.h"

namespace splatray {

/// Lines one after another, of equally many cells each.
struct RowRun {
  std::uint64_t first_line = 0;  ///< from 1, as editors count
  std::size_t width = 0;         ///< cells of a line, at least 1
  std::size_t rows = 0;
  /// Row after row; NaN: empty, skipped or not a number. Valid until the next call.
  const double* values = nullptr;
  bool open = false;  ///< one row without a line's end: all digits of a file, or what a cut has left of them

  [[nodiscard]] const double* row(std::size_t i) const { return values + i * width; }
};

/// Reads a text file block by block, each in parallel. Lines that are empty or begin with # or // are passed over.
class RowReader {
 public:
  /// Begins at `start`; throws as ByteReader does.
  RowReader(const std::filesystem::path& path, const ReadListener& listener, CellForm form,
            const TextPlace& start = {});

  /// The next lines; false at the end. Throws Error (input_unreadable) with the line of a cell that is no number, and
  /// (interrupted). A last line without its end that is no row like the one before is taken as cut off and left out.
  [[nodiscard]] bool next(RowRun& run);

  /// Throws Error (input_unreadable): "<path>: line <line>: <what>".
  [[noreturn]] void fail(std::uint64_t line, const std::string& what) const;

 private:
  struct Piece {
    struct Run {
      std::uint64_t line = 0;  ///< in the piece, from 0
      std::size_t width = 0;
      std::size_t rows = 0;
    };
    std::vector<double> values;
    std::vector<Run> runs;
    std::uint64_t lines = 0;
    std::string fault;  ///< what is wrong with line `lines`, where the piece ends then; empty = nothing
  };
  class PieceParser;

  [[nodiscard]] bool load();
  void parse(std::span<char> block);
  [[nodiscard]] std::size_t width_before() const;
  void judge_open_end();

  LineBlocks blocks_;
  CellForm form_;
  std::vector<Piece> pieces_;
  std::size_t piece_ = 0;  ///< the next run is run_ of this piece
  std::size_t run_ = 0;
  std::size_t value_ = 0;   ///< and its values begin here
  std::uint64_t line_ = 0;  ///< lines before the piece
  std::size_t width_ = 0;   ///< of the last run given
  bool open_ = false;       ///< the last run of the last piece is a line without an end
};

}  // namespace splatray

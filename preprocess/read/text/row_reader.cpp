#include "preprocess/read/text/row_reader.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::size_t PIECE_BYTES = std::size_t{128} << 10U;

}  // namespace

/// Parses the lines of one piece.
class RowReader::PieceParser {
 public:
  /// What the piece held is gone, but not its memory.
  PieceParser(const CellForm& form, Piece& piece) : form_(form), piece_(piece) {
    piece.values.clear();
    piece.runs.clear();
    piece.lines = 0;
    piece.fault.clear();
  }

  void parse(std::span<char> text) {
    if (form_.decimal_comma && form_.separator != ',') std::replace(text.begin(), text.end(), ',', '.');
    piece_.values.reserve(text.size() / 4);
    const char* const end = text.data() + text.size();
    for (const char* line = text.data(); line != end && piece_.fault.empty();) {
      const auto* found =
          static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end - line)));
      const char* const line_end = found == nullptr ? end : found;
      parse_line(line, line_end);
      line = found == nullptr ? end : found + 1;
    }
  }

 private:
  static const char* behind_blanks(const char* at, const char* end) {
    while (at != end && is_blank(*at)) ++at;
    return at;
  }

  void parse_line(const char* begin, const char* end) {
    const char* at = behind_blanks(begin, end);
    const bool comment = at != end && (*at == '#' || (*at == '/' && end - at > 1 && at[1] == '/'));
    if (at == end || comment) {
      ++piece_.lines;
      return;
    }
    const std::size_t before = piece_.values.size();
    if (form_.separator == ' ') {
      parse_words(at, end);
    } else {
      parse_cells(begin, end);
    }
    if (!piece_.fault.empty()) {
      piece_.values.resize(before);
      return;
    }
    end_row(piece_.values.size() - before);
  }

  void end_row(std::size_t width) {
    std::vector<Piece::Run>& runs = piece_.runs;
    if (!runs.empty() && runs.back().width == width && runs.back().line + runs.back().rows == piece_.lines) {
      ++runs.back().rows;
    } else {
      runs.push_back({piece_.lines, width, 1});
    }
    ++piece_.lines;
  }

  [[nodiscard]] bool is_skipped(std::size_t cell) const {
    return cell < form_.skipped.size() && form_.skipped[cell];
  }
  /// Whether the row ends before this cell, whatever the line has more.
  [[nodiscard]] bool is_beyond(std::size_t cell) const {
    return form_.has_more && cell >= form_.skipped.size();
  }

  static std::string_view text_of(const char* at, const char* end) {
    return {at, static_cast<std::size_t>(end - at)};
  }

  /// Cells with blanks between.
  void parse_words(const char* at, const char* end) {
    for (std::size_t cell = 0; at != end && !is_beyond(cell); ++cell) {
      double value = NAN;
      const char* rest = is_skipped(cell) ? std::find_if(at, end, is_blank) : parse_number(at, end, value);
      if (rest == nullptr || (rest != end && !is_blank(*rest))) {
        rest = std::find_if(at, end, is_blank);
        if (!parse_cell(text_of(at, rest), form_, value)) {
          piece_.fault = no_number(text_of(at, rest));
          return;
        }
      }
      piece_.values.push_back(value);
      at = behind_blanks(rest, end);
    }
  }

  /// Cells with a separator between.
  void parse_cells(const char* at, const char* end) {
    for (std::size_t cell = 0; !is_beyond(cell); ++cell) {
      double value = NAN;
      const char* rest = nullptr;
      if (!is_skipped(cell)) {
        at = behind_blanks(at, end);
        rest = at == end ? end : parse_number(at, end, value);
        rest = rest == nullptr ? nullptr : behind_blanks(rest, end);
      }
      if (rest == nullptr || (rest != end && *rest != form_.separator)) {
        rest = end_of_cell(at, end, form_.separator);
        if (!is_skipped(cell) && !parse_cell(text_of(at, rest), form_, value)) {
          piece_.fault = no_number(text_of(at, rest));
          return;
        }
      }
      piece_.values.push_back(value);
      if (rest == end) return;
      at = rest + 1;
    }
  }

  const CellForm& form_;
  Piece& piece_;
};

RowReader::RowReader(const std::filesystem::path& path, const ReadListener& listener, CellForm form,
                     const TextPlace& start)
    : blocks_(path, listener, start), form_(std::move(form)), line_(start.lines) {}

void RowReader::fail(std::uint64_t line, const std::string& what) const {
  throw_unreadable(blocks_.path(), "line " + std::to_string(line) + ": " + what);
}

void RowReader::parse(std::span<char> block) {
  std::vector<std::span<char>> texts;
  while (!block.empty()) {
    std::size_t bytes = block.size();
    if (bytes > PIECE_BYTES) {
      const auto end = std::find(block.begin() + PIECE_BYTES, block.end(), '\n');
      bytes = static_cast<std::size_t>(end - block.begin()) + (end == block.end() ? 0 : 1);
    }
    texts.push_back(block.first(bytes));
    block = block.subspan(bytes);
  }
  pieces_.resize(texts.size());
  tbb::parallel_for(std::size_t{0}, texts.size(),
                    [&](std::size_t i) { PieceParser(form_, pieces_[i]).parse(texts[i]); });
}

/// Cells of the row before those of the last piece's last run; 0 = there is none.
std::size_t RowReader::width_before() const {
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece)
    if (!piece->runs.empty()) return piece->runs.back().width;
  return width_;
}

/// Sets the last line apart, and drops it where it is no row like the one before.
void RowReader::judge_open_end() {
  Piece& piece = pieces_.back();
  if (!piece.fault.empty()) {
    piece.fault.clear();
  } else if (!piece.runs.empty()) {
    const Piece::Run last = piece.runs.back();
    piece.runs.back().rows -= 1;
    if (last.rows == 1) piece.runs.pop_back();
    open_ = last.rows > 1 || last.width >= width_before();
    if (open_) piece.runs.push_back({last.line + last.rows - 1, last.width, 1});
  }
}

bool RowReader::load() {
  const std::span<char> block = blocks_.next();
  if (block.empty()) return false;
  parse(block);
  const auto whole = [](const Piece& piece) { return piece.fault.empty(); };
  if (block.back() != '\n' && std::all_of(pieces_.begin(), pieces_.end() - 1, whole)) judge_open_end();
  piece_ = run_ = value_ = 0;
  return true;
}

bool RowReader::next(RowRun& run) {
  for (;;) {
    if (piece_ == pieces_.size()) {
      if (!load()) return false;
      continue;
    }
    const Piece& piece = pieces_[piece_];
    if (run_ < piece.runs.size()) {
      const Piece::Run& found = piece.runs[run_];
      const bool last = piece_ + 1 == pieces_.size() && run_ + 1 == piece.runs.size();
      run = {line_ + found.line + 1, found.width, found.rows, piece.values.data() + value_, open_ && last};
      value_ += found.width * found.rows;
      width_ = found.width;
      ++run_;
      return true;
    }
    if (!piece.fault.empty()) fail(line_ + piece.lines + 1, piece.fault);
    line_ += piece.lines;
    ++piece_;
    run_ = value_ = 0;
  }
}

}  // namespace splatray

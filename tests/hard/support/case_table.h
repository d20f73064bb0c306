/// The table of hard cases. Tests add rows while they run; the program writes them down at its end.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace splatray::testing {

/// What one comparison of a hard case found.
struct CaseRow {
  std::string compared;          ///< what with what, words of a table cell
  std::uint64_t count = 0;       ///< rays, pixels, ... compared
  std::string unit = "rays";     ///< what `count` counts
  std::uint64_t exceptions = 0;  ///< of them, those that differ from the truth
  std::uint64_t lost = 0;        ///< rays stopped by the iteration cap (COUNT_LOST)
  std::uint64_t non_finite = 0;  ///< answers or pixels with NaN or infinity
  std::string remark = {};       ///< numbers worth knowing; nothing that changes from run to run

  /// Adds the counts of another row.
  CaseRow& operator+=(const CaseRow& more) {
    count += more.count;
    exceptions += more.exceptions;
    lost += more.lost;
    non_finite += more.non_finite;
    return *this;
  }
};

/// Adds a row for the running test and expects that something was compared, that lost rays, non-finite answers and exceptions
/// are 0.
void conclude(const CaseRow& row);

/// Likewise where no exceptions are asked for and some are known: at most `known` of them, the number measured, so that it can
/// only get better. The row says that the bound is missed.
void conclude_missed(const CaseRow& row, std::uint64_t known);

/// Adds a row for the running test whose exceptions are expected, and more than 0: what the paper says fails,
/// or a comparison that must notice a change. Lost rays and non-finite answers must be 0 all the same.
void conclude_failing(const CaseRow& row);

/// Adds a row of a measurement for which nothing is asked: at most `known` exceptions, the number measured.
void note(const CaseRow& row, std::uint64_t known);

/// Writes the rows of all tests that ran, in the order of the program, as a Markdown document that starts with
/// `heading`. Throws Error (failed) when the file cannot be written.
void write_table(const std::filesystem::path& path, const std::string& heading);

/// A number in `digits` significant digits.
[[nodiscard]] std::string short_number(double value, int digits = 3);

}  // namespace splatray::testing

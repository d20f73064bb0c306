#include "tests/hard/support/case_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "engine/base/error.h"

namespace splatray::testing {
namespace {

struct JudgedRow {
  CaseRow row;
  std::string verdict;
};

/// Rows by the full name of their test.
std::map<std::string, std::vector<JudgedRow>>& all_rows() {
  static std::map<std::string, std::vector<JudgedRow>> rows;
  return rows;
}

std::string name_of(const ::testing::TestInfo& test) {
  return std::string(test.test_suite_name()) + "." + test.name();
}

void write_rows(std::ostream& out, const ::testing::TestInfo& test) {
  const std::string name = name_of(test);
  if (test.result()->Skipped()) {
    out << "| " << name << " | skipped: " << test.result()->GetTestPartResult(0).message()
        << " | | | | | | |\n";
    return;
  }
  for (const auto& [row, verdict] : all_rows()[name]) {
    out << "| " << name << " | " << row.compared << " | " << row.count << " " << row.unit << " | "
        << row.exceptions << " | " << row.lost << " | " << row.non_finite << " | " << verdict << " | "
        << row.remark << " |\n";
  }
}

void add_row(const CaseRow& row, bool as_expected, const std::string& verdict) {
  EXPECT_TRUE(as_expected) << row.compared << ": " << row.exceptions << " exceptions; " << row.remark;
  EXPECT_GT(row.count, 0U) << row.compared << ": nothing was compared";
  EXPECT_EQ(row.lost, 0U) << row.compared;
  EXPECT_EQ(row.non_finite, 0U) << row.compared;
  std::cout << row.compared << ": " << row.count << " " << row.unit << ", " << row.exceptions
            << " exceptions, " << row.lost << " lost, " << row.non_finite << " non-finite; " << row.remark
            << '\n';
  const bool sound = as_expected && row.count > 0 && row.lost == 0 && row.non_finite == 0;
  all_rows()[name_of(*::testing::UnitTest::GetInstance()->current_test_info())].push_back(
      {row, sound ? verdict : "**fails**"});
}

}  // namespace

void conclude(const CaseRow& row) { add_row(row, row.exceptions == 0, "pass"); }

void conclude_missed(const CaseRow& row, std::uint64_t known) {
  const double per_million = 1e6 * static_cast<double>(row.exceptions) / static_cast<double>(row.count);
  add_row(
      row, row.exceptions <= known,
      row.exceptions == 0 ? "pass" : "**MISSED**: " + short_number(per_million) + " per million, 0 asked");
}

void conclude_failing(const CaseRow& row) { add_row(row, row.exceptions > 0, "differs, as it must"); }

void note(const CaseRow& row, std::uint64_t known) { add_row(row, row.exceptions <= known, "measured"); }

void write_table(const std::filesystem::path& path, const std::string& heading) {
  std::ofstream file(path);
  file << heading << "\n| case | compared | of | exceptions | lost | non-finite | verdict | remarks |\n"
       << "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  const ::testing::UnitTest& unit = *::testing::UnitTest::GetInstance();
  for (int suite = 0; suite < unit.total_test_suite_count(); ++suite) {
    const ::testing::TestSuite& tests = *unit.GetTestSuite(suite);
    for (int test = 0; test < tests.total_test_count(); ++test)
      if (tests.GetTestInfo(test)->should_run()) write_rows(file, *tests.GetTestInfo(test));
  }
  file.close();
  if (!file) throw Error(ExitCode::failed, path.string() + ": cannot be written");
}

std::string short_number(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

}  // namespace splatray::testing

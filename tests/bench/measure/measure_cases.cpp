#include "tests/bench/measure/measure_cases.h"

#include <cstdio>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"

namespace splatray::testing {
namespace {

/// Adds the case's records; what became of it.
std::string add_case(const Case& one, const std::filesystem::path& prepared, const CaseMeasure& measure,
                     Json& records) {
  if (!std::filesystem::exists(prepared / "case.json")) return "left out, it was not prepared";
  try {
    for (const Json& record : measure(one, prepared)) records.push_back(record);
  } catch (const Error& error) {
    if (error.code() != ExitCode::out_of_memory) throw;
    return std::string("left out, ") + error.what();
  }
  return "measured";
}

}  // namespace

std::vector<Case> named(std::vector<Case> cases, const std::string& name) {
  std::erase_if(cases, [&](const Case& one) { return !name.empty() && one.name != name; });
  return cases;
}

void measure_cases(const std::vector<Case>& cases, const std::filesystem::path& folder,
                   const std::filesystem::path& output, const CaseMeasure& measure) {
  Json records = Json::array();
  for (const Case& one : cases) {
    const std::string outcome = add_case(one, folder / folder_name(one), measure, records);
    std::printf("%s: %s\n", one.name.c_str(), outcome.c_str());
    std::fflush(stdout);
  }
  write_text_file(records.dump(1) + '\n', output);
}

}  // namespace splatray::testing

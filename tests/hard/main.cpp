// hard_test [GoogleTest options] [--table FILE]: the hard cases. With --table the rows that the tests add are
// written to FILE when all have run.
#include <gtest/gtest.h>

#include <cstring>

#include "app/library/commit.h"
#include "engine/base/error.h"
#include "tests/hard/support/case_table.h"
#include "tests/hard/support/device_scene.h"

namespace splatray::testing {
namespace {

/// No test may leave a message of the validation layers behind.
class NoValidationMessages : public ::testing::Environment {
 public:
  void TearDown() override { EXPECT_EQ(shared_device().validation_messages(), 0U); }
};

std::string heading() {
  return "# Hard cases\n\nMade by `SPLATRAY_HARD_RAYS=" + std::to_string(hard_rays()) +
         " hard_test --table FILE` on " + shared_device().info().name + " (" + shared_device().info().driver +
         "), of commit " + COMMIT +
         ".\nEach row is one comparison of a test of `tests/hard`; exceptions, lost rays and non-finite "
         "answers "
         "must be 0 but where the row says that it shows a failure.\n";
}

int run(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const bool table = argc == 3 && std::strcmp(argv[1], "--table") == 0;
  if (argc > 1 && !table)
    throw Error(ExitCode::usage, std::string("found '") + argv[1] + "', expected --table FILE");
  ::testing::AddGlobalTestEnvironment(new NoValidationMessages);
  const int result = RUN_ALL_TESTS();
  if (table) write_table(argv[2], heading());
  return result;
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("hard_test", splatray::testing::run, argc, argv);
}

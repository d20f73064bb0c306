#include "engine/file/atomic_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  }

  const TempFolder own;
  const fs::path& folder = own.path();
};

TEST_F(AtomicFileTest, UncommittedLeavesNothing) {
  {
    const AtomicFile file(folder / "a");
    EXPECT_TRUE(fs::exists(file.temporary()));
    EXPECT_FALSE(fs::exists(folder / "a"));
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFileTest, CommittedReplacesOlder) {
  std::ofstream(folder / "a") << "old";
  AtomicFile file(folder / "a");
  std::ofstream(file.temporary()) << "new";
  file.commit();
  std::string text;
  std::ifstream(folder / "a") >> text;
  EXPECT_EQ(text, "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, WritesThroughLinks) {
  std::ofstream(folder / "a") << "old";
  fs::create_symlink("a", folder / "link");
  AtomicFile(folder / "link").commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(fs::file_size(folder / "a"), 0U);
}

TEST_F(AtomicFileTest, RefusesPlacesThatCannotBeWritten) {
  EXPECT_THROW(require_writable(folder / "missing" / "a"), Error);
  EXPECT_THROW(require_writable(folder), Error);
  EXPECT_THROW(require_writable("/dev/null"), Error);
  EXPECT_NO_THROW(require_writable(folder / "a"));
  EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace splatray

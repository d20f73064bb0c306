#include "engine/file/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

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

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream file(folder / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const TempFolder own;
  const fs::path& folder = own.path();
};

TEST_F(AtomicFileTest, UncommittedLeavesNothing) {
  {
    AtomicFile file(folder / "a");
    file.write("new", 3);
    EXPECT_EQ(files(), 1);
    EXPECT_FALSE(fs::exists(folder / "a"));
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(AtomicFileTest, CommittedReplacesOlder) {
  std::ofstream(folder / "a") << "old";
  AtomicFile file(folder / "a");
  file.write("new", 3);
  EXPECT_EQ(text_of("a"), "old");
  file.commit();
  EXPECT_EQ(text_of("a"), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, TwoWritersOfOneFileAtOnce) {
  AtomicFile first(folder / "a"), second(folder / "a");
  first.write("first", 5);
  second.write("another", 7);
  first.commit();
  EXPECT_EQ(text_of("a"), "first");
  second.commit();
  EXPECT_EQ(text_of("a"), "another");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, NamesAsLongAsTheFolderTakes) {
  const std::string name(255, 'n');
  write_text_file("text", folder / name);
  EXPECT_EQ(text_of(name), "text");
}

TEST_F(AtomicFileTest, FollowsNoLinkOfTheTemporaryFilesName) {
  std::ofstream(folder / "victim") << "victim";
  fs::create_symlink("victim", folder / ("a." + std::to_string(getpid()) + ".tmp"));
  write_text_file("text", folder / "a");
  EXPECT_EQ(text_of("victim"), "victim");
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

#include "engine/file/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>

#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
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

TEST_F(AtomicFileTest, TemporaryNamesAreNew) {
  // A link can only be put where a name is known before: and each is another.
  std::set<std::string> names;
  for (int i = 0; i < 100; ++i) {
    const AtomicFile file(folder / "a");
    names.insert(fs::directory_iterator(folder)->path().filename());
  }
  EXPECT_EQ(names.size(), 100U);
}

TEST_F(AtomicFileTest, LinksToNoFileAreKept) {
  fs::create_symlink("nowhere", folder / "a");
  fs::create_symlink("a", folder / "b");
  for (const char* name : {"a", "b"}) {
    try {
      require_writable(folder / name);
      ADD_FAILURE() << name << " would be replaced";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::failed);
      EXPECT_NE(std::string(error.what()).find("it exists and is not a regular file"), std::string::npos);
    }
    EXPECT_TRUE(fs::is_symlink(folder / name));
  }
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFileTest, FilesThatNobodyNamedReplaceNoLink) {
  std::ofstream(folder / "victim") << "victim";
  fs::create_symlink("victim", folder / "a");
  fs::create_symlink("nowhere", folder / "b");
  for (const char* name : {"a", "b"})
    EXPECT_THROW(write_text_file("text", folder / name, Links::refuse), Error);
  EXPECT_EQ(text_of("victim"), "victim");
  EXPECT_TRUE(fs::is_symlink(folder / "a") && fs::is_symlink(folder / "b"));
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
  EXPECT_EQ(files(), 3);
}

/// Runs body() in a child that then waits to be killed; returns it once body is done.
template <typename Body>
pid_t start_child(const Body& body) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    body();
    (void)!write(ends[1], "x", 1);
    for (;;) pause();
  }
  char done = 0;
  EXPECT_EQ(read(ends[0], &done, 1), 1);
  close(ends[0]);
  close(ends[1]);
  return child;
}

void kill_child(pid_t child) {
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST_F(AtomicFileTest, TheNextWriterRemovesWhatAKilledOneLeft) {
  const auto begin_file = [&] { (new AtomicFile(folder / "a"))->write("half", 4); };
  const pid_t dead = start_child(begin_file), living = start_child(begin_file);
  EXPECT_EQ(files(), 2);
  kill_child(dead);
  std::ofstream(folder / ".splatray-mine.tmp") << "of the user";
  fs::create_symlink(".splatray-mine.tmp", folder / ".splatray-0123456789abcdef.tmp");
  write_text_file("text", folder / "b");
  EXPECT_EQ(files(), 4)
      << "the dead one's file is gone; the living one's, the user's, the link and b are there";
  EXPECT_EQ(text_of(".splatray-mine.tmp"), "of the user");
  kill_child(living);
}

TEST_F(AtomicFileTest, ALockedFileIsCommittedWhileOthersClean) {
  const pid_t child = start_child([&] {
    AtomicFile file(folder / "a");
    file.write("text", 4);
    const pid_t other = start_child([&] { write_text_file("text", folder / "b"); });
    file.commit();
    kill_child(other);
  });
  EXPECT_EQ(text_of("a"), "text");
  EXPECT_EQ(text_of("b"), "text");
  kill_child(child);
}

TEST_F(AtomicFileTest, FilesThatBelongTogetherAreThereTogetherOrNotAtAll) {
  {
    FileSet set;
    set.add(folder / "a", "text");
    EXPECT_THROW(set.add(folder / "missing" / "b", "text"), Error);
  }
  EXPECT_EQ(files(), 0);
  FileSet set;
  set.add(folder / "a", "text");
  set.add(folder / "b", "another");
  EXPECT_FALSE(fs::exists(folder / "a"));
  set.commit();
  EXPECT_EQ(text_of("a") + text_of("b"), "textanother");
  EXPECT_EQ(files(), 2);
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

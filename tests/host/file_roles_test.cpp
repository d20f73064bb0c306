#include "engine/file/file_roles.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// The list is the process's: each test has files of its own.
class FileRoles : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path there(const std::string& name) const { return folder.write(name, "text"); }
  [[nodiscard]] fs::path absent(const std::string& name) const { return folder.path() / name; }

  const TempFolder folder;
};

template <typename Call>
void expect_refused(const Call& call, const std::string& words) {
  try {
    call();
    FAIL() << "not refused, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST_F(FileRoles, AnOutputIsNoInputByAnyName) {
  const fs::path file = there("a");
  fs::create_symlink("a", folder.path() / "symbolic");
  fs::create_hard_link(file, folder.path() / "hard");
  fs::create_directory(folder.path() / "below");
  note_input(file);
  for (const char* name : {"a", "./a", "below/../a", "symbolic", "hard"})
    expect_refused([&] { claim_output(folder.path() / name); }, "which is the input '" + file.string() + "'");
  expect_refused([&] { claim_output("/" + file.string()); }, "which is the input");
  EXPECT_NO_THROW(claim_output(absent("b")));
}

TEST_F(FileRoles, AnInputThatIsReadLaterIsNoOutput) {
  const fs::path file = there("a");
  fs::create_hard_link(file, folder.path() / "hard");
  claim_output(file);
  expect_refused([&] { note_input(folder.path() / "hard"); }, "found the output '" + file.string() + "'");
  EXPECT_NO_THROW(note_input(there("b")));
}

TEST_F(FileRoles, EachOutputIsAFileOfItsOwn) {
  claim_output(absent("new"));
  expect_refused([&] { claim_output(folder.path() / "." / "new"); }, "which are one file");
  fs::create_symlink(folder.path(), folder.path() / "here");
  expect_refused([&] { claim_output(folder.path() / "here" / "new"); }, "which are one file");
  claim_output(there("old"));
  fs::create_symlink("old", folder.path() / "link");
  expect_refused([&] { claim_output(folder.path() / "link"); }, "which are one file");
  fs::create_hard_link(folder.path() / "old", folder.path() / "hard");
  EXPECT_NO_THROW(claim_output(folder.path() / "hard")) << "a new file takes its place, the other stays";
}

TEST_F(FileRoles, AFileThatTookTheNumberOfOneThatIsGoneIsAnother) {
  for (int i = 0; i < 20; ++i) {  // file systems give a free number to the next file
    const fs::path file = there("a" + std::to_string(i));
    note_input(file);
    fs::remove(file);
    EXPECT_NO_THROW(claim_output(there("b" + std::to_string(i))));
  }
}

TEST_F(FileRoles, ReadingTwiceAndFoldersAreNoMatter) {
  const fs::path file = there("a");
  note_input(file);
  note_input(file);
  note_input(folder.path());
  note_input(absent("none"));
  note_input("");
  EXPECT_NO_THROW(claim_output(absent("none")));
}

}  // namespace
}  // namespace splatray

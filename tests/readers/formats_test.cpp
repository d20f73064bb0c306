/// The table of formats is what the readers do and what app/guide/formats.md says.
#include "preprocess/read/formats.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

std::vector<std::string> split(std::string_view text) {
  std::istringstream words{std::string(text)};
  return {std::istream_iterator<std::string>(words), {}};
}

TEST(Formats, GuidesTableHasEveryRow) {
  std::ifstream file(FORMATS_PAGE);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const Format& format : formats()) {
    std::string row = "|";
    for (const std::string& extension : split(format.extensions)) row += " `" + extension + "`";
    row += " | " + std::string(format.contents) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << "expected in app/guide/formats.md: " << row;
  }
}

TEST(Formats, EveryExtensionHasOneReaderThatRefusesWhatIsNoSuchFile) {
  const TempFolder folder;
  for (const Format& format : formats()) {
    EXPECT_EQ((format.read_mesh != nullptr) + (format.read_scene != nullptr) + (format.read_scan != nullptr) +
                  (format.read_list != nullptr),
              1)
        << format.extensions;
    for (const std::string& extension : split(format.extensions)) {
      const bool is_name = extension.front() != '.';  // of a file that is always called so
      const auto named = [&](const std::string& stem) { return is_name ? extension : stem + extension; };
      EXPECT_EQ(find_format(named("A")), &format);
      static_cast<void>(read_error(folder.path() / "missing" / named("a")));
      static_cast<void>(read_error(folder.write("empty/" + named("a"), "")));
      static_cast<void>(read_error(folder.write("noise/" + named("a"), "no such file at all\n")));
      std::string upper = extension;
      std::transform(upper.begin(), upper.end(), upper.begin(),
                     [](char c) { return static_cast<char>(std::toupper(c)); });
      EXPECT_EQ(find_format(is_name ? upper : "a" + upper), &format);
    }
  }
}

TEST(Formats, ArchivesAndWebPagesAreNamed) {
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& bytes) {
    return read_error(folder.write(name, bytes + std::string(300, '\0')));
  };
  for (const char* name :
       {"a.xyz.gz", "a.xyz", "a.las", "a.e57", "a.ply", "a.vtp", "a.gltf", "a.pcd", "a.obj", "a.stl"}) {
    EXPECT_NE(
        error(name, "\x1F\x8B\x08").find("packed by gzip, expected what is in it: unpack it with gunzip"),
        std::string::npos)
        << name;
    EXPECT_NE(error(name, "PK\x03\x04").find("found a ZIP archive or an office document"), std::string::npos)
        << name;
    EXPECT_NE(error(name, "<!DOCTYPE html><html>").find("found a web page"), std::string::npos) << name;
  }
}

TEST(Formats, RefusalsListTheTable) {
  const TempFolder folder;
  EXPECT_NE(read_error(folder.write("a.abc", "1 2 3")).find(format_extensions()), std::string::npos);
  EXPECT_EQ(find_format("a"), nullptr);
  EXPECT_EQ(find_format("a.pl"), nullptr);
  EXPECT_EQ(find_format("a.json"), nullptr);
  EXPECT_EQ(find_format("https://host/a.laz?b=c.ply#d.obj"), find_format("a.LAZ"));
}

TEST(Formats, OfVtksHdfItIsSaidWhatToDoInstead) {
  const TempFolder folder;
  for (const char* name : {"a.vtkhdf", "A.VTKHDF"}) {
    const std::string error = read_error(folder.write(name, "\x89HDF\r\n\x1a\n"));
    EXPECT_NE(error.find("HDF format, which is not read, expected the same data as .vtp or .vtu"),
              std::string::npos)
        << error;
  }
  EXPECT_NE(read_error(folder.path() / "missing.vtkhdf").find("no such file"), std::string::npos);
}

}  // namespace
}  // namespace splatray

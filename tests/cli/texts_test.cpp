/// Texts in Latin-1 come through every door and reach files as UTF-8.
#include <fstream>
#include <iterator>

#include "engine/base/utf8.h"
#include "tests/cli/child_process.h"
#include "tests/readers/las_file.h"

namespace splatray {
namespace {

class CliTexts : public CliTest {
 protected:
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream stream(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Expects that a sheet is drawn, and that every file of text beside it is UTF-8.
  void expect_sheet(std::vector<std::string> arguments) const {
    for (const char* output : {"out.svg", "out.pdf", "out.png", "out.tif"}) {
      std::vector<std::string> command = {
          RENDER, "--quiet",    "--device=cpu", "--samples=1",     "--sheet=plan:scale=50,dpi=20",
          "-o",   file(output), "--stats-json", file("stats.json")};
      command.insert(command.end(), arguments.begin(), arguments.end());
      const ChildResult result = run_program(command);
      EXPECT_EQ(result.code, 0) << result.err;
      EXPECT_TRUE(is_utf8(result.err)) << result.err;
      EXPECT_TRUE(std::filesystem::exists(folder / output));
    }
    for (const std::string& name : names())
      if (name.ends_with(".svg") || name.ends_with(".json") || name.ends_with(".aux.xml")) {
        EXPECT_FALSE(content(name).empty()) << name;
        EXPECT_TRUE(is_utf8(content(name))) << name;
      }
  }
};

TEST_F(CliTexts, FilesAndTitlesInLatin1) {
  const std::string grid = write(
      "stra\xDF"
      "e.ply",
      grid_ply(true));
  expect_sheet({grid});
  expect_sheet({grid,
                "--title=Gr\xFC\xDF"
                "e"});
  const ChildResult made =
      run_program({PREPROCESS, grid, "-o", file("scene.soct"), "--stats-json", file("build.json")});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(is_utf8(content("build.json")));
  expect_sheet({file("scene.soct"),
                "--object=stra\xDF"
                "e:diffuse=0.1/0.2/0.3"});
}

TEST_F(CliTexts, SystemsAndAttributesInLatin1) {
  LasFile file_of_points;
  for (std::int32_t i = 0; i < 400; ++i)
    file_of_points.records.push_back(las_point(50 * (i % 20), 50 * (i / 20), i % 3));
  std::string descriptor(192, '\0');
  descriptor[2] = 1;
  descriptor.replace(4, 4, "H\xF6he");
  file_of_points.extra_bytes = 1;
  for (std::size_t i = 0; i < file_of_points.records.size(); ++i)
    file_of_points.records[i].extra = std::string(1, static_cast<char>(i % 100));
  file_of_points.vlrs = {las_vlr("LASF_Spec", 4, descriptor),
                         las_vlr("LASF_Projection", 2112, "PROJCS[\"Gau\xDF-Kr\xFCger\",UNIT[\"metre\",1]]")};
  const std::string las = write("a.las", file_of_points.bytes());
  for (const std::string name : {"H\xF6he", "H\xC3\xB6he"})
    expect_sheet({las, "--attributes=" + name, "--color-by=" + name});
}

}  // namespace
}  // namespace splatray

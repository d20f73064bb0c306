/// Command lines: nonsense ends in exit code 2 and one sentence, before any work.
#include <cmath>
#include <numbers>

#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliOptions : public CliTest {};

TEST_F(CliOptions, NonsenseIsRefused) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const std::vector<std::vector<std::string>> command_lines = {{"--resolution=0x5"},
                                                               {"--resolution=1920"},
                                                               {"--resolution=axb"},
                                                               {"--resolution=-4x4"},
                                                               {"--resolution=99999x1"},
                                                               {"--samples=0"},
                                                               {"--samples=-1"},
                                                               {"--samples=many"},
                                                               {"--samples=1e99"},
                                                               {"--samples=1.5"},
                                                               {"--seed=-1"},
                                                               {"--eye=1,2"},
                                                               {"--eye=1,2,3,4"},
                                                               {"--eye=1,2,x"},
                                                               {"--eye=nan,0,0"},
                                                               {"--eye=1,2,3,"},
                                                               {"--eye="},
                                                               {"--target=0,0,0"},
                                                               {"--ortho-height=3"},
                                                               {"--fov=0"},
                                                               {"--fov=180"},
                                                               {"--fov=wide"},
                                                               {"--light=1"},
                                                               {"--light=1,2,3,4"},
                                                               {"--light=1,2,3,-1,0,0"},
                                                               {"--sun=0,0,0"},
                                                               {"--lights=some"},
                                                               {"--camera-up=0,1,0"},
                                                               {"--object=grid"},
                                                               {"--object=grid:glow=1"},
                                                               {"--object=absent:hidden=on"},
                                                               {"--environment=-1,0,0"},
                                                               {"--bounces=65"},
                                                               {"--shadows=maybe"},
                                                               {"--blend=soft"},
                                                               {"--side=left"},
                                                               {"--order=random"},
                                                               {"--kappa=0"},
                                                               {"--error=0"},
                                                               {"--time=0"},
                                                               {"--focus=0"},
                                                               {"--ao-radius=0"},
                                                               {"--delta=-1"},
                                                               {"--material=wood"},
                                                               {"--insertion=some"},
                                                               {"--leaf-size=65537"},
                                                               {"--radius-rule=big"},
                                                               {"--radius-scale=0"},
                                                               {"--aov=depth"},
                                                               {"--aov=colour", "-o", file("a.exr")},
                                                               {"--no-such-option"},
                                                               {"--reference-limit=2"},
                                                               {"--exposure=inf"}};
  for (const auto& arguments : command_lines) {
    std::vector<std::string> command = {RENDER, "--quiet", grid};
    if (arguments.size() < 3) command.insert(command.end(), {"-o", file("out.png")});
    command.insert(command.end(), arguments.begin(), arguments.end());
    SCOPED_TRACE(arguments.front());
    // The sentence names the option that is wrong.
    const std::string& wrong = arguments.front();
    expect_refused([&] { return run_program(command); }, 2, wrong.substr(0, wrong.find('=')));
  }
}

TEST_F(CliOptions, MissingPartsAreRefused) {
  const std::string grid = write("grid.ply", grid_ply(true));
  expect_refused([&] { return render({grid, "--eye=1,2,3", "--target=1,2,3"}); }, 2, "eye is its target");
  expect_refused([&] { return render({grid, "--eye=9,9,9", "--up=0,0,0"}); }, 2, "--up");
  expect_refused([&] { return run_program({RENDER}); }, 2, "no SCENE");
  expect_refused([&] { return render({grid, "--denoise", "--samples=1"}); }, 2, "--denoise with one sample");
  expect_refused(
      [&] {
        return render({grid, "--denoise", "--samples=2", "--look=paper"});
      },
      2, "--denoise with --look paper");
  expect_refused(
      [&] {
        return render({grid, "--denoise", "--samples=2", "--reference=x.png"});
      },
      2, "--denoise and --reference, expected one of them");
  expect_refused([&] { return run_program({RENDER, grid}); }, 2, "no output");
  expect_refused([&] { return run_program({RENDER, grid, "-o", file("a.gif")}); }, 2, ".webp or .exr");
  expect_refused([&] { return run_program({RENDER, grid, "-o", file("a")}); }, 2, ".webp or .exr");
  expect_refused([&] { return run_program({RENDER, grid, "a.soct", "-o", file("a.png")}); }, 2, ".soct");
  expect_refused([&] { return run_program({PREPROCESS}); }, 2, "found no INPUT, expected at least one");
  expect_refused([&] { return run_program({PREPROCESS, grid}); }, 2, "found no --output, expected -o FILE");
  expect_refused([&] { return preprocess({grid, "--leaf-size=65537"}); }, 2, "--leaf-size");
  expect_refused([&] { return preprocess({grid, "--insertion=some"}); }, 2, "--insertion");
  expect_refused([&] { return preprocess({grid, "--no-such-option"}); }, 2, "--no-such-option");
}

TEST_F(CliOptions, NegativeVectorsParse) {
  const std::string grid = write("grid.ply", grid_ply(true));
  EXPECT_EQ(render({grid, "--eye=-1,2,3"}).code, 0);
  EXPECT_EQ(render({grid, "--eye", "-1,2,3", "--target", "-.5,-1e-3,+0"}).code, 0);
  EXPECT_EQ(render({grid, "--eye=0.5,9,0.5", "--target=0.5,0,0.5"}).code, 0)
      << "straight down, up chosen across";
}

TEST_F(CliOptions, EmptyValuesAreEmpty) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const std::string sheet = "--sheet=plan:scale=50,dpi=20";
  const ChildResult named = run_program(
      {RENDER, grid, "--device=cpu", "--samples=1", "--quiet", sheet, "--title=", "-o", file("a.svg")});
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.svg"))) << "-o is no title";
  expect_refused([&] { return render({"--eye=", grid}); }, 2, "--eye");
  expect_refused([&] { return preprocess({"--columns=", "--output=", grid}); }, 2, "found output ''");
}

TEST_F(CliOptions, MeasuresTakeAnUpDirection) {
  std::string points = "x,y,z\n";
  for (int i = 0; i < 400; ++i) points += std::to_string(i % 20) + ',' + std::to_string(i / 20) + ",5\n";
  const std::string scan = write("scan.csv", points);
  const auto vertical = [&](const std::string& up) {
    const ChildResult result =
        run_program({MEASURE, scan, "--unit=m", "--vertical=2,3,5;12,7,5", "--up=" + up});
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out;
  };
  EXPECT_NE(vertical("1,0,0").find("vertical\tvertical\t10.0"), std::string::npos) << vertical("1,0,0");
  EXPECT_NE(vertical("0,1,0").find("vertical\tvertical\t4.0"), std::string::npos) << vertical("0,1,0");
}

TEST_F(CliOptions, NotesNameOptionsThatAreThere) {
  std::string cone = "v 0 0 2\nv 0 0 0\n";
  constexpr int SIDES = 40;
  for (int i = 0; i < SIDES; ++i)
    cone += "v " + std::to_string(std::cos(0.05 * std::numbers::pi * i)) + ' ' +
            std::to_string(std::sin(0.05 * std::numbers::pi * i)) + " 0\n";
  for (int i = 0; i < SIDES; ++i) {
    const std::string from = std::to_string(3 + i), to = std::to_string(3 + (i + 1) % SIDES);
    cone += "f 1 " + from + ' ' + to + "\nf 2 " + to + ' ' + from + '\n';
  }
  const std::string path = write("cone.obj", cone);
  const std::string made = preprocess({path, "--mesh-points=2000"}).err;
  EXPECT_NE(made.find("up is 0,0,1"), std::string::npos) << made;
  EXPECT_EQ(made.find("--up"), std::string::npos) << made;
  const std::string measured = run_program({MEASURE, path, "--mesh-points=2000", "--point=0,0,0"}).err;
  EXPECT_NE(measured.find("--up=X,Y,Z says otherwise"), std::string::npos) << measured;
}

TEST_F(CliOptions, HelpAndVersion) {
  for (const char* option : {"--help", "--version"}) {
    const ChildResult result = run_program({RENDER, option});
    EXPECT_EQ(result.code, 0);
    EXPECT_NE(result.out, "");
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(CliOptions, NoDevice) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const std::vector<std::string> none = {"VK_DRIVER_FILES=/nonexistent.json",
                                         "VK_ICD_FILENAMES=/nonexistent.json"};
  EXPECT_EQ(render({grid}, none).code, 0);
  EXPECT_EQ(run_program({RENDER, "--list-devices"}, none).out.substr(0, 5), "cpu: ");
  EXPECT_EQ(render({grid, "--device=cpu"}, none).code, 0);
  expect_refused([&] { return render({grid, "--device=0"}, none); }, 4, "device");
  expect_refused([&] { return render({grid, "--device=99"}); }, 4, "99");
  expect_refused([&] { return render({grid, "--device=no such device"}); }, 4, "no such device");
}

TEST_F(CliOptions, DevicesAreListed) {
  const ChildResult result = run_program({RENDER, "--list-devices"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, 3), "0: ");
}

}  // namespace
}  // namespace splatray

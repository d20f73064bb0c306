/// Bad and odd input files: each ends in one sentence and exit code 3, or in a picture.
#include "app/library/image_file.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliInputs : public CliTest {
 protected:
  /// Both programs refuse the file with exit code 3 and name it.
  void expect_unreadable(const std::string& path) const {
    const std::string name = std::filesystem::path(path).filename();
    expect_refused([&] { return render({path}); }, 3, name);
    if (std::filesystem::path(path).extension() != ".soct")
      expect_refused([&] { return preprocess({path}); }, 3, name);
  }

  /// A picture that shows the points: seen against a black environment, in the light of a sun alone, some pixels are lit.
  void expect_picture(const std::string& path) const {
    const ChildResult result = render({path, "--environment=black", "--sun=1,2,3"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const DisplayImage image = read_display_image(file("out.png"), 0.0);
    EXPECT_GT(
        std::count_if(image.rgb.begin(), image.rgb.end(), [](const auto& pixel) { return pixel.x > 0.1F; }),
        0);
  }
};

TEST_F(CliInputs, MissingFile) {
  for (const char* name :
       {"a.ply", "a.obj", "a.stl", "a.vtk", "a.vtp", "a.vtu", "a.pvtu", "a.gltf", "a.glb", "a.soct"})
    expect_unreadable(file(name));
}

TEST_F(CliInputs, MissingFilesAreReportedBeforeTheDevice) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const auto refused = [&](std::vector<std::string> words, const std::string& name) {
    words.push_back("--device=no such device");
    expect_refused([&] { return render(words); }, 3, name + ": no such file");
  };
  refused({file("a.ply")}, "a.ply");
  refused({file("b.soct")}, "b.soct");
  refused({grid, file("b.las")}, "b.las");
  refused({grid, "--environment", file("a.hdr")}, "a.hdr");
  refused({grid, "--trajectory", file("a.txt")}, "a.txt");
  refused({grid, "--resume", file("a.exr")}, "a.exr");
}

TEST_F(CliInputs, AttributesThatNoFileHasAreNamed) {
  const std::string scan = write("a.csv", "x,y,z,gain\n0,0,0,1\n1,0,0,2\n0,1,0,3\n1,1,0,4\n");
  const ChildResult result = preprocess({scan, "--attributes=gain,gian,echo"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("note: --attributes: no input has 'gian', 'echo'"), std::string::npos)
      << result.err;
  EXPECT_EQ(preprocess({scan, "--attributes=gain"}).err.find("no input has"), std::string::npos);
}

TEST_F(CliInputs, OtherFilesOfJsonAreRefusedInOurWords) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const auto refused = [&](std::vector<std::string> words, const std::string& found) {
    words.insert(words.begin(), {RENDER, grid, "--quiet", "--device=cpu"});
    const ChildResult result = run_program(words);
    EXPECT_EQ(result.code, 3) << result.err;
    EXPECT_NE(result.err.find(found), std::string::npos) << result.err;
    for (const char* foreign : {"exception", "found found"})
      EXPECT_EQ(result.err.find(foreign), std::string::npos) << result.err;
  };
  const std::string broken = write("broken.json", "{\n \"eye\": [0, 0,\n}");
  refused({"--camera", broken, "-o", file("out.png")}, "line 3, column 1");
  refused({"--camera-path", broken, "-o", file("out.#.png")}, "line 3, column 1");
  refused({"--request", broken, "-o", file("out.png")}, "line 3, column 1");
  const auto measures = [&](const std::string& text, const std::string& found) {
    refused({"--sheet=plan", "-o", file("out.svg"), "--measures", write("m.geojson", text)}, found);
  };
  measures("{\"features\": [1,]}", "no JSON at line 1, column 17");
  measures("{\"sheet\": \"plan\"}", "no list 'features'");
  measures("{\"features\": [{}]}", "feature 1 without all that a measure has");
  measures(R"({"features": [{"properties": {"kind": "mood"}, "geometry": {}}]})", "not 'mood'");
  measures(R"({"features": [{"properties": {"kind": 3}, "geometry": {}}]})", "feature 1 without");
  const std::string gltf = write("a.gltf", "{\"asset\": {\"version\": 2}\n \"x\"}");
  expect_refused([&] { return render({gltf}); }, 3, "line 2, column 4");
}

TEST_F(CliInputs, EmptyFile) {
  for (const char* name :
       {"a.ply", "a.obj", "a.stl", "a.vtk", "a.vtp", "a.vtu", "a.pvtu", "a.gltf", "a.glb", "a.soct"})
    expect_unreadable(write(name, ""));
}

TEST_F(CliInputs, Directory) {
  for (const char* name : {"a.ply", "a.obj", "a.gltf", "a.soct"}) {
    std::filesystem::create_directory(file(name));
    expect_unreadable(file(name));
  }
}

TEST_F(CliInputs, UnknownExtension) {
  expect_unreadable(write("a.xyzzy", "1 2 3\n"));
  expect_unreadable(write("a", grid_ply(true)));
}

TEST_F(CliInputs, TruncatedPly) {
  const std::string whole = grid_ply(true);
  expect_unreadable(write("header.ply", whole.substr(0, 60)));
  const std::string body = write("body.ply", whole.substr(0, whole.size() / 2));
  expect_refused([&] { return preprocess({body, "--strict"}); }, 3, "body.ply");
  const ChildResult read = preprocess({body});
  EXPECT_EQ(read.code, 0);
  EXPECT_NE(read.err.find("expected 144 as the header says"), std::string::npos) << read.err;
  expect_unreadable(
      write("binary.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0123456789"));
}

TEST_F(CliInputs, CorruptPly) {
  expect_unreadable(write("magic.ply", "plx\nformat ascii 1.0\n"));
  expect_unreadable(
      write("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quux x\nend_header\n1\n"));
  expect_unreadable(write("words.ply", ascii_ply({"1 2 x", "1 2 3"}, false)));
  expect_unreadable(
      write("count.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n"));
}

TEST_F(CliInputs, CorruptGltf) {
  expect_unreadable(write("truncated.gltf", R"({"asset": {"version": "2.0"}, "meshes": [{"primi)"));
  expect_unreadable(write("array.gltf", "[1, 2, 3]"));
  expect_unreadable(write("magic.glb", "glTX and then some bytes that are no GLB at all"));
  expect_unreadable(write("empty.gltf", R"({"asset": {"version": "2.0"}})"));
  expect_unreadable(write("buffer.gltf",
                          R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "gone.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})"));
  expect_unreadable(write("points.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"extras": {"points": "gone.ply"}}]})"));
}

TEST_F(CliInputs, DamagedScene) {
  const std::string grid = write("grid.ply", grid_ply(true));
  ASSERT_EQ(run_program({PREPROCESS, grid, "-o", file("whole.soct")}).code, 0);
  std::filesystem::copy_file(file("whole.soct"), file("truncated.soct"));
  std::filesystem::resize_file(file("truncated.soct"), std::filesystem::file_size(file("whole.soct")) / 2);
  expect_unreadable(file("truncated.soct"));
  expect_unreadable(write("text.soct", "this is no scene"));
  expect_picture(file("whole.soct"));
}

TEST_F(CliInputs, NoPoints) {
  expect_unreadable(write("none.ply", ascii_ply({}, true)));
  const std::string nan = write("nan.ply", ascii_ply({"nan 0 0", "0 inf 0"}, false));
  expect_refused([&] { return render({nan}); }, 3, "2 points with positions that are not finite");
  expect_refused([&] { return preprocess({nan}); }, 3, "2 points with positions that are not finite");
}

TEST_F(CliInputs, SomePointsNotFinite) {
  std::string ply = grid_ply(true);
  ply.replace(ply.find("end_header\n") + 11, 1, "nan");
  expect_picture(write("some.ply", ply));
}

TEST_F(CliInputs, OnePoint) { expect_picture(write("one.ply", ascii_ply({"1 2 3"}, false))); }

TEST_F(CliInputs, AllPointsEqual) {
  expect_picture(write("equal.ply", ascii_ply(std::vector<std::string>(50, "1 2 3"), false)));
}

TEST_F(CliInputs, NoNormals) { expect_picture(write("bare.ply", grid_ply(false))); }

TEST_F(CliInputs, HugeCoordinates) { expect_picture(write("far.ply", grid_ply(true, 4e6, 1e-3))); }

TEST_F(CliInputs, UnreadableEnvironment) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const auto refuse = [&](const std::string& environment) {
    expect_refused([&] { return render({grid, "--environment", environment}); }, 3, environment);
  };
  refuse(file("missing.hdr"));
  refuse(folder.string());
  refuse(write("empty.hdr", ""));
  refuse(write("text.hdr", "no picture"));
  refuse(write("truncated.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n\x02\x02"));
  refuse(write("truncated.exr", std::string("\x76\x2f\x31\x01\x02\0\0\0channels\0chlist\0", 24)));
}

}  // namespace
}  // namespace splatray

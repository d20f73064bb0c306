/// Camera files, paths and turntables.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/library/camera_file.h"
#include "app/library/shot/sequence.h"
#include "engine/base/error.h"
#include "tests/property/dice.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

using testing::Dice;

/// A file in a folder of this program's own.
std::string temporary(const char* name) {
  static const TempFolder folder;
  return folder.path() / name;
}

Camera random_camera(Dice& dice, bool ortho) {
  Camera camera{dice.in_cube() * 1e7, dice.in_cube(), dice.direction(), Camera{}.fov_y_deg, 0.0};
  (ortho ? camera.ortho_height : camera.fov_y_deg) = dice.between(1.0, 179.0);
  camera.lens_shift = {dice.between(-1.0, 1.0), dice.between(-1.0, 1.0)};
  camera.pixel_aspect = dice.between(0.5, 2.0);
  return camera;
}

void expect_equal(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.fov_y_deg, b.fov_y_deg);
  EXPECT_EQ(a.ortho_height, b.ortho_height);
  EXPECT_EQ(a.lens_shift, b.lens_shift);
  EXPECT_EQ(a.pixel_aspect, b.pixel_aspect);
  EXPECT_EQ(a.panorama, b.panorama);
}

TEST(CameraFile, ComesBackBitForBit) {
  const std::string path = temporary("camera.json");
  Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    const Camera camera = random_camera(dice, i % 2 == 0);
    write_camera(camera, path);
    expect_equal(read_camera(path), camera);
  }
  Camera panorama{{1.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  panorama.panorama = true;
  write_camera(panorama, path);
  expect_equal(read_camera(path), panorama);
  const CameraPath keys = {{random_camera(dice, false), 3}, {random_camera(dice, false), 90}};
  write_camera_path(keys, path);
  const CameraPath copy = read_camera_path(path);
  ASSERT_EQ(copy.size(), 2U);
  EXPECT_EQ(copy[1].frame, 90U);
  expect_equal(copy[1].camera, keys[1].camera);
}

/// The sentence with which a file of this text is refused.
template <typename Read>
std::string refusal(const std::string& text, Read read) {
  const std::string path = temporary("bad.json");
  std::ofstream(path) << text;
  try {
    (void)read(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    EXPECT_NE(std::string(error.what()).find("bad.json"), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

TEST(CameraFile, RefusesWithASentence) {
  const std::string vectors = R"("eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0])";
  const auto camera = [](const std::string& text) { return refusal(text, read_camera); };
  EXPECT_NE(camera("").find("no JSON"), std::string::npos);
  EXPECT_NE(camera("[1]").find("no camera"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + "}").find("no fov_y_deg"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": 30, "ortho_height": 1})").find("one of"),
            std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": 30, "panorama": true})").find("fov_y_deg and panorama"),
            std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "panorama": false})").find("panorama false"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": 180})").find("fov_y_deg 180"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": "wide"})").find("wide"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "ortho_height": 0})").find("ortho_height 0"), std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": 30, "lens_shift": [1]})").find("lens_shift [1]"),
            std::string::npos);
  EXPECT_NE(camera("{" + vectors + R"(, "fov_y_deg": 30, "pixel_aspect": 0})").find("pixel_aspect 0"),
            std::string::npos);
  EXPECT_NE(camera(R"({"eye": [0, 0], "fov_y_deg": 30})").find("eye [0,0]"), std::string::npos);
  EXPECT_NE(camera(R"({"eye": [0, 0, 1e999], "fov_y_deg": 30})").find("beyond float64"), std::string::npos);
  EXPECT_NE(camera(R"({"keys": []})").find("path"), std::string::npos);
  EXPECT_THROW((void)read_camera(temporary("no such camera.json")), Error);
  EXPECT_THROW((void)read_camera(::testing::TempDir()), Error);
}

TEST(CameraFile, RefusesDeepNesting) {
  const auto deep = [](std::size_t depth) {
    return R"({"eye": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  EXPECT_NE(refusal(deep(200000), read_camera).find("nests more than 64 deep"), std::string::npos);
  EXPECT_NE(refusal(deep(200000), read_camera_path).find("nests more than 64 deep"), std::string::npos);
  EXPECT_NE(refusal(deep(63), read_camera).find("eye [[["), std::string::npos);
}

TEST(CameraFile, RefusesBadPaths) {
  const std::string key = R"({"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 30)";
  const auto path = [&](const std::string& first, const std::string& second) {
    return refusal(R"({"keys": [)" + key + first + "}, " + key + second + "}]}", read_camera_path);
  };
  EXPECT_NE(path(R"(, "frame": 5)", R"(, "frame": 5)").find("key 1: found frame 5"), std::string::npos);
  EXPECT_NE(path(R"(, "frame": -1)", "").find("key 0: found frame -1"), std::string::npos);
  EXPECT_NE(path(R"(, "frame": 0.5)", "").find("whole number"), std::string::npos);
  EXPECT_NE(path("", R"(, "ortho_height": 3)").find("key 1"), std::string::npos);
  EXPECT_NE(refusal(R"({"keys": []})", read_camera_path).find("no keys"), std::string::npos);
  EXPECT_NE(refusal(key + "}", read_camera_path).find("no keys"), std::string::npos);
}

TEST(CameraPath, KeysWithoutFramesFollowEachOther) {
  const std::string path = temporary("bare.json");
  const std::string key = R"({"eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 30)";
  std::ofstream(path) << R"({"keys": [)" << key << "}, " << key << R"(, "frame": 100}, )" << key << "}]}";
  const CameraPath keys = read_camera_path(path);
  EXPECT_EQ(keys[0].frame, 0U);
  EXPECT_EQ(keys[1].frame, 100U);
  EXPECT_EQ(keys[2].frame, 100U + KEY_FRAMES);
}

TEST(CameraPath, MeetsItsKeysAndMovesSmoothly) {
  Dice dice(5);
  CameraPath path;
  for (const std::uint32_t frame : {10U, 1010U, 1510U, 4010U}) {
    path.push_back({random_camera(dice, false), frame});
    path.back().camera.eye = dice.in_cube();
  }
  for (const CameraKey& key : path) expect_equal(camera_at(path, key.frame), key.camera);
  glm::dvec3 last_step = camera_at(path, 11).eye - camera_at(path, 10).eye;
  for (std::uint32_t frame = 11; frame < 4010; ++frame) {
    const glm::dvec3 step = camera_at(path, frame + 1).eye - camera_at(path, frame).eye;
    ASSERT_LT(glm::length(step - last_step), 1e-4) << "no jump of the speed at frame " << frame;
    last_step = step;
  }
}

TEST(CameraPath, IsCatmullRomForEvenKeys) {
  CameraPath path;
  const double eyes[] = {1.0, 5.0, -2.0, 4.0};
  for (std::uint32_t i = 0; i < 4; ++i) path.push_back({{glm::dvec3(eyes[i]), {}, {}, 30.0, 0.0}, 10 * i});
  // Half way between the inner keys of Catmull and Rom's spline: (-p0 + 9 p1 + 9 p2 - p3) / 16.
  EXPECT_NEAR(camera_at(path, 15).eye.x, (-1.0 + 9.0 * 5.0 - 9.0 * 2.0 - 4.0) / 16.0, 1e-12);
}

TEST(Turntable, TurnsAboutTheTarget) {
  const Camera still{{3.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, {0.0, 1.0, 0.0}, 30.0, 0.0};
  expect_equal(turned_camera(still, {0.0, 2.0, 0.0}, 0.0), still);
  const Camera quarter = turned_camera(still, {0.0, 2.0, 0.0}, 0.25);
  EXPECT_LT(glm::length(quarter.eye - glm::dvec3(0.0, 1.0, -1.0)), 1e-12)
      << "counter-clockwise seen from above";
  EXPECT_LT(glm::length(turned_camera(still, {0.0, 2.0, 0.0}, 1.0).eye - still.eye), 1e-12);
}

TEST(Sequence, NamesFrames) {
  EXPECT_EQ(frame_file("a/b.####.png", 7), "a/b.0007.png");
  EXPECT_EQ(frame_file("#.exr", 1234), "1234.exr");
  EXPECT_EQ(frame_file("a#b/c##d.png", 5), "a#b/c05d.png");
  for (const char* pattern : {"a.png", "a.##.#.png", "a##/b.png"})
    EXPECT_THROW((void)frame_file(pattern, 1), Error) << pattern;
}

}  // namespace
}  // namespace splatray

/// Every real model and scene of SPLATRAY_DATA_DIR is read.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "preprocess/base/file_extension.h"
#include "tests/all_tests.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

std::vector<std::filesystem::path> data_files(const std::string& folder) {
  const char* const data = std::getenv("SPLATRAY_DATA_DIR");
  std::vector<std::filesystem::path> files;
  if (data == nullptr) {
    return files;
  }
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / folder)) {
    const std::string extension = lower_extension(entry.path());
    if (extension == ".ply" || extension == ".gltf" || extension == ".glb") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What a landing reads of them: larger files take a minute.
constexpr std::uintmax_t BYTES_FOR_A_LANDING = 1U << 18U;

void expect_sane(const std::filesystem::path& file) {
  const Input input = read_input({file}, {});
  for (const InputObject& object : input.objects) {
    EXPECT_GE(object.points.size(), 100U) << file << " " << object.name;
    EXPECT_EQ(object.points.normal.size(), object.points.size()) << file;
    EXPECT_GT(object.surface_area, 0.0) << file;
    for (const glm::dvec3& position : object.points.position) {
      ASSERT_TRUE(std::isfinite(position.x + position.y + position.z)) << file;
    }
  }
}

/// Of a glTF in text its folder's, where its buffers and pictures lie.
std::uintmax_t bytes_of(const std::filesystem::path& file) {
  if (file.extension() != ".gltf") return std::filesystem::file_size(file);
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(file.parent_path()))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

TEST(Data, EveryModelAndSceneIsRead) {
  if (std::getenv("SPLATRAY_DATA_DIR") == nullptr) {
    GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no real models to read";
  }
  const std::vector<std::filesystem::path> models = data_files("models");
  const std::vector<std::filesystem::path> scenes = data_files("gltf");
  EXPECT_FALSE(models.empty());
  EXPECT_FALSE(scenes.empty());
  for (const auto& files : {models, scenes})
    for (const std::filesystem::path& file : files)
      if (testing::all_tests() || bytes_of(file) <= BYTES_FOR_A_LANDING) expect_sane(file);
}

TEST(Data, EveryPlyScanIsRead) {
  if (std::getenv("SPLATRAY_DATA_DIR") == nullptr) {
    GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no real scans to read";
  }
  for (const std::filesystem::path& file : data_files("scans")) {
    EXPECT_GT(read_input({file}, {}).objects.at(0).points.size(), 10000U) << file;
  }
}

}  // namespace
}  // namespace splatray

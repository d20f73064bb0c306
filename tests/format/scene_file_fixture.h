/// A scene file in a folder of its own, and what its reader says of others in its place.
#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "tests/format/scene_bytes.h"
#include "tests/format/tiny_scene.h"
#include "tests/temp_folder.h"

namespace splatray {

class SceneFile : public ::testing::Test {
 protected:
  void SetUp() override { bytes = written(tiny_scene()); }

  /// The bytes that a scene is written as.
  [[nodiscard]] Bytes written(const Scene& scene) const {
    write_scene(scene, path);
    return load();
  }

  [[nodiscard]] Bytes load() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void store(const Bytes& content) const { std::ofstream(path, std::ios::binary) << content; }

  /// The scene that these bytes are read as.
  [[nodiscard]] Scene read(const Bytes& content) const {
    store(content);
    return read_scene(path);
  }

  /// The refusal of a file of these bytes; empty when it is read.
  [[nodiscard]] std::string refusal(const Bytes& content) const {
    try {
      (void)read(content);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      const std::string sentence = error.what();
      EXPECT_NE(sentence.find(path.string()), std::string::npos);
      EXPECT_NE(sentence.find("expected"), std::string::npos);
      EXPECT_EQ(sentence.find('\n'), std::string::npos);
      return sentence;
    }
    return "";
  }

  void expect_refusal(const Bytes& content, const char* words) const {
    const std::string sentence = refusal(content);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence << "\nfor: " << words;
  }

  const TempFolder own;
  const std::filesystem::path& folder = own.path();
  const std::filesystem::path path = folder / "tiny.soct";
  Bytes bytes;
};

}  // namespace splatray

/// What reading a file ends in.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/base/error.h"
#include "preprocess/points.h"
#include "tests/temp_folder.h"

namespace splatray {

/// The sentence of the Error that reading ends in; it must have code input_unreadable and name the file.
inline std::string read_error(const std::filesystem::path& path, const ReadOptions& options = {}) {
  try {
    static_cast<void>(read_input({path}, options));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << path << " was read, expected an error";
  return "";
}

/// Reads every proper prefix of a file: each must end in an Error or a valid Input.
inline void read_every_prefix(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  ReadOptions options;
  options.samples = 50;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::filesystem::path file = folder.write(name, bytes.substr(0, length));
    try {
      const Input input = read_input({file}, options);
      EXPECT_GT(input.objects.front().points.size(), 0U) << "prefix of " << length;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable) << "prefix of " << length << ": " << error.what();
    }
  }
}

/// Options that keep meshes and sample few points, so that reading takes no time.
inline ReadOptions keeping_meshes() {
  ReadOptions options;
  options.keep_meshes = true;
  options.samples = 1000;
  options.clip = false;  // which may add samples
  return options;
}

/// Whether some note holds the text.
inline bool has_note(const Input& input, const std::string& text) {
  for (const std::string& note : input.notes) {
    if (note.find(text) != std::string::npos) {
      return true;
    }
  }
  return false;
}

/// The bytes of a value as they lie in memory (little-endian).
template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

}  // namespace splatray

#include "engine/file/scene_input.h"

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/file/checksum.h"
#include "engine/file/file_roles.h"

namespace splatray::scene_file {

void report(const Progress& progress, const char* stage, std::uint64_t done, std::uint64_t all) {
  if (progress && !progress(stage, static_cast<double>(done) / static_cast<double>(all)))
    throw Error(ExitCode::interrupted, std::string(stage) + " the scene file was interrupted");
}

SceneInput::SceneInput(const std::filesystem::path& path, const Progress& progress)
    : path_(path), progress_(progress) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse("no such file", "a scene file");
  if (!std::filesystem::is_regular_file(path, error)) refuse("a folder or device", "a scene file");
  note_input(path);
  file_.open(path, std::ios::binary);
  if (!file_) refuse("a file that cannot be opened", "a readable one");
  size_ = std::filesystem::file_size(path);
}

void SceneInput::read(std::uint64_t offset, void* target, std::uint64_t bytes) {
  file_.seekg(static_cast<std::streamoff>(offset));
  for (std::uint64_t piece = 0; bytes > 0; bytes -= piece, offset += piece) {
    piece = std::min(bytes, PIECE_BYTES);
    if (!file_.read(static_cast<char*>(target), static_cast<std::streamsize>(piece)))
      refuse("its end or a read error behind byte " + std::to_string(offset),
             std::to_string(bytes) + " more bytes");
    target = static_cast<char*>(target) + piece;
    done_ += piece;
    report(progress_, "reading", std::min(done_, size_), size_);
  }
}

std::uint64_t SceneInput::checksum(std::uint64_t offset, std::uint64_t bytes) {
  std::vector<char> piece(std::min(bytes, PIECE_BYTES));
  Checksum checksum;
  for (std::uint64_t done = 0; done < bytes; done += piece.size()) {
    piece.resize(std::min(bytes - done, PIECE_BYTES));
    read(offset + done, piece.data(), piece.size());
    checksum.add(piece.data(), piece.size());
  }
  return checksum.value();
}

void SceneInput::refuse(const std::string& found, const std::string& expected) const {
  throw Error(ExitCode::input_unreadable,
              "cannot read scene '" + path_.string() + "': found " + found + ", expected " + expected);
}

}  // namespace splatray::scene_file

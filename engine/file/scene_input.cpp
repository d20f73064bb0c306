#include "engine/file/scene_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) refuse("a file that cannot be opened", "a readable one");
  struct stat status {};
  if (fstat(descriptor_, &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ >= LEAST_MAPPED_BYTES) mapping_ = FileMapping::map(descriptor_, path);
  if (mapping_) size_ = mapping_->bytes().size();
}

SceneInput::~SceneInput() {
  if (descriptor_ >= 0) close(descriptor_);
}

void SceneInput::count(std::uint64_t bytes) {
  done_ += bytes;
  report(progress_, "reading", std::min(done_, size_), size_);
}

void SceneInput::read(std::uint64_t offset, void* target, std::uint64_t bytes) {
  while (bytes > 0) {
    const ssize_t piece =
        pread(descriptor_, target, std::min(bytes, PIECE_BYTES), static_cast<off_t>(offset));
    if (piece < 0 && errno == EINTR) continue;
    if (piece <= 0)
      refuse("its end or a read error behind byte " + std::to_string(offset),
             std::to_string(bytes) + " more bytes");
    const auto done = static_cast<std::uint64_t>(piece);
    target = static_cast<char*>(target) + done;
    offset += done;
    bytes -= done;
    count(done);
  }
}

std::uint64_t SceneInput::checksum(std::uint64_t offset, std::uint64_t bytes) {
  std::vector<char> piece(mapping_ ? 0 : std::min(bytes, PIECE_BYTES));
  Checksum checksum;
  for (std::uint64_t done = 0; done < bytes;) {
    const std::uint64_t size = std::min(bytes - done, PIECE_BYTES);
    if (mapping_) {
      checksum.add(mapping_->bytes().data() + offset + done, size);
      count(size);
    } else {
      read(offset + done, piece.data(), size);
      checksum.add(piece.data(), size);
    }
    done += size;
  }
  return checksum.value();
}

void SceneInput::refuse(const std::string& found, const std::string& expected) const {
  throw Error(ExitCode::input_unreadable,
              "cannot read scene '" + path_.string() + "': found " + found + ", expected " + expected);
}

}  // namespace splatray::scene_file

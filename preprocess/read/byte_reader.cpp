#include "preprocess/read/byte_reader.h"

#include <algorithm>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/one_line.h"
#include "engine/file/file_roles.h"

namespace splatray {

void throw_unreadable(const std::filesystem::path& path, const std::string& what) {
  throw Error(ExitCode::input_unreadable, one_line(path.string() + ": " + what));
}

ByteReader::ByteReader(const std::filesystem::path& path, const ReadListener* listener)
    : path_(path), listener_(listener) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw_unreadable(path, "no such file");
  }
  if (std::filesystem::is_directory(status)) {
    throw_unreadable(path, "found a directory, expected a file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw_unreadable(path, "not a regular file");
  }
  size_ = std::filesystem::file_size(path, error);
  if (error || size_ == 0) {
    throw_unreadable(path, error ? error.message() : "the file is empty");
  }
  note_input(path);
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) {
    throw_unreadable(path, "cannot be opened for reading");
  }
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size_, BLOCK_BYTES)));
}

bool ByteReader::fill(std::size_t count) {
  if (listener_ != nullptr) {
    listener_->report(static_cast<double>(offset_) / static_cast<double>(size_));
  }
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (count > buffer_.size()) {
    buffer_.resize(std::max(count, 2 * buffer_.size()));
  }
  while (end_ < count) {
    const std::size_t got = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
    if (got == 0) {
      return false;
    }
    end_ += got;
  }
  return true;
}

void ByteReader::seek(std::uint64_t offset) {
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0)
    throw_unreadable(path_, "byte " + std::to_string(offset) + " cannot be reached");
  begin_ = end_ = 0;
  offset_ = offset;
}

std::vector<unsigned char> ByteReader::read(std::uint64_t count) {
  std::vector<unsigned char> bytes(static_cast<std::size_t>(std::min(count, remaining())));
  for (std::size_t done = 0; done < bytes.size();) {
    const std::size_t step = std::min(bytes.size() - done, BLOCK_BYTES);
    const unsigned char* block = take(step);
    if (block == nullptr) throw_unreadable(path_, "it could not be read to its end");
    std::memcpy(bytes.data() + done, block, step);
    done += step;
  }
  return bytes;
}

bool ByteReader::skip(std::uint64_t count) {
  while (count > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(count, BLOCK_BYTES));
    if (take(step) == nullptr) {
      return false;
    }
    count -= step;
  }
  return true;
}

bool ByteReader::line(std::string_view& text, std::size_t max_bytes) {
  std::size_t searched = 0;
  const void* found = nullptr;
  while (found == nullptr) {
    found = std::memchr(buffer_.data() + begin_ + searched, '\n', end_ - begin_ - searched);
    searched = end_ - begin_;
    if (found == nullptr && (searched >= max_bytes || !fill(searched + 1))) {
      break;
    }
  }
  const std::size_t length =
      found == nullptr
          ? std::min(searched, max_bytes)
          : static_cast<std::size_t>(static_cast<const unsigned char*>(found) - (buffer_.data() + begin_));
  const std::size_t consumed = length + (found == nullptr ? 0 : 1);
  if (consumed == 0) {
    return false;
  }
  text = {reinterpret_cast<const char*>(buffer_.data() + begin_), length};
  begin_ += consumed;
  offset_ += consumed;
  if (!text.empty() && text.back() == '\r') {
    text.remove_suffix(1);
  }
  return true;
}

}  // namespace splatray

#include "preprocess/read/bytes/byte_reader.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/one_line.h"
#include "engine/file/file_roles.h"

namespace splatray {

void throw_unreadable(const std::filesystem::path& path, const std::string& what) {
  throw Error(ExitCode::input_unreadable, one_line(path.string() + ": " + what));
}

namespace {

/// Refuses what a download often is, whatever it is called. Of all float32 that a KITTI sweep may begin with, one in 16 million
/// looks so.
void refuse_archive(const std::filesystem::path& path, ByteSource& source) {
  using namespace std::string_view_literals;
  struct Start {
    std::string_view bytes, what, instead;
  };
  constexpr Start STARTS[] = {
      {"\x1F\x8B\x08"sv, "a file packed by gzip", "what is in it: unpack it with gunzip"},
      {"PK\x03\x04"sv, "a ZIP archive or an office document",
       "points: unpack the archive, or save the document's table as CSV"},
      {"7z\xBC\xAF\x27\x1C"sv, "a 7-Zip archive", "what is in it: unpack it"},
      {"\xFD"
       "7zXZ\0"sv,
       "a file packed by xz", "what is in it: unpack it with unxz"},
      {"<!DOCTYPE html"sv, "a web page", "points: the download gave a page instead"}};
  std::array<unsigned char, 16> bytes{};
  const std::size_t got = source.read(0, bytes.data(), bytes.size());
  const std::string_view begin(reinterpret_cast<const char*>(bytes.data()), got);
  for (const Start& start : STARTS)
    if (begin.starts_with(start.bytes))
      throw_unreadable(path, "found " + std::string(start.what) + ", expected " + std::string(start.instead));
}

}  // namespace

ByteReader::ByteReader(const std::filesystem::path& path, const ReadListener* listener)
    : path_(path), listener_(listener), source_(open_source(path)), size_(source_->size()) {
  note_input(path);
  refuse_archive(path_, *source_);
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
  const std::size_t most = source_->is_near() ? buffer_.size() : count;
  end_ += source_->read(offset_ + end_, buffer_.data() + end_, most - end_);
  return end_ >= count;
}

void ByteReader::seek(std::uint64_t offset) {
  begin_ = end_ = 0;
  offset_ = offset;
}

std::vector<unsigned char> ByteReader::read(std::uint64_t count) {
  constexpr std::size_t MOST_AT_ONCE = 16 * BLOCK_BYTES;  // between which readers report
  std::vector<unsigned char> bytes(static_cast<std::size_t>(std::min(count, remaining())));
  std::size_t done = std::min(bytes.size(), end_ - begin_);
  if (done > 0) std::memcpy(bytes.data(), buffer_.data() + begin_, done);
  begin_ += done;
  offset_ += done;
  while (done < bytes.size()) {
    if (listener_ != nullptr) listener_->report(static_cast<double>(offset_) / static_cast<double>(size_));
    const std::size_t step = std::min(bytes.size() - done, MOST_AT_ONCE);
    if (source_->read(offset_, bytes.data() + done, step) < step)
      throw_unreadable(path_, "it could not be read to its end");
    done += step;
    offset_ += step;
  }
  return bytes;
}

std::vector<unsigned char> ByteReader::read(std::span<const Range> ranges) {
  if (listener_ != nullptr) listener_->report(static_cast<double>(offset_) / static_cast<double>(size_));
  std::uint64_t bytes = 0;
  for (const Range& range : ranges) {
    if (range.offset > size_ || range.count > size_ - range.offset)
      throw_unreadable(path_, "it could not be read to its end");
    bytes += range.count;
  }
  std::vector<unsigned char> all(static_cast<std::size_t>(bytes));
  std::vector<BytePart> parts;
  std::size_t at = 0;
  for (const Range& range : ranges) {
    parts.push_back({range.offset, all.data() + at, static_cast<std::size_t>(range.count)});
    at += static_cast<std::size_t>(range.count);
  }
  if (!source_->read_parts(parts)) throw_unreadable(path_, "it could not be read to its end");
  return all;
}

bool ByteReader::skip(std::uint64_t count) {
  if (count > remaining()) return false;
  const bool is_buffered = count <= end_ - begin_;
  begin_ = is_buffered ? begin_ + static_cast<std::size_t>(count) : end_;
  offset_ += count;
  return true;
}

void ByteReader::begin_text() {
  if (offset_ != 0) return;
  if (end_ - begin_ < 2) static_cast<void>(fill(std::min<std::uint64_t>(size_, UTF8_MARK.size())));
  const std::string_view start(reinterpret_cast<const char*>(buffer_.data() + begin_), end_ - begin_);
  const auto is_ascii = [](char c) { return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c <= '~'); };
  const bool zero_beside_letter = start.size() > 1 && ((start[0] == '\0' && is_ascii(start[1])) ||
                                                       (start[1] == '\0' && is_ascii(start[0])));
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF") || zero_beside_letter)
    throw_unreadable(path_, "found text in UTF-16, expected UTF-8: save it as UTF-8");
  if (start.starts_with(UTF8_MARK)) static_cast<void>(skip(UTF8_MARK.size()));
}

/// The bytes of the end that follows a line of `length` bytes in the buffer; 0: none, as the file ends or the line is cut.
std::size_t ByteReader::end_of_line(std::size_t length, std::size_t max_bytes) {
  if (begin_ + length == end_ || length > max_bytes) return 0;
  if (buffer_[begin_ + length] == '\n') return 1;
  const bool has_next = begin_ + length + 1 < end_ || fill(length + 2);
  const bool is_pair = !cr_ends_lines_ && has_next && buffer_[begin_ + length + 1] == '\n';
  cr_ends_lines_ = cr_ends_lines_ || (has_next && !is_pair);
  return is_pair ? 2 : 1;
}

bool ByteReader::line(std::string_view& text, std::size_t max_bytes) {
  begin_text();
  const auto is_end = [](unsigned char c) { return c == '\n' || c == '\r'; };
  std::size_t length = 0;
  for (bool searching = true; searching;) {
    const unsigned char* const begin = buffer_.data() + begin_;
    const unsigned char* const end = buffer_.data() + end_;
    length = static_cast<std::size_t>(std::find_if(begin + length, end, is_end) - begin);
    searching = begin + length == end && length < max_bytes && fill(length + 1);
  }
  const std::size_t end_bytes = end_of_line(length, max_bytes);
  if (end_bytes == 0) length = std::min(length, max_bytes);
  line_is_open_ = end_bytes == 0;
  if (length + end_bytes == 0) return false;
  text = {reinterpret_cast<const char*>(buffer_.data() + begin_), length};
  begin_ += length + end_bytes;
  offset_ += length + end_bytes;
  return true;
}

}  // namespace splatray

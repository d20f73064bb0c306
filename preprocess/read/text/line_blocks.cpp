#include "preprocess/read/text/line_blocks.h"

#include <algorithm>

namespace splatray {

LineBlocks::LineBlocks(const std::filesystem::path& path, const ReadListener& listener,
                       const TextPlace& start)
    : in_(path, &listener) {
  static_cast<void>(in_.skip(start.offset));
  in_.begin_text();
}

/// Appends bytes to the buffer, their line ends made LF. A CR at its end waits for what follows.
void LineBlocks::read_more() {
  const auto step =
      static_cast<std::size_t>(std::min<std::uint64_t>(in_.remaining(), ByteReader::BLOCK_BYTES));
  const unsigned char* bytes = in_.take(step);
  if (bytes == nullptr) throw_unreadable(path(), "it could not be read to its end");
  const bool waits = !buffer_.empty() && buffer_.back() == '\r';
  const std::size_t before = buffer_.size() - (waits ? 1 : 0);
  buffer_.insert(buffer_.end(), bytes, bytes + step);
  const bool at_end = in_.remaining() == 0;
  for (auto at = buffer_.begin() + static_cast<std::ptrdiff_t>(before);; ++at) {
    at = std::find(at, buffer_.end(), '\r');
    if (at == buffer_.end() || (at + 1 == buffer_.end() && !at_end)) break;
    if (at + 1 == buffer_.end() || at[1] != '\n') *at = '\n';
  }
}

std::span<char> LineBlocks::next() {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
  while (in_.remaining() > 0 && buffer_.size() < BLOCK_BYTES) read_more();
  const auto last = std::find(buffer_.rbegin(), buffer_.rend(), '\n');
  used_ = in_.remaining() == 0 ? buffer_.size() : static_cast<std::size_t>(buffer_.rend() - last);
  if (used_ == 0 && !buffer_.empty())
    throw_unreadable(path(), "found a line of more than " + std::to_string(BLOCK_BYTES) +
                                 " bytes, expected a text file with numbers on each line");
  return {buffer_.data(), used_};
}

}  // namespace splatray

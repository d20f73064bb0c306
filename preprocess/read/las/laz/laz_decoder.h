/// Records of LAS files from LASzip's chunks.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/read/las/laz/laz_layout.h"

namespace splatray {

/// Decodes one chunk after another. Damaged bytes give points that are wrong but no other harm.
class LazDecoder {
 public:
  LazDecoder() = default;
  LazDecoder(const LazDecoder&) = delete;
  LazDecoder& operator=(const LazDecoder&) = delete;
  virtual ~LazDecoder() = default;

  /// Begins a chunk of `points` > 0 points, whose bytes must outlive its decoding. Returns how many of them there are as far as it
  /// says so itself, which layered chunks do; 0 where it is no such chunk.
  [[nodiscard]] virtual std::size_t start(std::span<const unsigned char> chunk, std::size_t points) = 0;
  /// Writes the next `count` records; in all no more than there are. Bytes that are not needed may stay as they are.
  virtual void read(unsigned char* records, std::size_t count) = 0;
  /// Whether what was read is known to be wrong.
  [[nodiscard]] virtual bool is_damaged() const = 0;
  /// Whether besides the chunk was read to its end, as it is when all its points were.
  [[nodiscard]] virtual bool is_complete() const = 0;
  /// Bytes of the chunk that were read so far.
  [[nodiscard]] virtual std::size_t consumed() const = 0;
};

/// `wanted`: which bytes of the record somebody needs; only user data, scan angle, infrared and extra bytes in layers are left out by it.
[[nodiscard]] std::unique_ptr<LazDecoder> make_laz_decoder(const LazLayout& layout,
                                                           const std::vector<bool>& wanted);

/// How many of a chunk's points there surely are, where fewer follow than the `points` that were claimed: those up to the first with
/// which its bytes are used up; 0 where there is none such, as of damaged chunks. `record` has room for one.
[[nodiscard]] std::size_t points_there(LazDecoder& decoder, std::span<const unsigned char> chunk,
                                       std::size_t points, unsigned char* record);

/// What a layered chunk says of itself.
struct LayeredChunk {
  std::uint32_t points = 0;
  std::uint64_t bytes = 0;  ///< of the whole chunk
};

/// Bytes at the begin of a layered chunk that describe it: a record, a count and the layers' sizes.
[[nodiscard]] std::size_t layered_head_bytes(const LazLayout& layout);
/// Sizes in a layered chunk's first layered_head_bytes().
[[nodiscard]] LayeredChunk layered_chunk(const LazLayout& layout, const unsigned char* head);

}  // namespace splatray

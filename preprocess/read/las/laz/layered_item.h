/// Parts of a point's record whose fields LASzip codes in layers, each with bytes of its own (formats 6 to 10).
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "preprocess/read/las/laz/arithmetic_decoder.h"
#include "preprocess/read/las/laz/laz_layout.h"

namespace splatray {

/// The bytes of each layer; one without bytes does not change in its chunk.
using LazLayers = std::span<const std::span<const unsigned char>>;

/// Decodes one part of each record (M. Isenburg, LASzip 3, 2017; the layered items of versions 3 and 4).
class LayeredItem {
 public:
  LayeredItem() = default;
  LayeredItem(const LayeredItem&) = delete;
  LayeredItem& operator=(const LayeredItem&) = delete;
  virtual ~LayeredItem() = default;

  /// Begins a chunk with the bytes of this part in its first record, whose scanner channel is `channel`.
  virtual void start(const unsigned char* first, LazLayers layers, unsigned channel) = 0;
  /// Decodes this part of the next channels.size() records, which lie `stride` bytes apart. The part with the position
  /// writes `channels`, which chooses the probabilities of all others.
  virtual void read(unsigned char* bytes, std::size_t stride, std::span<unsigned char> channels) = 0;
  /// Whether what was read is known to be wrong.
  [[nodiscard]] virtual bool is_damaged() const = 0;
  /// Whether besides each layer was read to its end, as it is when a chunk's last point was.
  [[nodiscard]] virtual bool is_complete() const = 0;
};

/// Scanner channels of a part other than the position: which has been met, and whose last values predict the next.
/// Versions before 4 predict the first point after a change of the channel from the channel before it.
class LazChannels {
 public:
  static constexpr unsigned COUNT = 4;

  explicit LazChannels(unsigned version) : is_mended_(version >= 4) {}

  void start(unsigned channel) {
    met_ = {};
    met_[channel] = true;
    current_ = channel;
  }

  /// Goes to a point's channel and returns the one whose last values predict it. A channel that has not been met begins by
  /// `begin(channel, before)`, with the last values of the one before.
  template <class Begin>
  unsigned predictor(unsigned channel, const Begin& begin) {
    if (channel == current_) return current_;
    const unsigned before = current_;
    current_ = channel;
    if (met_[channel]) return is_mended_ ? channel : before;
    met_[channel] = true;
    begin(channel, before);
    return channel;
  }

 private:
  bool is_mended_;
  unsigned current_ = 0;
  std::array<bool, COUNT> met_{};
};

/// Layers of an item of a record.
[[nodiscard]] std::size_t layer_count(const LazItem& item);

/// A record's first 30 bytes; angle and user data are not written where `wanted` has none of their bytes.
[[nodiscard]] std::unique_ptr<LayeredItem> make_point14(unsigned version, const std::vector<bool>& wanted);
/// Red, green, blue.
[[nodiscard]] std::unique_ptr<LayeredItem> make_rgb14(unsigned version);
/// Near infrared, which follows them.
[[nodiscard]] std::unique_ptr<LayeredItem> make_infrared14(unsigned version);
/// Extra bytes, those that are wanted.
[[nodiscard]] std::unique_ptr<LayeredItem> make_bytes14(unsigned version, std::vector<bool> wanted);

}  // namespace splatray

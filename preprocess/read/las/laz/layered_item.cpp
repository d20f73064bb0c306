#include "preprocess/read/las/laz/layered_item.h"

#include <algorithm>
#include <utility>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/rgb.h"

namespace splatray {
namespace {

/// A value of each channel that Models decode from the channel's last one.
template <class Value, class Models>
class ChannelValues final : public LayeredItem {
 public:
  explicit ChannelValues(unsigned version) : channels_(version) {}

  void start(const unsigned char* first, LazLayers layers, unsigned channel) override {
    changes_ = !layers[0].empty();
    in_.start(layers[0]);
    channels_.start(channel);
    last_[channel] = load<Value>(first);
    models_[channel].reset();
  }

  void read(unsigned char* bytes, std::size_t stride, std::span<unsigned char> channels) override {
    for (const unsigned channel : channels) {
      const unsigned predictor = channels_.predictor(channel, [this](unsigned begun, unsigned before) {
        last_[begun] = last_[before];
        models_[begun].reset();
      });
      if (changes_) models_[channel].read(in_, last_[predictor]);
      store(bytes, last_[predictor]);
      bytes += stride;
    }
  }

  [[nodiscard]] bool is_damaged() const override { return changes_ && in_.is_damaged(); }
  [[nodiscard]] bool is_complete() const override { return !changes_ || in_.is_complete(); }

 private:
  LazChannels channels_;
  bool changes_ = false;
  ArithmeticDecoder in_;
  std::array<Value, LazChannels::COUNT> last_{};
  std::array<Models, LazChannels::COUNT> models_;
};

/// 16 bits by bytes that differ from the last.
class InfraredModels {
 public:
  void reset() {
    changed_.reset();
    for (auto& model : difference_) model.reset();
  }
  void read(ArithmeticDecoder& in, std::uint16_t& last) {
    const unsigned which = in.symbol(changed_);
    unsigned low = last & 255U, high = last >> 8U;
    if ((which & 1U) != 0) low = (low + in.symbol(difference_[0])) & 255U;
    if ((which & 2U) != 0) high = (high + in.symbol(difference_[1])) & 255U;
    last = static_cast<std::uint16_t>(low | (high << 8U));
  }

 private:
  SymbolModel<4> changed_;
  std::array<SymbolModel<256>, 2> difference_;  ///< low, high
};

/// One of the extra bytes.
class Byte14 {
 public:
  explicit Byte14(unsigned version) : channels_(version) {}

  void start(unsigned char first, std::span<const unsigned char> layer, unsigned channel) {
    changes_ = !layer.empty();
    in_.start(layer);
    channels_.start(channel);
    last_[channel] = first;
    models_[channel].reset();
  }

  [[nodiscard]] unsigned char read(unsigned channel) {
    const unsigned predictor = channels_.predictor(channel, [this](unsigned begun, unsigned before) {
      last_[begun] = last_[before];
      models_[begun].reset();
    });
    if (changes_)
      last_[predictor] = static_cast<unsigned char>(last_[predictor] + in_.symbol(models_[channel]));
    return last_[predictor];
  }

  [[nodiscard]] bool is_damaged() const { return changes_ && in_.is_damaged(); }
  [[nodiscard]] bool is_complete() const { return !changes_ || in_.is_complete(); }

 private:
  LazChannels channels_;
  bool changes_ = false;
  ArithmeticDecoder in_;
  std::array<unsigned char, LazChannels::COUNT> last_{};
  std::array<SymbolModel<256>, LazChannels::COUNT> models_;
};

class Bytes14 final : public LayeredItem {
 public:
  Bytes14(unsigned version, const std::vector<bool>& wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (wanted[i]) bytes_.push_back({i, Byte14(version)});
  }

  void start(const unsigned char* first, LazLayers layers, unsigned channel) override {
    for (auto& [at, byte] : bytes_) byte.start(first[at], layers[at], channel);
  }

  void read(unsigned char* bytes, std::size_t stride, std::span<unsigned char> channels) override {
    for (auto& [at, byte] : bytes_)
      for (std::size_t i = 0; i < channels.size(); ++i) bytes[i * stride + at] = byte.read(channels[i]);
  }

  [[nodiscard]] bool is_damaged() const override {
    return std::any_of(bytes_.begin(), bytes_.end(), [](const auto& one) { return one.second.is_damaged(); });
  }
  [[nodiscard]] bool is_complete() const override {
    return std::all_of(bytes_.begin(), bytes_.end(),
                       [](const auto& one) { return one.second.is_complete(); });
  }

 private:
  std::vector<std::pair<std::size_t, Byte14>> bytes_;  ///< by their place
};

}  // namespace

std::size_t layer_count(const LazItem& item) {
  constexpr std::size_t POINT14_LAYERS = 9;
  switch (item.kind) {
    case LazItem::Kind::point14:
      return POINT14_LAYERS;
    case LazItem::Kind::rgbnir14:
      return 2;
    case LazItem::Kind::bytes14:
      return item.size;
    default:
      return 1;
  }
}

std::unique_ptr<LayeredItem> make_rgb14(unsigned version) {
  return std::make_unique<ChannelValues<StoredRgb, RgbModels>>(version);
}

std::unique_ptr<LayeredItem> make_infrared14(unsigned version) {
  return std::make_unique<ChannelValues<std::uint16_t, InfraredModels>>(version);
}

std::unique_ptr<LayeredItem> make_bytes14(unsigned version, std::vector<bool> wanted) {
  return std::make_unique<Bytes14>(version, wanted);
}

}  // namespace splatray

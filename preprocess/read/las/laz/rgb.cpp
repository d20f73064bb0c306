#include "preprocess/read/las/laz/rgb.h"

#include <algorithm>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/pointwise_item.h"

namespace splatray {
namespace {

class Rgb12V1 final : public PointwiseItem {
 public:
  void start(const unsigned char* first) override {
    std::copy_n(first, last_.size(), last_.begin());
    changed_.reset();
    byte_.reset();
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    const unsigned changed = in.symbol(changed_);
    for (unsigned i = 0; i < last_.size(); ++i)
      if (((changed >> i) & 1U) != 0) last_[i] = static_cast<unsigned char>(byte_.read(in, last_[i], i));
    std::copy(last_.begin(), last_.end(), bytes);
  }

 private:
  std::array<unsigned char, 6> last_{};
  SymbolModel<64> changed_;
  IntegerDecoder<8, 6> byte_;
};

class Rgb12V2 final : public PointwiseItem {
 public:
  void start(const unsigned char* first) override {
    last_ = load<StoredRgb>(first);
    models_.reset();
  }
  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    models_.read(in, last_);
    store(bytes, last_);
  }

 private:
  StoredRgb last_{};
  RgbModels models_;
};

}  // namespace

void RgbModels::reset() {
  changed_.reset();
  for (SymbolModel<256>& model : difference_) model.reset();
}

void RgbModels::read(ArithmeticDecoder& in, StoredRgb& color) {
  constexpr unsigned IS_COLORED = 64;  ///< else green and blue are as red
  const unsigned changed = in.symbol(changed_);
  const auto next_byte = [&](unsigned i, int last, int predicted) {
    return ((changed >> i) & 1U) == 0 ? last
                                      : (predicted + static_cast<int>(in.symbol(difference_[i]))) & 255;
  };
  const StoredRgb last = color;
  const auto low = [&](int channel) { return last[static_cast<std::size_t>(channel)] & 255; };
  const auto high = [&](int channel) { return last[static_cast<std::size_t>(channel)] >> 8; };
  const auto clamped = [](int value) { return std::clamp(value, 0, 255); };
  const int red_low = next_byte(0, low(0), low(0));
  const int red_high = next_byte(1, high(0), high(0));
  color[0] = static_cast<std::uint16_t>(red_low | (red_high << 8));
  if ((changed & IS_COLORED) == 0) {
    color[1] = color[2] = color[0];
    return;
  }
  // The low bytes of green and blue come before their high bytes.
  int change = red_low - low(0);
  const int green_low = next_byte(2, low(1), clamped(low(1) + change));
  change = (change + green_low - low(1)) / 2;
  const int blue_low = next_byte(4, low(2), clamped(low(2) + change));
  change = red_high - high(0);
  const int green_high = next_byte(3, high(1), clamped(high(1) + change));
  change = (change + green_high - high(1)) / 2;
  const int blue_high = next_byte(5, high(2), clamped(high(2) + change));
  color[1] = static_cast<std::uint16_t>(green_low | (green_high << 8));
  color[2] = static_cast<std::uint16_t>(blue_low | (blue_high << 8));
}

std::unique_ptr<PointwiseItem> make_rgb12(unsigned version) {
  if (version == 1) return std::make_unique<Rgb12V1>();
  return std::make_unique<Rgb12V2>();
}

}  // namespace splatray

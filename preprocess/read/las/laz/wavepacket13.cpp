#include <array>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/pointwise_item.h"

namespace splatray {
namespace {

/// What this decodes is not used, but what follows it in a record can be decoded only behind it.
class Wavepacket13 final : public PointwiseItem {
 public:
  void start(const unsigned char* first) override {
    last_offset_ = load<std::uint64_t>(first + 1);
    for (std::size_t i = 0; i < last_.size(); ++i) last_[i] = load<std::int32_t>(first + 9 + 4 * i);
    last_code_ = 0;
    last_difference_ = 0;
    index_.reset();
    for (auto& model : offset_code_) model.reset();
    offset_difference_.reset();
    size_.reset();
    return_point_.reset();
    direction_.reset();
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    bytes[0] = static_cast<unsigned char>(in.symbol(index_));
    read_offset(in);
    last_[0] = size_.read(in, last_[0], 0);
    last_[1] = return_point_.read(in, last_[1], 0);
    for (unsigned axis = 0; axis < 3; ++axis) last_[2 + axis] = direction_.read(in, last_[2 + axis], axis);
    store(bytes + 1, last_offset_);
    store(bytes + 9, last_);
  }

 private:
  void read_offset(ArithmeticDecoder& in) {
    enum Code : unsigned { SAME, BEHIND_LAST, NEAR };
    last_code_ = in.symbol(offset_code_[last_code_]);
    if (last_code_ == SAME) return;
    if (last_code_ == BEHIND_LAST) {
      last_offset_ += static_cast<std::uint32_t>(last_[0]);
    } else if (last_code_ == NEAR) {
      last_difference_ = offset_difference_.read(in, last_difference_, 0);
      last_offset_ += static_cast<std::uint64_t>(std::int64_t{last_difference_});
    } else {
      last_offset_ = in.bits64();
    }
  }

  std::uint64_t last_offset_ = 0;
  std::array<std::int32_t, 5> last_{};  ///< size, and the bits of return point and direction
  unsigned last_code_ = 0;
  std::int32_t last_difference_ = 0;
  SymbolModel<256> index_;
  std::array<SymbolModel<4>, 4> offset_code_;
  IntegerDecoder<32, 1> offset_difference_;
  IntegerDecoder<32, 1> size_;
  IntegerDecoder<32, 1> return_point_;
  IntegerDecoder<32, 3> direction_;
};

}  // namespace

std::unique_ptr<PointwiseItem> make_wavepacket13() { return std::make_unique<Wavepacket13>(); }

}  // namespace splatray

#include <algorithm>
#include <array>
#include <cstring>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/median.h"
#include "preprocess/read/las/laz/pointwise_item.h"

namespace splatray {
namespace {

/// A record's first 20 bytes.
struct Point10 {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint16_t intensity = 0;
  unsigned char returns = 0;  ///< return number, number of returns, direction, edge
  unsigned char classification = 0;
  unsigned char angle = 0;
  unsigned char user = 0;
  std::uint16_t source = 0;
};
static_assert(sizeof(Point10) == 20);

std::int32_t median_of_3(std::int32_t a, std::int32_t b, std::int32_t c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// A byte whose probabilities depend on what it was before.
class ByteAfterByte {
 public:
  void reset() {
    for (SymbolModel<256>& model : models_) model.reset();
  }
  void read(ArithmeticDecoder& in, unsigned char& byte) {
    byte = static_cast<unsigned char>(in.symbol(models_[byte]));
  }

 private:
  std::array<SymbolModel<256>, 256> models_;
};

/// What both versions have.
class Point10Item : public PointwiseItem {
 public:
  void start(const unsigned char* first) override {
    point_ = load<Point10>(first);
    changed_.reset();
    x_difference_.reset();
    y_difference_.reset();
    z_.reset();
    intensity_.reset();
    returns_.reset();
    classification_.reset();
    user_.reset();
    source_.reset();
  }

 protected:
  void read_source(ArithmeticDecoder& in) {
    point_.source = static_cast<std::uint16_t>(source_.read(in, point_.source, 0));
  }

  Point10 point_;
  SymbolModel<64> changed_;
  IntegerDecoder<32, 2> x_difference_;
  IntegerDecoder<32, 22> y_difference_;
  IntegerDecoder<32, 20> z_;
  IntegerDecoder<16, 4> intensity_;
  ByteAfterByte returns_;
  ByteAfterByte classification_;
  ByteAfterByte user_;

 private:
  IntegerDecoder<16, 1> source_;
};

class Point10V1 final : public Point10Item {
 public:
  void start(const unsigned char* first) override {
    Point10Item::start(first);
    angle_.reset();
    x_last_ = y_last_ = {};
    next_ = 0;
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    constexpr unsigned MOST_CONTEXT = 19;
    const std::int32_t x = x_difference_.read(in, median_of_3(x_last_[0], x_last_[1], x_last_[2]), 0);
    unsigned width = x_difference_.width();
    const std::int32_t y = y_difference_.read(in, median_of_3(y_last_[0], y_last_[1], y_last_[2]),
                                              std::min(width, MOST_CONTEXT));
    width = (width + y_difference_.width()) / 2;
    point_.x = add_wrapped(point_.x, x);
    point_.y = add_wrapped(point_.y, y);
    point_.z = z_.read(in, point_.z, std::min(width, MOST_CONTEXT));
    x_last_[next_] = x;
    y_last_[next_] = y;
    next_ = (next_ + 1) % x_last_.size();
    read_others(in, width);
    store(bytes, point_);
  }

 private:
  void read_others(ArithmeticDecoder& in, unsigned width) {
    const unsigned changed = in.symbol(changed_);
    if ((changed & 32U) != 0)
      point_.intensity = static_cast<std::uint16_t>(intensity_.read(in, point_.intensity, 0));
    if ((changed & 16U) != 0) returns_.read(in, point_.returns);
    if ((changed & 8U) != 0) classification_.read(in, point_.classification);
    if ((changed & 4U) != 0)
      point_.angle = static_cast<unsigned char>(angle_.read(in, point_.angle, width < 3 ? 1 : 0));
    if ((changed & 2U) != 0) user_.read(in, point_.user);
    if ((changed & 1U) != 0) read_source(in);
  }

  IntegerDecoder<8, 2> angle_;
  std::array<std::int32_t, 3> x_last_{};
  std::array<std::int32_t, 3> y_last_{};
  std::size_t next_ = 0;
};

/// By number of returns and return number, each 0 to 7: LASzip's contexts of returns, complete for those that cannot be.
constexpr unsigned char RETURN_CONTEXT_10[8][8] = {
    {15, 14, 13, 12, 11, 10, 9, 8},  {14, 0, 1, 3, 6, 10, 10, 9},    {13, 1, 2, 4, 7, 11, 11, 10},
    {12, 3, 4, 5, 8, 12, 12, 11},    {11, 6, 7, 8, 9, 13, 13, 12},   {10, 10, 11, 12, 13, 14, 14, 13},
    {9, 10, 11, 12, 13, 14, 15, 14}, {8, 9, 10, 11, 12, 13, 14, 15},
};

class Point10V2 final : public Point10Item {
 public:
  void start(const unsigned char* first) override {
    Point10Item::start(first);
    point_.intensity = 0;
    for (auto& model : angle_) model.reset();
    x_median_ = y_median_ = {};
    last_intensity_ = {};
    last_z_ = {};
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    const unsigned changed = in.symbol(changed_);
    if ((changed & 32U) != 0) returns_.read(in, point_.returns);
    const unsigned return_number = point_.returns & 7U;
    const unsigned returns = (point_.returns >> 3U) & 7U;
    const unsigned context = RETURN_CONTEXT_10[returns][return_number];
    if ((changed & 16U) != 0)
      last_intensity_[context] =
          static_cast<std::uint16_t>(intensity_.read(in, last_intensity_[context], std::min(context, 3U)));
    point_.intensity = last_intensity_[context];
    if ((changed & 15U) != 0) read_others(in, changed);
    read_position(in, context, returns == 1 ? 1 : 0,
                  std::max(returns, return_number) - std::min(returns, return_number));
    store(bytes, point_);
  }

 private:
  void read_others(ArithmeticDecoder& in, unsigned changed) {
    if ((changed & 8U) != 0) classification_.read(in, point_.classification);
    if ((changed & 4U) != 0)
      point_.angle =
          static_cast<unsigned char>(point_.angle + in.symbol(angle_[(point_.returns >> 6U) & 1U]));
    if ((changed & 2U) != 0) user_.read(in, point_.user);
    if ((changed & 1U) != 0) read_source(in);
  }

  void read_position(ArithmeticDecoder& in, unsigned context, unsigned is_single, unsigned level) {
    const std::int32_t x = x_difference_.read(in, x_median_[context].get(), is_single);
    x_median_[context].add(x);
    unsigned width = x_difference_.width();
    const std::int32_t y =
        y_difference_.read(in, y_median_[context].get(), is_single + (std::min(width, 20U) & ~1U));
    y_median_[context].add(y);
    width = (width + y_difference_.width()) / 2;
    last_z_[level] = z_.read(in, last_z_[level], is_single + (std::min(width, 18U) & ~1U));
    point_.x = add_wrapped(point_.x, x);
    point_.y = add_wrapped(point_.y, y);
    point_.z = last_z_[level];
  }

  std::array<SymbolModel<256>, 2> angle_;
  std::array<StreamingMedian, 16> x_median_;
  std::array<StreamingMedian, 16> y_median_;
  std::array<std::uint16_t, 16> last_intensity_{};
  std::array<std::int32_t, 8> last_z_{};
};

}  // namespace

std::unique_ptr<PointwiseItem> make_point10(unsigned version) {
  if (version == 1) return std::make_unique<Point10V1>();
  return std::make_unique<Point10V2>();
}

}  // namespace splatray

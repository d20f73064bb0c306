#include <vector>

#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/pointwise_item.h"

namespace splatray {
namespace {

/// Version 1: a difference's width depends on which byte it is; the rest is common to all.
class BytesV1 final : public PointwiseItem {
 public:
  explicit BytesV1(std::size_t count) : last_(count), width_(count) {}

  void start(const unsigned char* first) override {
    last_.assign(first, first + last_.size());
    for (auto& model : width_) model.reset();
    difference_.reset();
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    for (std::size_t i = 0; i < last_.size(); ++i)
      bytes[i] = last_[i] = static_cast<unsigned char>(last_[i] + difference_.read(in, width_[i]));
  }

 private:
  std::vector<unsigned char> last_;
  std::vector<DifferenceModels<8>::WidthModel> width_;
  DifferenceModels<8> difference_;
};

/// Version 2: each byte has its own probabilities of differences from the last.
class BytesV2 final : public PointwiseItem {
 public:
  explicit BytesV2(std::size_t count) : last_(count), difference_(count) {}

  void start(const unsigned char* first) override {
    last_.assign(first, first + last_.size());
    for (SymbolModel<256>& model : difference_) model.reset();
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    for (std::size_t i = 0; i < last_.size(); ++i)
      bytes[i] = last_[i] = static_cast<unsigned char>(last_[i] + in.symbol(difference_[i]));
  }

 private:
  std::vector<unsigned char> last_;
  std::vector<SymbolModel<256>> difference_;
};

}  // namespace

std::unique_ptr<PointwiseItem> make_bytes(unsigned version, std::size_t count) {
  if (version == 1) return std::make_unique<BytesV1>(count);
  return std::make_unique<BytesV2>(count);
}

}  // namespace splatray

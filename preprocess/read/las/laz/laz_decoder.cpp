#include "preprocess/read/las/laz/laz_decoder.h"

#include <algorithm>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/layered_item.h"
#include "preprocess/read/las/laz/pointwise_item.h"
#include "preprocess/read/las/laz/rgb.h"

namespace splatray {
namespace {

using Kind = LazItem::Kind;

class PointwiseDecoder final : public LazDecoder {
 public:
  explicit PointwiseDecoder(const LazLayout& layout) : record_bytes_(layout.record_bytes) {
    for (const LazItem& item : layout.items) items_.push_back({item.at, make(item)});
  }

  std::size_t start(std::span<const unsigned char> chunk, std::size_t points) override {
    if (chunk.size() < record_bytes_) return 0;
    first_ = chunk.data();
    is_first_ = true;
    for (auto& [at, item] : items_) item->start(first_ + at);
    in_.start(chunk.subspan(record_bytes_));
    return points;
  }

  void read(unsigned char* records, std::size_t count) override {
    if (is_first_ && count > 0) {
      std::copy_n(first_, record_bytes_, records);
      records += record_bytes_;
      --count;
      is_first_ = false;
    }
    for (; count > 0; --count, records += record_bytes_)
      for (auto& [at, item] : items_) item->read(in_, records + at);
  }

  [[nodiscard]] bool is_damaged() const override { return in_.is_damaged(); }
  [[nodiscard]] bool is_complete() const override { return in_.is_complete(); }
  [[nodiscard]] std::size_t consumed() const override { return record_bytes_ + in_.consumed(); }

 private:
  static std::unique_ptr<PointwiseItem> make(const LazItem& item) {
    switch (item.kind) {
      case Kind::point10:
        return make_point10(item.version);
      case Kind::gps_time11:
        return make_gps_time11(item.version);
      case Kind::rgb12:
        return make_rgb12(item.version);
      case Kind::wavepacket13:
        return make_wavepacket13();
      default:
        return make_bytes(item.version, item.size);
    }
  }

  std::size_t record_bytes_;
  /// By their place in the record.
  std::vector<std::pair<std::size_t, std::unique_ptr<PointwiseItem>>> items_;
  ArithmeticDecoder in_;
  const unsigned char* first_ = nullptr;
  bool is_first_ = false;
};

class LayeredDecoder final : public LazDecoder {
 public:
  LayeredDecoder(const LazLayout& layout, const std::vector<bool>& wanted) : layout_(layout) {
    std::size_t layers = 0;
    for (const LazItem& item : layout.items) {
      items_.push_back({item.at, layers, make(item, wanted)});
      const std::size_t infrared = item.at + sizeof(StoredRgb);
      if (item.kind == Kind::rgbnir14 && wanted[infrared])
        items_.push_back({infrared, layers + 1, make_infrared14(item.version)});
      layers += layer_count(item);
    }
    layers_.resize(layers);
  }

  std::size_t start(std::span<const unsigned char> chunk, std::size_t points) override {
    const std::size_t head = layered_head_bytes(layout_);
    if (chunk.size() < head) return 0;
    const LayeredChunk said = layered_chunk(layout_, chunk.data());
    if (said.bytes > chunk.size()) return 0;
    consumed_ = static_cast<std::size_t>(said.bytes);
    first_ = chunk.data();
    is_first_ = true;
    const unsigned char* sizes = first_ + layout_.record_bytes + 4;
    std::size_t at = head;
    for (auto& layer : layers_) {
      const auto bytes = load<std::uint32_t>(sizes);
      layer = chunk.subspan(at, bytes);
      at += bytes;
      sizes += 4;
    }
    const unsigned channel = (first_[15] >> 4U) & 3U;
    for (Part& part : items_)
      if (part.item)
        part.item->start(first_ + part.at, LazLayers(layers_).subspan(part.first_layer), channel);
    return std::min<std::size_t>(points, said.points);
  }

  void read(unsigned char* records, std::size_t count) override {
    if (is_first_ && count > 0) {
      std::copy_n(first_, layout_.record_bytes, records);
      records += layout_.record_bytes;
      --count;
      is_first_ = false;
    }
    channels_.resize(count);
    for (Part& part : items_)
      if (part.item) part.item->read(records + part.at, layout_.record_bytes, channels_);
  }

  [[nodiscard]] bool is_damaged() const override {
    return std::any_of(items_.begin(), items_.end(),
                       [](const Part& part) { return part.item && part.item->is_damaged(); });
  }
  [[nodiscard]] bool is_complete() const override {
    return std::all_of(items_.begin(), items_.end(),
                       [](const Part& part) { return !part.item || part.item->is_complete(); });
  }
  [[nodiscard]] std::size_t consumed() const override { return consumed_; }

 private:
  struct Part {
    std::size_t at;  ///< bytes from the record's begin
    std::size_t first_layer;
    std::unique_ptr<LayeredItem> item;  ///< null = not needed
  };

  static std::unique_ptr<LayeredItem> make(const LazItem& item, const std::vector<bool>& wanted) {
    const auto begin = wanted.begin() + static_cast<std::ptrdiff_t>(item.at);
    switch (item.kind) {
      case Kind::point14:
        return make_point14(item.version, {begin, begin + static_cast<std::ptrdiff_t>(item.size)});
      case Kind::rgb14:
      case Kind::rgbnir14:
        return make_rgb14(item.version);
      case Kind::bytes14:
        return make_bytes14(item.version, {begin, begin + static_cast<std::ptrdiff_t>(item.size)});
      default:
        return nullptr;
    }
  }

  LazLayout layout_;
  std::vector<Part> items_;
  std::vector<std::span<const unsigned char>> layers_;
  std::vector<unsigned char> channels_;
  const unsigned char* first_ = nullptr;
  bool is_first_ = false;
  std::size_t consumed_ = 0;
};

std::size_t all_layers(const LazLayout& layout) {
  std::size_t layers = 0;
  for (const LazItem& item : layout.items) layers += layer_count(item);
  return layers;
}

}  // namespace

std::unique_ptr<LazDecoder> make_laz_decoder(const LazLayout& layout, const std::vector<bool>& wanted) {
  if (layout.is_layered) return std::make_unique<LayeredDecoder>(layout, wanted);
  return std::make_unique<PointwiseDecoder>(layout);
}

std::size_t points_there(LazDecoder& decoder, std::span<const unsigned char> chunk, std::size_t points,
                         unsigned char* record) {
  points = decoder.start(chunk, points);
  for (std::size_t count = 1; count <= points; ++count) {
    decoder.read(record, 1);
    if (decoder.is_complete()) return count;
    if (decoder.is_damaged()) return 0;
  }
  return 0;
}

std::size_t layered_head_bytes(const LazLayout& layout) {
  return layout.record_bytes + 4 + 4 * all_layers(layout);
}

LayeredChunk layered_chunk(const LazLayout& layout, const unsigned char* head) {
  LayeredChunk chunk{load<std::uint32_t>(head + layout.record_bytes), layered_head_bytes(layout)};
  for (std::size_t i = 0; i < all_layers(layout); ++i)
    chunk.bytes += load<std::uint32_t>(head + layout.record_bytes + 4 + 4 * i);
  return chunk;
}

}  // namespace splatray

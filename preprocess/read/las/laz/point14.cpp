#include <algorithm>
#include <array>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/gps_time.h"
#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/layered_item.h"
#include "preprocess/read/las/laz/median.h"

namespace splatray {
namespace {

constexpr unsigned MOST_RETURNS = 16;

/// By number of returns and return number: LASzip's contexts of returns, complete for those that cannot be.
constexpr unsigned char RETURN_CONTEXT_14[MOST_RETURNS][MOST_RETURNS] = {
    {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5}, {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
    {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3}, {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5},
};

/// The fields of a record that are decoded.
struct Point14 {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint16_t intensity = 0;
  std::uint16_t source = 0;
  unsigned char return_number = 0;
  unsigned char returns = 0;
  unsigned char flags = 0;  ///< bits 0 to 3 of the class; 4, 5: direction, edge
  unsigned char classification = 0;
  unsigned char user = 0;
  std::int16_t angle = 0;
  std::uint64_t time = 0;
};

Point14 load_point(const unsigned char* bytes) {
  const unsigned flags = bytes[15];
  return {load<std::int32_t>(bytes),
          load<std::int32_t>(bytes + 4),
          load<std::int32_t>(bytes + 8),
          load<std::uint16_t>(bytes + 12),
          load<std::uint16_t>(bytes + 20),
          static_cast<unsigned char>(bytes[14] & 15U),
          static_cast<unsigned char>(bytes[14] >> 4U),
          static_cast<unsigned char>((flags & 15U) | ((flags >> 2U) & 48U)),
          bytes[16],
          bytes[17],
          load<std::int16_t>(bytes + 18),
          load<std::uint64_t>(bytes + 22)};
}

void store_point(unsigned char* bytes, const Point14& point, unsigned channel) {
  store(bytes, point.x);
  store(bytes + 4, point.y);
  store(bytes + 8, point.z);
  store(bytes + 12, point.intensity);
  bytes[14] = static_cast<unsigned char>(point.return_number | (point.returns << 4U));
  bytes[15] = static_cast<unsigned char>((point.flags & 15U) | (channel << 4U) | ((point.flags & 48U) << 2U));
  bytes[16] = point.classification;
  bytes[17] = point.user;
  store(bytes + 18, point.angle);
  store(bytes + 20, point.source);
  store(bytes + 22, point.time);
}

/// What is known of the points of one scanner channel.
struct Channel {
  bool is_met = false;
  bool time_changed = false;  ///< at the last point
  Point14 last;
  std::array<StreamingMedian, 12> x_median;
  std::array<StreamingMedian, 12> y_median;
  std::array<std::int32_t, 8> last_z{};
  std::array<std::uint16_t, 8> last_intensity{};

  std::array<SymbolModel<128>, 8> changed;
  SymbolModel<3> next_channel;
  std::array<SymbolModel<16>, MOST_RETURNS> returns;
  std::array<SymbolModel<16>, MOST_RETURNS> return_number;
  SymbolModel<13> return_number_of_same_time;
  IntegerDecoder<32, 2> x_difference;
  IntegerDecoder<32, 22> y_difference;
  IntegerDecoder<32, 20> z;
  std::array<SymbolModel<256>, 64> classification;
  std::array<SymbolModel<64>, 64> flags;
  IntegerDecoder<16, 4> intensity;
  IntegerDecoder<16, 2> angle;
  std::array<SymbolModel<256>, 64> user;
  IntegerDecoder<16, 1> source;
  GpsTimes times{false};

  void start(const Point14& first);
};

void Channel::start(const Point14& first) {
  is_met = true;
  time_changed = false;
  last = first;
  x_median = y_median = {};
  last_z.fill(first.z);
  last_intensity.fill(first.intensity);
  for (auto& model : changed) model.reset();
  next_channel.reset();
  for (auto& model : returns) model.reset();
  for (auto& model : return_number) model.reset();
  return_number_of_same_time.reset();
  x_difference.reset();
  y_difference.reset();
  z.reset();
  for (auto& model : classification) model.reset();
  for (auto& model : flags) model.reset();
  intensity.reset();
  angle.reset();
  for (auto& model : user) model.reset();
  source.reset();
  times.start(first.time);
}

/// A layer's bytes; without any, its field stays as it is.
struct Layer {
  ArithmeticDecoder in;
  bool changes = false;

  void start(std::span<const unsigned char> bytes) {
    changes = !bytes.empty();
    in.start(bytes);
  }
  [[nodiscard]] bool is_damaged() const { return changes && in.is_damaged(); }
  [[nodiscard]] bool is_complete() const { return !changes || in.is_complete(); }
};

class Point14Item final : public LayeredItem {
 public:
  Point14Item(unsigned version, const std::vector<bool>& wanted)
      : names_channel_always_(version >= 4), wants_user_(wanted[17]), wants_angle_(wanted[18]) {}

  void start(const unsigned char* first, LazLayers layers, unsigned channel) override {
    Layer* const all[] = {&position_, &z_,    &classification_, &flags_, &intensity_,
                          &angle_,    &user_, &source_,         &time_};
    for (std::size_t i = 0; i < std::size(all); ++i) all[i]->start(layers[i]);
    angle_.changes = angle_.changes && wants_angle_;
    user_.changes = user_.changes && wants_user_;
    has_no_positions_ = false;
    for (Channel& one : channels_) one.is_met = false;
    current_ = channel;
    channels_[channel].start(load_point(first));
  }

  void read(unsigned char* bytes, std::size_t stride, std::span<unsigned char> channels) override {
    has_no_positions_ = has_no_positions_ || (!channels.empty() && !position_.changes);
    for (unsigned char& channel : channels) {
      channel = static_cast<unsigned char>(read_point());
      store_point(bytes, channels_[current_].last, current_);
      bytes += stride;
    }
  }

  [[nodiscard]] bool is_damaged() const override {
    const auto layers = all();
    return has_no_positions_ ||
           std::any_of(layers.begin(), layers.end(), [](const Layer* layer) { return layer->is_damaged(); });
  }
  [[nodiscard]] bool is_complete() const override {
    const auto layers = all();
    return std::all_of(layers.begin(), layers.end(), [](const Layer* layer) { return layer->is_complete(); });
  }

 private:
  [[nodiscard]] std::array<const Layer*, 9> all() const {
    return {&position_, &z_, &classification_, &flags_, &intensity_, &angle_, &user_, &source_, &time_};
  }

  /// The channel for the record's other parts. Versions before 4 say 0 but where it changes.
  unsigned read_point() {
    Channel* channel = &channels_[current_];
    const bool was_first = channel->last.return_number == 1;
    const bool was_last = channel->last.return_number >= channel->last.returns;
    const unsigned changed = position_.in.symbol(
        channel->changed[(was_first ? 1 : 0) + (was_last ? 2 : 0) + (channel->time_changed ? 4 : 0)]);
    const bool other_channel = (changed & 64U) != 0;
    if (other_channel) channel = &change_channel();
    const bool time_changes = (changed & 16U) != 0;
    read_returns(*channel, changed, time_changes);
    read_position(*channel, time_changes ? 1 : 0);
    read_others(*channel, changed, time_changes ? 1 : 0);
    channel->time_changed = time_changes;
    return names_channel_always_ || other_channel ? current_ : 0;
  }

  Channel& change_channel() {
    const unsigned step = position_.in.symbol(channels_[current_].next_channel) + 1;
    const unsigned next = (current_ + step) % LazChannels::COUNT;
    if (!channels_[next].is_met) channels_[next].start(channels_[current_].last);
    current_ = next;
    return channels_[next];
  }

  void read_returns(Channel& channel, unsigned changed, bool time_changes) {
    Point14& point = channel.last;
    const unsigned last = point.return_number;
    if ((changed & 4U) != 0)
      point.returns = static_cast<unsigned char>(position_.in.symbol(channel.returns[point.returns]));
    unsigned now = last;
    switch (changed & 3U) {
      case 0:
        break;
      case 1:
        now = last + 1;
        break;
      case 2:
        now = last + MOST_RETURNS - 1;
        break;
      default:
        now = time_changes ? position_.in.symbol(channel.return_number[last])
                           : last + 2 + position_.in.symbol(channel.return_number_of_same_time);
    }
    point.return_number = static_cast<unsigned char>(now % MOST_RETURNS);
  }

  void read_position(Channel& channel, unsigned time_changes) {
    Point14& point = channel.last;
    const unsigned is_single = point.returns == 1 ? 1 : 0;
    const std::size_t median = RETURN_CONTEXT_14[point.returns][point.return_number] * 2U + time_changes;
    const std::int32_t x = channel.x_difference.read(position_.in, channel.x_median[median].get(), is_single);
    channel.x_median[median].add(x);
    unsigned width = channel.x_difference.width();
    const std::int32_t y = channel.y_difference.read(position_.in, channel.y_median[median].get(),
                                                     is_single + (std::min(width, 20U) & ~1U));
    channel.y_median[median].add(y);
    point.x = add_wrapped(point.x, x);
    point.y = add_wrapped(point.y, y);
    if (!z_.changes) return;
    width = (width + channel.y_difference.width()) / 2;
    const unsigned level =
        std::max(point.returns, point.return_number) - std::min(point.returns, point.return_number);
    std::int32_t& last_z = channel.last_z[std::min(level, 7U)];
    point.z = last_z = channel.z.read(z_.in, last_z, is_single + (std::min(width, 18U) & ~1U));
  }

  void read_others(Channel& channel, unsigned changed, unsigned time_changes) {
    Point14& point = channel.last;
    const unsigned place =
        (point.return_number == 1 ? 2 : 0) + (point.return_number >= point.returns ? 1 : 0);
    if (classification_.changes) {
      const unsigned context = (point.classification & 31U) * 2 + (place == 3 ? 1 : 0);
      point.classification =
          static_cast<unsigned char>(classification_.in.symbol(channel.classification[context]));
    }
    if (flags_.changes)
      point.flags = static_cast<unsigned char>(flags_.in.symbol(channel.flags[point.flags]));
    if (intensity_.changes) {
      std::uint16_t& last = channel.last_intensity[place * 2 + time_changes];
      point.intensity = last = static_cast<std::uint16_t>(channel.intensity.read(intensity_.in, last, place));
    }
    if (angle_.changes && (changed & 8U) != 0)
      point.angle = static_cast<std::int16_t>(channel.angle.read(angle_.in, point.angle, time_changes));
    if (user_.changes)
      point.user = static_cast<unsigned char>(user_.in.symbol(channel.user[point.user / 4U]));
    if (source_.changes && (changed & 32U) != 0)
      point.source = static_cast<std::uint16_t>(channel.source.read(source_.in, point.source, 0));
    if (time_.changes && time_changes != 0) point.time = channel.times.read(time_.in);
  }

  bool names_channel_always_, wants_user_, wants_angle_;
  /// Points were read, though their layer, which none goes without, is not there.
  bool has_no_positions_ = false;
  unsigned current_ = 0;
  Layer position_;
  Layer z_;
  Layer classification_;
  Layer flags_;
  Layer intensity_;
  Layer angle_;
  Layer user_;
  Layer source_;
  Layer time_;
  std::array<Channel, LazChannels::COUNT> channels_;
};

}  // namespace

std::unique_ptr<LayeredItem> make_point14(unsigned version, const std::vector<bool>& wanted) {
  return std::make_unique<Point14Item>(version, wanted);
}

}  // namespace splatray

#include "app/library/cut/pixel_borders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace splatray {
namespace {

constexpr double STRONG_PART = 0.25;    ///< of a line
constexpr std::size_t AHEAD = 10;       ///< borders by which a line's direction at its end is told
constexpr double GOES_ON_COSINE = 0.8;  ///< between two lines that are one

using BorderCorner = glm::ivec2;  ///< of pixels
constexpr std::array<BorderCorner, 4> BORDER_WAYS{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// From a corner at which not two borders meet to the next such, or all around.
struct BorderChain {
  std::vector<BorderCorner> corners;
  std::size_t strong = 0;
  bool closed = false;
};

struct BorderCornerLess {
  bool operator()(const BorderCorner& a, const BorderCorner& b) const {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  }
};

/// Unit direction from an end of a chain along it.
glm::dvec2 way_along(const BorderChain& chain, bool from_last) {
  const std::size_t last = chain.corners.size() - 1, ahead = std::min(AHEAD, last);
  const BorderCorner from = from_last ? chain.corners[last] : chain.corners[0];
  const BorderCorner to = from_last ? chain.corners[last - ahead] : chain.corners[ahead];
  const glm::dvec2 way(to - from);
  const double length = glm::length(way);
  return length > 0.0 ? way / length : glm::dvec2(0.0);
}

/// An end of a chain: twice its index, one more for its last corner.
using ChainEnd = std::size_t;

/// The end that each end goes on into.
std::vector<std::optional<ChainEnd>> continuations(const std::vector<BorderChain>& chains) {
  std::map<BorderCorner, std::vector<ChainEnd>, BorderCornerLess> at;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (chains[i].closed) continue;
    at[chains[i].corners.front()].push_back(2 * i);
    at[chains[i].corners.back()].push_back(2 * i + 1);
  }
  std::vector<std::optional<ChainEnd>> joints(2 * chains.size());
  for (const auto& [corner, ends] : at)
    while (true) {
      double best = -GOES_ON_COSINE;
      std::array<ChainEnd, 2> pair{};
      for (const ChainEnd a : ends)
        for (const ChainEnd b : ends) {
          if (a >= b || joints[a] || joints[b]) continue;
          const double cosine =
              glm::dot(way_along(chains[a / 2], a % 2 == 1), way_along(chains[b / 2], b % 2 == 1));
          if (cosine >= best) continue;
          best = cosine;
          pair = {a, b};
        }
      if (pair[0] == pair[1]) break;
      joints[pair[0]] = pair[1];
      joints[pair[1]] = pair[0];
    }
  return joints;
}

BorderLine border_line(const std::vector<BorderCorner>& corners, bool closed) {
  BorderLine line;
  line.closed = closed;
  if (!closed) line.points.emplace_back(corners.front());
  for (std::size_t i = 1; i < corners.size(); ++i)
    line.points.push_back(0.5 * glm::dvec2(corners[i - 1] + corners[i]));
  if (!closed) line.points.emplace_back(corners.back());
  return line;
}

/// The chains as far as they go on, without those of which too little is strong.
std::vector<BorderLine> joined_borders(const std::vector<BorderChain>& chains) {
  const std::vector<std::optional<ChainEnd>> joints = continuations(chains);
  std::vector<bool> is_done(chains.size());
  std::vector<BorderLine> lines;
  // First from ends, then around.
  for (const bool open : {true, false})
    for (ChainEnd start = 0; start < joints.size(); ++start) {
      if (is_done[start / 2] || (open && (joints[start] || chains[start / 2].closed))) continue;
      std::vector<BorderCorner> corners;
      std::size_t strong = 0;
      bool closed = chains[start / 2].closed;
      for (std::optional<ChainEnd> end = start; end; end = joints[*end ^ 1U]) {
        closed = closed || is_done[*end / 2];
        if (is_done[*end / 2]) break;
        is_done[*end / 2] = true;
        std::vector<BorderCorner> more = chains[*end / 2].corners;
        if (*end % 2 == 1) std::reverse(more.begin(), more.end());
        corners.insert(corners.end(), more.begin() + (corners.empty() ? 0 : 1), more.end());
        strong += chains[*end / 2].strong;
      }
      if (static_cast<double>(strong) >= STRONG_PART * static_cast<double>(corners.size() - 1))
        lines.push_back(border_line(corners, closed));
    }
  return lines;
}

}  // namespace

/// Follows marked borders from corner to corner.
class BorderTracer {
 public:
  explicit BorderTracer(const PixelBorders& borders) : left_(borders) {}

  /// All chains; none is left.
  std::vector<BorderChain> chains() {
    const PixelBorders all = left_;
    std::vector<BorderChain> found;
    for (const bool ends : {true, false})
      for (int y = 0; y <= height(); ++y)
        for (int x = 0; x <= width(); ++x) {
          if (ends && degree(all, {x, y}) == 2) continue;
          for (std::size_t way = 0; way < BORDER_WAYS.size(); ++way)
            if (mark(left_, {x, y}, way) != PixelBorders::none) found.push_back(chain_from(all, {x, y}));
        }
    return found;
  }

  /// How many marked borders meet at a corner.
  [[nodiscard]] static std::size_t degree(const PixelBorders& borders, const BorderCorner& at) {
    std::size_t count = 0;
    for (std::size_t way = 0; way < BORDER_WAYS.size(); ++way) count += mark(borders, at, way) != 0 ? 1 : 0;
    return count;
  }
  static void erase(PixelBorders& borders, const BorderChain& chain) {
    for (std::size_t i = 1; i < chain.corners.size(); ++i)
      for (std::size_t way = 0; way < BORDER_WAYS.size(); ++way)
        if (chain.corners[i - 1] + BORDER_WAYS[way] == chain.corners[i])
          *place(borders, chain.corners[i - 1], way) = 0;
  }

 private:
  [[nodiscard]] int width() const { return static_cast<int>(left_.width_); }
  [[nodiscard]] int height() const { return static_cast<int>(left_.height_); }

  /// The mark of the border that leads from a corner in one of BORDER_WAYS; null outside.
  template <typename Borders>
  static auto place(Borders& borders, const BorderCorner& at, std::size_t way)
      -> decltype(borders.right_.data()) {
    const bool is_level = way % 2 == 0;
    const BorderCorner pixel(is_level ? at.x - (way == 2 ? 1 : 0) : at.x - 1,
                             is_level ? at.y - 1 : at.y - (way == 3 ? 1 : 0));
    const int width = static_cast<int>(borders.width_), height = static_cast<int>(borders.height_);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width || pixel.y >= height) return nullptr;
    const std::size_t index =
        borders.index(static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y));
    return is_level ? &borders.below_[index] : &borders.right_[index];
  }
  static std::uint8_t mark(const PixelBorders& borders, const BorderCorner& at, std::size_t way) {
    const std::uint8_t* const found = place(borders, at, way);
    return found == nullptr ? 0 : *found;
  }

  BorderChain chain_from(const PixelBorders& all, const BorderCorner& start) {
    BorderChain chain{{start}};
    BorderCorner at = start;
    while (true) {
      std::size_t way = 0;
      while (way < BORDER_WAYS.size() && mark(left_, at, way) == PixelBorders::none) ++way;
      if (way == BORDER_WAYS.size()) break;
      std::uint8_t& mark_there = *place(left_, at, way);
      chain.strong += mark_there == PixelBorders::strong ? 1 : 0;
      mark_there = PixelBorders::none;
      at += BORDER_WAYS[way];
      chain.corners.push_back(at);
      if (degree(all, at) != 2) break;
    }
    chain.closed = at == start && degree(all, at) == 2;
    return chain;
  }

  PixelBorders left_;  ///< those that no chain has
};

PixelBorders::PixelBorders(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), right_(std::size_t{width} * height), below_(right_.size()) {}

std::vector<BorderLine> PixelBorders::lines(std::size_t spur) const {
  PixelBorders kept = *this;
  std::vector<BorderChain> chains = BorderTracer(kept).chains();
  for (const BorderChain& chain : chains) {
    const std::size_t first = BorderTracer::degree(*this, chain.corners.front()),
                      last = BorderTracer::degree(*this, chain.corners.back());
    if (std::min(first, last) == 1 && std::max(first, last) > 2 && chain.corners.size() <= spur)
      BorderTracer::erase(kept, chain);
  }
  return joined_borders(BorderTracer(kept).chains());
}

}  // namespace splatray

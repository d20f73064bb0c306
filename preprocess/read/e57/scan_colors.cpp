#include "preprocess/read/e57/scan_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/number_text.h"
#include "engine/base/release.h"

namespace splatray {
namespace {

constexpr glm::vec3 NONE{std::numeric_limits<float>::quiet_NaN()};
constexpr std::uint64_t ONE_OF = 200;  ///< as few values as ColorRange takes for outliers
/// Scales that are taken for each other differ by 4 and more (255, 1023, 4095); limits that cut off highlights by less.
constexpr double FAR_BEYOND = 2.0;
/// Encoded for display, the sixteenth part of full is seen as 1/200: nobody keeps a scan that is all darker.
constexpr double DARK = 1.0 / 16.0;

}  // namespace

void ScanColors::Group::add(const glm::dvec3& stored) {
  for (int channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    const double share = (stored[channel] - scale.low[c]) / (scale.high[c] - scale.low[c]);
    range.add(stored[channel]);
    count += share > 0.0 ? 1 : 0;
    beyond += share > FAR_BEYOND ? 1 : 0;
    bright += share > DARK ? 1 : 0;
  }
}

bool ScanColors::Group::fits() const {
  return beyond <= count / ONE_OF && (bright > count / ONE_OF || range.is_black());
}

void ScanColors::begin(std::size_t first, const ColorScale& scale) {
  const auto same =
      std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) { return group.scale == scale; });
  scans_.push_back({first, static_cast<std::size_t>(same - groups_.begin())});
  if (same == groups_.end()) groups_.push_back({scale, ColorRange(scale.is_float)});
  stored_.resize(first, NONE);
}

void ScanColors::add(const glm::dvec3& stored) {
  stored_.emplace_back(stored);
  if (!std::isnan(stored.x)) groups_[scans_.back().group].add(stored);
}

void ScanColors::rescale(const Group& group, std::size_t first, std::size_t last, Points& points) const {
  const double full = group.range.full() > 1.0 || group.scale.is_float ? group.range.full() : 255.0;
  for (std::size_t i = first; i < last; ++i)
    for (int channel = 0; channel < 3 && !std::isnan(stored_[i].x); ++channel)
      points.stored_color[i][channel] =
          stored_channel(std::min(255.0 * static_cast<double>(stored_[i][channel]) / full, 255.0));
}

void ScanColors::finish(Points& points, std::vector<std::string>& notes) {
  stored_.resize(points.stored_color.size(), NONE);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Group& group = groups_[scans_[i].group];
    if (group.fits()) continue;
    rescale(group, scans_[i].first, i + 1 < scans_.size() ? scans_[i + 1].first : stored_.size(), points);
    const std::string taken =
        "colours are taken as of 0 to " + number_text(std::max(group.range.full(), 1.0));
    notes.push_back(group.scale.is_stated ? taken + ", not to " + number_text(group.scale.high[0]) +
                                                " as the file says: its values speak against it"
                                          : taken);
  }
  release(stored_);
  const auto is_black = [](const glm::u16vec3& color) { return color == glm::u16vec3(0); };
  if (std::all_of(points.stored_color.begin(), points.stored_color.end(), is_black))
    points.stored_color_most = 0;
}

}  // namespace splatray

/// The picture of what moves: base colours (LOOK_SEEN) shaded by their distances, as bright as the picture at rest.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/display/display_table.h"
#include "engine/image/image.h"

namespace splatray {

/// Knows how bright pictures at rest are.
class MovingPicture {
 public:
  /// Learns from a picture at rest, `display` as Frame has it.
  void rest(const Image& image, const std::vector<std::uint8_t>& display);
  /// A picture of LOOK_SEEN as Frame::display: colours as they are, no tone curve or exposure on them but as on the surroundings,
  /// which `table` encodes.
  [[nodiscard]] std::vector<std::uint8_t> display(const Image& image, const View& view, double strength,
                                                  const DisplayTable& table);
  /// Forgets: another scene is shown.
  void forget() { *this = {}; }

 private:
  std::optional<double> rest_;  ///< brightness of the last picture at rest; unset: gain_ is matched to it
  float gain_ = 1.0F;
};

}  // namespace splatray

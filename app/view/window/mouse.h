/// Presses, moves and releases of the mouse as what a person means by them.
#pragma once
#include <chrono>
#include <optional>

#include "app/view/model/keys.h"
#include "app/view/window/window.h"

namespace splatray {

/// One step of a drag, a click or a turn of the wheel. Places are framebuffer pixels.
struct Gesture {
  Action action;
  glm::dvec2 from_px{0.0};  ///< drag: where the cursor was before this step
  glm::dvec2 to_px{0.0};    ///< where it is
  double notches = 0.0;     ///< of the wheel
};

/// Knows which button is down.
class Mouse {
 public:
  using Clock = std::chrono::steady_clock;

  /// What the input means by the table of keys.h. `over_controls`: presses and turns of the wheel are not for the picture.
  [[nodiscard]] std::optional<Gesture> take(const InputEvent& event, bool over_controls,
                                            Clock::time_point now);
  /// Whether a button is down over the picture.
  [[nodiscard]] bool is_held() const { return held_.has_value(); }
  /// Whether this drag goes on.
  [[nodiscard]] bool drags(Action action) const { return held_ && held_->drag == action; }

 private:
  struct Held {
    int button = 0;
    int modifiers = 0;
    glm::dvec2 start_px{0.0};
    glm::dvec2 last_px{0.0};
    std::optional<Action> drag;
    bool moved = false;
  };

  [[nodiscard]] std::optional<Gesture> move(glm::dvec2 position_px);
  [[nodiscard]] std::optional<Gesture> release(const InputEvent& event, Clock::time_point now);

  std::optional<Held> held_;  ///< pressed over the picture
  int clicked_button_ = -1;   ///< of the last click
  glm::dvec2 clicked_px_{0.0};
  Clock::time_point clicked_{};
};

}  // namespace splatray

#include "app/view/window/mouse.h"

#include <utility>

namespace splatray {
namespace {

constexpr double STILL_PX = 4.0;  ///< a press that moves less is a click
constexpr std::chrono::milliseconds DOUBLE_CLICK{350};

std::optional<Action> action_for(InputKind input, int button, int modifiers) {
  const std::optional<Command> command = command_for(input, button, modifiers);
  return command ? std::optional(command->action) : std::nullopt;
}

}  // namespace

std::optional<Gesture> Mouse::take(const InputEvent& event, bool over_controls, Clock::time_point now) {
  using Kind = InputEvent::Kind;
  switch (event.kind) {
    case Kind::press:
      if (!held_ && !over_controls)
        held_ = Held{event.code, event.modifiers, event.position_px, event.position_px,
                     action_for(InputKind::drag, event.code, event.modifiers)};
      return {};
    case Kind::move:
      return held_ ? move(event.position_px) : std::nullopt;
    case Kind::release:
      return held_ && held_->button == event.code ? release(event, now) : std::nullopt;
    case Kind::wheel:
      if (over_controls) return {};
      return Gesture{action_for(InputKind::wheel, 0, event.modifiers).value_or(Action::zoom),
                     event.position_px, event.position_px, event.notches};
    case Kind::key:
      break;
  }
  return {};
}

std::optional<Gesture> Mouse::move(glm::dvec2 position_px) {
  held_->moved = held_->moved || glm::distance(position_px, held_->start_px) > STILL_PX;
  if (!held_->moved) return {};
  const glm::dvec2 from = std::exchange(held_->last_px, position_px);
  return held_->drag ? std::optional(Gesture{*held_->drag, from, position_px}) : std::nullopt;
}

std::optional<Gesture> Mouse::release(const InputEvent& event, Clock::time_point now) {
  const Held held = *std::exchange(held_, {});
  if (held.moved) return {};
  const bool twice = clicked_button_ == held.button && now - clicked_ < DOUBLE_CLICK &&
                     glm::distance(clicked_px_, event.position_px) <= STILL_PX;
  clicked_button_ = twice ? -1 : held.button;
  clicked_ = now;
  clicked_px_ = event.position_px;
  const auto action =
      action_for(twice ? InputKind::double_click : InputKind::click, held.button, held.modifiers);
  return action ? std::optional(Gesture{*action, event.position_px, event.position_px}) : std::nullopt;
}

}  // namespace splatray

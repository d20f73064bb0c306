/// What each look shows, LOOK_* of shaders/layout.h. A look is its number there, its row here, its text in
/// shaders/light/transport.glsl and its name in --look.
#pragma once
#include <array>

#include "shaders/layout.h"

namespace splatray {

struct LookStyle {
  bool paths;      ///< light is followed from surface to surface
  bool materials;  ///< are seen
  bool colors;     ///< the points' colours are seen
  bool lights;     ///< lights light it
  bool opaque;     ///< nothing is looked through: glass shows both of its sides
};

[[nodiscard]] constexpr LookStyle look_style(std::uint32_t look) {
  constexpr std::array<LookStyle, 7> STYLES = {{{false, true, true, true, false},     // LOOK_PAPER
                                                {true, true, true, true, false},      // LOOK_LIT
                                                {true, false, false, true, true},     // LOOK_CLAY
                                                {false, false, false, false, true},   // LOOK_AO
                                                {false, false, true, true, true},     // LOOK_SCAN
                                                {false, false, true, false, false},   // LOOK_BASE
                                                {false, false, true, false, true}}};  // LOOK_SEEN
  return STYLES.at(look);
}

}  // namespace splatray

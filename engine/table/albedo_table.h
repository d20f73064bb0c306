/// What rough surfaces reflect in all: shaders/lang/albedo_layout.h. Made when the project is built (engine/table).
#pragma once
#include <span>

namespace splatray {

/// ALBEDO_WORDS numbers.
extern const std::span<const float> ALBEDO_TABLE;

}  // namespace splatray

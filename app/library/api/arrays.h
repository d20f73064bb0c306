/// Objects of arrays as preprocess takes them.
#pragma once
#include "app/library/splatray.h"
#include "preprocess/points.h"

namespace splatray::api {

/// Copies the arrays of an object. Throws Error (usage) where they do not fit each other.
[[nodiscard]] InputObject input_object(const Points& points);
[[nodiscard]] InputObject input_object(const Mesh& mesh);

}  // namespace splatray::api

/// Joins arrays of points, some of which have what others lack.
#pragma once
#include <utility>
#include <vector>

#include "engine/base/release.h"
#include "engine/scene/columns.h"

namespace splatray {

/// Appends `more`, `size` values of one array; an array that is absent on one side gets `absent` there.
template <typename Value>
void append(std::vector<Value>& to, std::size_t to_size, std::vector<Value>&& more, std::size_t size,
            const Value& absent) {
  if (to.empty() && more.empty()) return;
  if (to_size == 0) {
    to = std::move(more);
    return;
  }
  to.resize(to_size, absent);
  if (more.empty()) {
    to.resize(to_size + size, absent);
  } else {
    to.insert(to.end(), more.begin(), more.end());
    release(more);
  }
}

/// The same for all attributes: one that is absent on one side is absent_value() (texture_factors.h) there; where both store it differently, it becomes the
/// wider type. Attributes of no points are none.
void append_columns(std::vector<Column>& to, std::size_t to_size, std::vector<Column>&& more,
                    std::size_t size);

}  // namespace splatray

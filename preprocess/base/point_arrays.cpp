#include "preprocess/base/point_arrays.h"

#include "preprocess/base/append.h"

namespace splatray {

void append_points(Points& to, Points&& more) {
  const std::size_t to_size = to.size(), size = more.size();
  append_columns(to.columns, to_size, std::move(more.columns), size);
  const auto append_array = [&](const auto& array) {
    append(to.*array.values, to_size, std::move(more.*array.values), size, array.absent);
  };
  std::apply([&](const auto&... arrays) { (append_array(arrays), ...); }, POINT_ARRAYS);
}

}  // namespace splatray

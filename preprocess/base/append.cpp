#include "preprocess/base/append.h"

#include <algorithm>
#include <type_traits>

#include "engine/scene/texture_factors.h"

namespace splatray {
namespace {

template <typename Value>
std::vector<Value> converted(const Column& column) {
  return std::visit(
      [](const auto& list) {
        std::vector<Value> values(list.size());
        std::transform(list.begin(), list.end(), values.begin(),
                       [](auto value) { return static_cast<Value>(value); });
        return values;
      },
      column.values);
}

/// Appends one attribute; where two files store it differently, as the wider type.
void append_column(Column& to, std::size_t to_size, Column&& more, std::size_t size) {
  if (more.values.index() > to.values.index() && more.size() > 0)
    std::visit(
        [&to](auto& list) {
          using Value = typename std::decay_t<decltype(list)>::value_type;
          to.values = converted<Value>(to);
        },
        more.values);
  edit_values(to, [&](auto& list) {
    using Value = typename std::decay_t<decltype(list)>::value_type;
    std::vector<Value> values = std::holds_alternative<Pool<Value>>(more.values)
                                    ? std::move(std::get<Pool<Value>>(more.values).edit())
                                    : converted<Value>(more);
    append(list, to_size, std::move(values), size, static_cast<Value>(absent_value(to.name)));
  });
}

std::size_t number_of(const std::vector<Column>& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&name](const Column& column) { return column.name == name; });
  return static_cast<std::size_t>(found - columns.begin());
}

}  // namespace

void append_columns(std::vector<Column>& to, std::size_t to_size, std::vector<Column>&& more,
                    std::size_t size) {
  if (size == 0) return;
  for (Column& column : more) {
    const std::size_t i = number_of(to, column.name);
    if (i == to.size()) to.push_back({column.name, Pool<std::uint8_t>()});
    append_column(to[i], to_size, std::move(column), size);
  }
  for (Column& column : to)
    if (number_of(more, column.name) == more.size())
      append_column(column, to_size, {column.name, Pool<std::uint8_t>()}, size);
}

}  // namespace splatray

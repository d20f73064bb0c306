/// Attributes that were asked for and that nothing has.
#pragma once
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/columns.h"
#include "preprocess/base/quoted_list.h"

namespace splatray {

/// Whether an attribute's name asks for a column: for that of this name or, of vectors, for all their components ("name[0]").
[[nodiscard]] inline bool asks_for(const std::string& asked, std::string_view column) {
  return column == asked || (!asked.empty() && column.starts_with(asked + "["));
}

/// Whether one of the names asks for it.
[[nodiscard]] inline bool is_asked_for(const std::vector<std::string>& asked, std::string_view column) {
  return std::any_of(asked.begin(), asked.end(),
                     [column](const std::string& name) { return asks_for(name, column); });
}

/// Whether one of the columns is asked for by the name.
[[nodiscard]] inline bool has_attribute(const std::vector<Column>& columns, const std::string& name) {
  return std::any_of(columns.begin(), columns.end(),
                     [&name](const Column& column) { return asks_for(name, column.name); });
}

/// A sentence that names those of the attributes which `has(name)` is false of; empty where there are none.
template <class Has>
[[nodiscard]] std::string missing_attributes(const std::vector<std::string>& asked, const Has& has) {
  std::vector<std::string> missing;
  std::copy_if(asked.begin(), asked.end(), std::back_inserter(missing),
               [&has](const std::string& name) { return !has(name); });
  if (missing.empty()) return {};
  return "--attributes: no input has " + quoted_list(missing) + "; splatray-info lists what a file has";
}

/// The same of a scene that is there.
[[nodiscard]] inline std::string missing_attributes(const std::vector<std::string>& asked,
                                                    const std::vector<Column>& columns) {
  return missing_attributes(asked,
                            [&columns](const std::string& name) { return has_attribute(columns, name); });
}

}  // namespace splatray

/// Attributes that were asked for and that nothing has.
#pragma once
#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "engine/scene/columns.h"
#include "preprocess/base/quoted_list.h"

namespace splatray {

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
  return missing_attributes(
      asked, [&columns](const std::string& name) { return find_column(columns, name) != nullptr; });
}

}  // namespace splatray

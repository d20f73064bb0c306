#include "preprocess/read/gltf/gltf_attributes.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/narrow_column.h"

namespace splatray {
namespace {

/// Whether the specification says what the attribute is, and all of it is read, or is none of a surface at rest.
bool is_of_gltf(std::string_view name) {
  constexpr std::string_view WHOLE[] = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
  constexpr std::string_view BEGIN[] = {"TEXCOORD_", "JOINTS_", "WEIGHTS_"};
  return std::find(std::begin(WHOLE), std::end(WHOLE), name) != std::end(WHOLE) ||
         std::any_of(std::begin(BEGIN), std::end(BEGIN), [&](auto begin) { return name.starts_with(begin); });
}

Column read_column(const GltfFile& file, const std::string& name, int accessor, std::size_t vertex_count) {
  const std::vector<float> numbers = read_floats(file, accessor, 1, name);
  if (numbers.size() != vertex_count)
    file.fail(name + ": found " + std::to_string(numbers.size()) + " elements, POSITION has " +
              std::to_string(vertex_count));
  const std::string known = known_columns({name}).front();
  return narrow_column(known.empty() ? name.substr(1) : known, {numbers.begin(), numbers.end()});
}

}  // namespace

std::vector<Column> read_added_attributes(const GltfFile& file, const tinygltf::Primitive& primitive,
                                          std::size_t vertex_count, std::vector<std::string>& notes) {
  std::vector<Column> columns;
  std::vector<std::string> skipped;
  for (const auto& [name, number] : primitive.attributes) {
    if (is_of_gltf(name)) continue;
    const std::size_t accessor = file.checked(number, file.model.accessors.size(), "accessor");
    const bool is_read = primitive.mode == TINYGLTF_MODE_POINTS && name.starts_with('_') && name.size() > 1 &&
                         file.model.accessors[accessor].type == TINYGLTF_TYPE_SCALAR &&
                         columns.size() < GLTF_COLUMNS_MOST;
    if (is_read)
      columns.push_back(read_column(file, name, number, vertex_count));
    else
      skipped.push_back(name);
  }
  if (!skipped.empty())
    notes.push_back(file.path.string() + ": skipped attributes " + quoted_list(skipped) + " of a primitive");
  return columns;
}

}  // namespace splatray

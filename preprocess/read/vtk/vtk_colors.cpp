#include "preprocess/read/vtk/vtk_colors.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/base/srgb.h"
#include "engine/base/utf8.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {
namespace {

/// As ParaView, PyVista, PCL, CloudCompare and Open3D call them; compared by plain_name.
constexpr std::string_view COLOR_NAMES[] = {"rgb",         "rgba",        "color",    "colors",
                                            "colour",      "colours",     "rgbcolor", "diffusecolor",
                                            "vertexcolor", "vertexcolors"};

bool has_channels(vtkDataArray* array, vtkIdType count) {
  return array != nullptr && array->GetNumberOfTuples() == count &&
         (array->GetNumberOfComponents() == 3 || array->GetNumberOfComponents() == 4);
}

/// One array of three channels or three of one; empty where there are no colours.
std::vector<vtkDataArray*> find_colors(vtkPointData* attributes, vtkIdType count) {
  if (auto* scalars = vtkUnsignedCharArray::SafeDownCast(attributes->GetScalars());
      has_channels(scalars, count))
    return {scalars};
  std::vector<std::string> names;
  std::vector<vtkDataArray*> single;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = attributes->GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    const std::string name = to_utf8(array->GetName());
    const bool is_color =
        std::find(std::begin(COLOR_NAMES), std::end(COLOR_NAMES), plain_name(name)) != std::end(COLOR_NAMES);
    if (is_color && has_channels(array, count)) return {array};
    if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != count) continue;
    names.push_back(name);
    single.push_back(array);
  }
  std::vector<vtkDataArray*> channels;
  const std::vector<std::string> meanings = known_columns(names);
  for (const std::string_view channel : COLUMN_COLORS)
    if (const auto found = std::find(meanings.begin(), meanings.end(), channel); found != meanings.end())
      channels.push_back(single[static_cast<std::size_t>(found - meanings.begin())]);
  return channels.size() == 3 ? channels : std::vector<vtkDataArray*>{};
}

bool is_float(vtkDataArray* array) {
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

}  // namespace

std::vector<vtkDataArray*> read_vtk_colors(vtkPointData* attributes, const std::filesystem::path& path,
                                           const ReadListener& listener, Points& points) {
  const std::vector<vtkDataArray*> arrays = find_colors(attributes, static_cast<vtkIdType>(points.size()));
  if (arrays.empty()) return arrays;
  points.color.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) {
      vtkDataArray* array = arrays.size() == 3 ? arrays[static_cast<std::size_t>(channel)] : arrays[0];
      points.color[i][channel] = static_cast<float>(
          array->GetComponent(static_cast<vtkIdType>(i), arrays.size() == 3 ? 0 : channel));
    }
  if (arrays[0]->GetDataType() == VTK_UNSIGNED_CHAR) {
    for (glm::vec3& color : points.color)
      for (int channel = 0; channel < 3; ++channel) color[channel] = srgb_to_linear(color[channel] / 255.0F);
  } else if (const std::string said = decode_colors(points.color, is_float(arrays[0])); !said.empty()) {
    listener.note(path, said);
  }
  return arrays;
}

}  // namespace splatray

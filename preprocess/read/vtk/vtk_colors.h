/// Colours of VTK's points.
#pragma once
#include <filesystem>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

class vtkDataArray;
class vtkPointData;

namespace splatray {

/// Fills the points' colours from the active scalars where these are three or four bytes, as VTK's own colours are; else from
/// an array of three or four numbers of any type that is named as a colour (RGB, Colors), or from three arrays (Red, Green,
/// Blue), whose scale ColorRange finds. The arrays used, none where there are no colours.
[[nodiscard]] std::vector<vtkDataArray*> read_vtk_colors(vtkPointData* attributes,
                                                         const std::filesystem::path& path,
                                                         const ReadListener& listener, Points& points);

}  // namespace splatray

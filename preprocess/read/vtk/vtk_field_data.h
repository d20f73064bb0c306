/// What VTK's files say of all points together, and what of them is not read.
#pragma once
#include <filesystem>
#include <vector>

#include "preprocess/base/splat_marks.h"
#include "preprocess/read/read_listener.h"

class vtkDataSet;

namespace splatray {

/// The marks among a data set's field data: lists of texts by their keys.
[[nodiscard]] std::vector<SplatMark> read_vtk_marks(vtkDataSet* data);

/// Names in notes what is not read: arrays that are not named or have not one number for each point, values of cells, and
/// field data that are no marks.
void note_vtk_left_out(vtkDataSet* data, const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray

#include "preprocess/read/vtk/vtk_cells_check.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <map>
#include <string>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

constexpr vtkIdType ANY = -1;

/// Points of a cell of each type that is read; ANY = one or more. Those of Lagrange and Bezier are left out: their numbers of
/// points depend on orders that stand elsewhere.
const std::map<int, vtkIdType> CELL_POINTS{
    {VTK_EMPTY_CELL, 0},
    {VTK_VERTEX, 1},
    {VTK_POLY_VERTEX, ANY},
    {VTK_LINE, 2},
    {VTK_POLY_LINE, ANY},
    {VTK_TRIANGLE, 3},
    {VTK_TRIANGLE_STRIP, ANY},
    {VTK_POLYGON, ANY},
    {VTK_PIXEL, 4},
    {VTK_QUAD, 4},
    {VTK_TETRA, 4},
    {VTK_VOXEL, 8},
    {VTK_HEXAHEDRON, 8},
    {VTK_WEDGE, 6},
    {VTK_PYRAMID, 5},
    {VTK_PENTAGONAL_PRISM, 10},
    {VTK_HEXAGONAL_PRISM, 12},
    {VTK_QUADRATIC_EDGE, 3},
    {VTK_QUADRATIC_TRIANGLE, 6},
    {VTK_QUADRATIC_QUAD, 8},
    {VTK_BIQUADRATIC_QUAD, 9},
    {VTK_BIQUADRATIC_TRIANGLE, 7},
    {VTK_QUADRATIC_LINEAR_QUAD, 6},
    {VTK_QUADRATIC_TETRA, 10},
    {VTK_QUADRATIC_HEXAHEDRON, 20},
    {VTK_TRIQUADRATIC_HEXAHEDRON, 27},
    {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24},
    {VTK_QUADRATIC_WEDGE, 15},
    {VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18},
    {VTK_QUADRATIC_LINEAR_WEDGE, 12},
    {VTK_QUADRATIC_PYRAMID, 13},
    {VTK_POLYHEDRON, ANY},
};

void check_ids(vtkCellArray* cells, vtkIdType points, const std::filesystem::path& path) {
  if (cells == nullptr) return;
  if (!cells->IsValid()) throw_unreadable(path, "the offsets of its cells do not fit their connectivity");
  vtkIdType length = 0;
  const vtkIdType* ids = nullptr;
  cells->InitTraversal();
  while (cells->GetNextCell(length, ids) != 0)
    for (vtkIdType i = 0; i < length; ++i)
      if (ids[i] < 0 || ids[i] >= points)
        throw_unreadable(path, "a cell uses vertex " + std::to_string(ids[i]) + ", expected less than " +
                                   std::to_string(points));
}

/// A polyhedron's faces: how many, then of each the number of its points and these.
void check_faces(vtkUnstructuredGrid* grid, vtkIdType cell, const std::filesystem::path& path) {
  vtkIdTypeArray* faces = grid->GetFaces();
  vtkIdTypeArray* locations = grid->GetFaceLocations();
  const auto fail = [&path, cell] {
    throw_unreadable(path, "the faces of polyhedron " + std::to_string(cell) + " do not fit its points");
  };
  if (faces == nullptr || locations == nullptr || locations->GetNumberOfValues() <= cell) fail();
  const vtkIdType size = faces->GetNumberOfValues();
  vtkIdType at = locations->GetValue(cell);
  if (at < 0 || at >= size) fail();
  const vtkIdType count = faces->GetValue(at++);
  for (vtkIdType face = 0; face < count; ++face) {
    if (at >= size) fail();
    const vtkIdType points = faces->GetValue(at++);
    if (points < 3 || points > size - at) fail();
    for (const vtkIdType end = at + points; at < end; ++at)
      if (faces->GetValue(at) < 0 || faces->GetValue(at) >= grid->GetNumberOfPoints()) fail();
  }
  if (count < 1) fail();
}

void check_grid(vtkUnstructuredGrid* grid, const std::filesystem::path& path) {
  check_ids(grid->GetCells(), grid->GetNumberOfPoints(), path);
  const vtkIdType cells = grid->GetNumberOfCells();
  if (cells > 0 && grid->GetCellTypesArray()->GetNumberOfValues() != cells)
    throw_unreadable(path, "found " + std::to_string(grid->GetCellTypesArray()->GetNumberOfValues()) +
                               " types of cells, expected " + std::to_string(cells));
  for (vtkIdType cell = 0; cell < cells; ++cell) {
    const int type = grid->GetCellType(cell);
    const auto known = CELL_POINTS.find(type);
    if (known == CELL_POINTS.end())
      throw_unreadable(path, "found a cell of type " + std::to_string(type) +
                                 ", expected linear and quadratic cells and polyhedra");
    const vtkIdType points = grid->GetCells()->GetCellSize(cell);
    if (known->second == ANY ? points < 1 : points != known->second)
      throw_unreadable(path, "found a cell of type " + std::to_string(type) + " with " +
                                 std::to_string(points) + " points, expected " +
                                 (known->second == ANY ? "some" : std::to_string(known->second)));
    if (type == VTK_POLYHEDRON) check_faces(grid, cell, path);
  }
}

void check_dimensions(const int* dimensions, vtkIdType points, const std::filesystem::path& path) {
  vtkIdType product = 1;
  for (int axis = 0; axis < 3; ++axis) product *= dimensions[axis];
  if (product != points)
    throw_unreadable(path, "found " + std::to_string(points) + " points, expected " +
                               std::to_string(product) + ", as its dimensions say");
}

}  // namespace

void check_vtk_cells(vtkDataSet* data, const std::filesystem::path& path) {
  if (auto* surface = vtkPolyData::SafeDownCast(data)) {
    for (vtkCellArray* cells :
         {surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips()})
      check_ids(cells, surface->GetNumberOfPoints(), path);
  } else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data)) {
    check_grid(grid, path);
  } else if (auto* curves = vtkStructuredGrid::SafeDownCast(data)) {
    const vtkIdType points = curves->GetPoints() == nullptr ? 0 : curves->GetPoints()->GetNumberOfPoints();
    check_dimensions(curves->GetDimensions(), points, path);
  } else if (auto* axes = vtkRectilinearGrid::SafeDownCast(data)) {
    vtkIdType points = 1;
    for (vtkDataArray* axis : {axes->GetXCoordinates(), axes->GetYCoordinates(), axes->GetZCoordinates()})
      points *= axis == nullptr ? 0 : axis->GetNumberOfTuples();
    check_dimensions(axes->GetDimensions(), points, path);
  } else {
    throw_unreadable(path,
                     "found " + std::string(data->GetClassName()) + ", expected points, a surface or a grid");
  }
}

}  // namespace splatray

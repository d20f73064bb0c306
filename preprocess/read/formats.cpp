#include "preprocess/read/formats.h"

#include "preprocess/base/file_extension.h"
#include "preprocess/read/e57/read_e57.h"
#include "preprocess/read/gltf/read_gltf.h"
#include "preprocess/read/las/copc.h"
#include "preprocess/read/las/read_las.h"
#include "preprocess/read/pcd/read_pcd.h"
#include "preprocess/read/ply/read_ply.h"
#include "preprocess/read/read_obj.h"
#include "preprocess/read/read_stl.h"
#include "preprocess/read/scan/read_kitti.h"
#include "preprocess/read/text/read_pts.h"
#include "preprocess/read/text/read_ptx.h"
#include "preprocess/read/text/read_xyz.h"
#include "preprocess/read/tiles/ept.h"
#include "preprocess/read/tiles/read_vpc.h"
#include "preprocess/read/vtk/read_vtk.h"

namespace splatray {
namespace {

/// A reader of meshes that has no options.
template <Mesh (*read)(const std::filesystem::path&, const ReadListener&)>
Mesh without_options(const std::filesystem::path& path, const ReadOptions& /*options*/,
                     const ReadListener& listener) {
  return read(path, listener);
}

constexpr Format READ_FORMATS[] = {
    {".ply", "ASCII and binary of both endians, all types; positions, normals, colours, radius; triangles",
     read_ply, nullptr, nullptr},
    {".obj", "points or triangles; normals, colours", without_options<read_obj>, nullptr, nullptr},
    {".stl", "triangles, ASCII and binary", without_options<read_stl>, nullptr, nullptr},
    {".vtk .vtp .vtu .pvtp .pvtu",
     "VTK's points, faces, outer faces of volumes, pieces; normals, colours, radius, all arrays at points",
     without_options<read_vtk>, nullptr, nullptr},
    {".gltf .glb",
     "node transforms, triangles, `POINTS` with attributes `_NAME`, `pbrMetallicRoughness`, transmission, "
     "ior, punctual lights, cameras",
     nullptr, read_gltf, nullptr},
    {".las .laz",
     "LAS 1.0 to 1.5 with point formats 0 to 10, compressed by LASzip, COPC; colours, normals, "
     "radius, attributes, extra bytes",
     nullptr, nullptr, read_las, copc_levels},
    {"ept.json", "Entwine point tiles of LAZ or of records, packed by Zstandard or not, as files beside it",
     nullptr, nullptr, read_ept, ept_levels},
    {".vpc", "virtual point clouds: scans that it names", nullptr, nullptr, nullptr, nullptr, read_vpc},
    {".e57",
     "scans with their poses and grids, cartesian or spherical; colours, intensity, normals; all bit widths",
     nullptr, nullptr, read_e57},
    {".pcd", "ascii, binary and compressed; grids, viewpoint, normals, colours, intensity", nullptr, nullptr,
     read_pcd},
    {".ptx", "scans in their grids, with transforms; intensity, colours", nullptr, nullptr, read_ptx},
    {".pts", "points as text, counted or not; intensity, colours, normals, or columns by header", nullptr,
     nullptr, read_pts},
    {".xyz .csv .txt .asc",
     "points as text, columns by header, `--columns` or their values; ESRI's ASCII grids", nullptr, nullptr,
     read_xyz},
    {".bin", "sweeps of KITTI or nuScenes: float32 x y z reflectance, ring", nullptr, nullptr, read_kitti},
};

}  // namespace

std::span<const Format> formats() { return READ_FORMATS; }

const Format* find_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path), name = lower_case(path.filename().string());
  for (const Format& format : READ_FORMATS) {
    const std::string padded = " " + std::string(format.extensions) + " ";
    const auto has = [&](const std::string& word) {
      return !word.empty() && padded.find(" " + word + " ") != std::string::npos;
    };
    if (has(extension) || has(name)) return &format;
  }
  return nullptr;
}

Levels levels_of(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  return format == nullptr || format->read_levels == nullptr ? Levels{} : format->read_levels(path);
}

std::string format_extensions(bool meshes_only) {
  std::string all;
  for (const Format& format : READ_FORMATS) {
    if (!meshes_only || format.read_mesh != nullptr) {
      (all += all.empty() ? "" : " ") += format.extensions;
    }
  }
  return all;
}

}  // namespace splatray

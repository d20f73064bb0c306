/// A sheet's picture as a file, and the files beside it that say where it lies.
#pragma once
#include <filesystem>

#include "app/library/image_file.h"
#include "app/library/request/request.h"
#include "engine/image/image.h"

namespace splatray {

/// Throws Error (failed), which says what to install, where what writes height rasters, and sheets other than PNG and EXR, is
/// not there.
void require_sheet_writer();

/// Writes a sheet in the format of its name: .tif, a GeoTIFF of 8 bits; .svg or .pdf, a page with the picture at its scale, and
/// grid, bar and title around it as lines and letters. Throws Error (failed).
void write_sheet(const Request& request, const DisplayImage& picture, const Metadata& metadata,
                 const std::filesystem::path& path);

/// Writes what says where the pixels of a file lie, below its name: NAME.sheet.json; beside a PNG or TIFF a world file (ESRI;
/// centre of the top left pixel), beside a PNG with a known system NAME.png.aux.xml (GDAL) and NAME.prj; and --height-raster.
/// Throws Error (failed).
void write_sheet_places(const Request& request, const Image& image, const std::filesystem::path& path);

}  // namespace splatray

/// A sheet's picture as a file, and the files beside it that say where it lies.
#pragma once
#include <filesystem>

#include "app/library/image_file.h"
#include "app/library/shot/shot.h"
#include "engine/file/atomic_file.h"
#include "engine/image/image.h"

namespace splatray {

/// Throws Error (failed), which says what to install, where what writes height rasters, and sheets other than PNG and EXR, is
/// not there.
void require_sheet_writer();

/// Lays the page of a sheet out before its picture is made. Throws Error (usage) where the paper that is asked for is too small for it.
void require_page(const Shot& shot);

/// A sheet's file in the format of its name: .tif, a GeoTIFF of 8 bits; .svg or .pdf, a page with the picture at its scale, and
/// all else as lines and letters (sheet_page.h); .dxf, lines alone (sheet_dxf.h). Throws Error (failed).
[[nodiscard]] std::vector<unsigned char> encode_sheet(const Shot& shot, const DisplayImage& picture,
                                                      const Metadata& metadata,
                                                      const std::filesystem::path& path);

/// Files beside a sheet's that say where its pixels lie; empty ones are not written.
struct SheetPlaces {
  std::filesystem::path description;  ///< NAME.EXTENSION.sheet.json
  /// Beside a PNG or TIFF: NAME.pgw, NAME.tfw (ESRI; centre of the top left pixel).
  std::filesystem::path world_file;
  std::filesystem::path crs;          ///< beside a PNG with a known system: NAME.prj
  std::filesystem::path crs_of_gdal;  ///< and NAME.png.aux.xml (GDAL)
};
[[nodiscard]] SheetPlaces sheet_places(const std::filesystem::path& path);

/// Adds those of a sheet's file, and --height-raster. Throws Error (failed).
void add_sheet_places(const Shot& shot, const Image& image, const std::filesystem::path& path,
                      FileSet& files);

}  // namespace splatray

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

/// Lays the pages of a sheet, or of several, out before a picture is made. Throws Error (usage) where the paper that is asked for is too
/// small for them.
void require_page(const Shot& shot);

/// A sheet's file in the format of its name: .tif, a GeoTIFF of 8 bits; .svg or .pdf, a page with the picture at its scale, and
/// all else as lines and letters (sheet_page.h); .dxf, lines alone (sheet_dxf.h). Throws Error (failed).
[[nodiscard]] std::vector<unsigned char> encode_sheet(const Shot& shot, const DisplayImage& picture,
                                                      const Metadata& metadata,
                                                      const std::filesystem::path& path);

/// A sheet of a set with its lines, and its picture; of a DXF without pixels.
struct SheetPicture {
  Sheet sheet;
  DisplayImage picture;
};

/// The file of a shot's set of sheets, .pdf, .svg or .dxf: the pages, or the drawing, of all of them. Throws Error (failed).
[[nodiscard]] std::vector<unsigned char> encode_sheets(const Shot& shot, std::vector<SheetPicture> made,
                                                       const std::filesystem::path& path);
/// Adds the description of a set's places, NAME.EXTENSION.sheet.json: a list of those of its sheets.
void add_sheet_set_places(const SheetSet& set, const std::filesystem::path& path, FileSet& files);

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

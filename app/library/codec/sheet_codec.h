/// What writes sheets, a library of its own (engine/base/module.h): splatray_sheet, SVG and PDF by cairo, TIFF by libtiff. The functions
/// return whether all went well; `error` receives a message on failure.
#pragma once
#include <string>
#include <vector>

#include "app/library/codec/drawing.h"
#include "app/library/codec/geo_raster.h"

namespace splatray {

struct SheetCodec {
  /// The bytes of a page, "svg", or of one or more, "pdf", which has the first one's title.
  bool (*encode_pages)(const std::vector<Drawing>& pages, const std::string& format,
                       std::vector<unsigned char>& bytes, std::string& error);
  /// What encode_pages takes for a text of this size, mm.
  TextExtents (*text_extents)(const std::string& text, double size_mm);
  /// The bytes of a raster, with further tags of GeoTIFF.
  bool (*encode_tiff)(const GeoRaster& raster, const GeoTags& tags, std::vector<unsigned char>& bytes,
                      std::string& error);
};

}  // namespace splatray

/// The library's only symbol.
extern "C" const splatray::SheetCodec* splatray_sheet_codec();

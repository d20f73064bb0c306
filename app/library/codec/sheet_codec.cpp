// The library of sheet_codec.h: SVG and PDF by cairo, TIFF by libtiff.
#include "app/library/codec/sheet_codec.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numbers>
#include <string_view>

#include "app/library/codec/markup_text.h"

namespace splatray {
namespace {

constexpr double POINTS_PER_MM = 72.0 / 25.4;
constexpr const char* FONT = "DejaVu Sans";
using Bytes = std::vector<unsigned char>;

cairo_status_t append(void* closure, const unsigned char* data, unsigned length) {
  auto& bytes = *static_cast<Bytes*>(closure);
  bytes.insert(bytes.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

/// Some of a raster's pixels.
struct Piece {
  std::uint32_t x, y, width, height;
};

/// Pixels along an edge of a piece; cairo's images have at most 32767.
constexpr std::uint32_t PIECE_EDGE = 16384;

/// A piece as cairo has it: 32 bits a pixel, colours multiplied by alpha.
cairo_surface_t* surface_of(const DrawnRaster& raster, const Piece& piece) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(piece.width),
                                                        static_cast<int>(piece.height));
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) return surface;
  cairo_surface_flush(surface);
  unsigned char* to = cairo_image_surface_get_data(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  for (std::size_t y = 0; y < piece.height; ++y)
    for (std::size_t x = 0; x < piece.width; ++x) {
      const std::uint8_t* from = &raster.rgba[4 * ((piece.y + y) * raster.width + piece.x + x)];
      const std::uint32_t alpha = from[3];
      const auto times = [alpha](std::uint32_t value) { return (value * alpha + 127) / 255; };
      const std::uint32_t pixel =
          alpha << 24U | times(from[0]) << 16U | times(from[1]) << 8U | times(from[2]);
      std::memcpy(to + y * stride + 4 * x, &pixel, sizeof pixel);
    }
  cairo_surface_mark_dirty(surface);
  return surface;
}

void draw_piece(cairo_t* cairo, const DrawnRaster& raster, const Piece& piece) {
  cairo_surface_t* surface = surface_of(raster, piece);
  cairo_set_source_surface(cairo, surface, piece.x, piece.y);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
  cairo_paint(cairo);
  cairo_surface_destroy(surface);
}

/// In pieces, each a pixel larger than its share, as viewers show a hairline where two only touch.
void draw_raster(cairo_t* cairo, const DrawnRaster& raster) {
  cairo_save(cairo);
  cairo_translate(cairo, raster.corner.x, raster.corner.y);
  cairo_scale(cairo, raster.size.x / raster.width, raster.size.y / raster.height);
  for (std::uint32_t y = 0; y < raster.height; y += PIECE_EDGE)
    for (std::uint32_t x = 0; x < raster.width; x += PIECE_EDGE)
      draw_piece(
          cairo, raster,
          {x, y, std::min(PIECE_EDGE + 1, raster.width - x), std::min(PIECE_EDGE + 1, raster.height - y)});
  cairo_restore(cairo);
}

/// Letters whose widths do not depend on the size that they are shown in.
void set_font(cairo_t* cairo, double size_mm) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
  cairo_select_font_face(cairo, FONT, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size_mm);
}

TextExtents text_extents(const std::string& text, double size_mm) {
  cairo_surface_t* surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr);
  cairo_t* cairo = cairo_create(surface);
  cairo_scale(cairo, POINTS_PER_MM, POINTS_PER_MM);
  set_font(cairo, size_mm);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  cairo_font_extents_t font;
  cairo_font_extents(cairo, &font);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return {extents.x_advance, font.ascent, font.descent};
}

/// Where along its line a text begins, as a part of its width before its place.
double shift_of(TextAnchor anchor) {
  return anchor == TextAnchor::begin ? 0.0 : (anchor == TextAnchor::middle ? 0.5 : 1.0);
}

void draw_text(cairo_t* cairo, const DrawnText& text) {
  cairo_save(cairo);
  set_font(cairo, text.size_mm);
  cairo_translate(cairo, text.at.x, text.at.y);
  if (text.upwards) cairo_rotate(cairo, -0.5 * std::numbers::pi);
  cairo_move_to(cairo, -shift_of(text.anchor) * text_extents(text.text, text.size_mm).width, 0.0);
  cairo_show_text(cairo, text.text.c_str());
  cairo_restore(cairo);
}

void draw_paths(cairo_t* cairo, const DrawnRaster& raster) {
  cairo_save(cairo);
  cairo_rectangle(cairo, raster.corner.x, raster.corner.y, raster.size.x, raster.size.y);
  cairo_clip(cairo);
  for (const DrawnPath& path : raster.paths) {
    cairo_set_line_width(cairo, path.width_mm);
    for (const glm::dvec2& point : path.points) cairo_line_to(cairo, point.x, point.y);
    if (path.closed) cairo_close_path(cairo);
    cairo_stroke(cairo);
  }
  cairo_restore(cairo);
}

/// All but the texts.
void draw_shapes(cairo_t* cairo, const Drawing& drawing) {
  cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
  cairo_paint(cairo);
  for (const DrawnRaster& raster : drawing.rasters)
    if (raster.width > 0) draw_raster(cairo, raster);
  cairo_set_source_rgb(cairo, 0.0, 0.0, 0.0);
  for (const DrawnRaster& raster : drawing.rasters) draw_paths(cairo, raster);
  for (const DrawnLine& line : drawing.lines) {
    cairo_set_line_width(cairo, line.width_mm);
    cairo_move_to(cairo, line.from.x, line.from.y);
    cairo_line_to(cairo, line.to.x, line.to.y);
    cairo_stroke(cairo);
  }
  for (const DrawnBox& box : drawing.boxes) {
    cairo_set_source_rgb(cairo, box.fill.x, box.fill.y, box.fill.z);
    cairo_rectangle(cairo, box.corner.x, box.corner.y, box.size.x, box.size.y);
    cairo_fill(cairo);
  }
  cairo_set_source_rgb(cairo, 0.0, 0.0, 0.0);
}

/// To a ten-thousandth, whatever the locale.
std::string number_text(double value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 4);
  return {text.data(), end.ptr};
}

/// Letters as SVG has them, as cairo writes outlines; as wide as measured where a reader has another font.
std::string svg_text(const DrawnText& text) {
  const double width = text_extents(text.text, text.size_mm).width;
  if (!(width > 0.0)) return {};
  static constexpr std::array ANCHORS = {"start", "middle", "end"};  // TextAnchor
  const std::string x = number_text(text.at.x), y = number_text(text.at.y);
  return "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number_text(text.size_mm) +
         "\" textLength=\"" + number_text(width) + "\" lengthAdjust=\"spacingAndGlyphs\" text-anchor=\"" +
         ANCHORS.at(static_cast<std::size_t>(text.anchor)) + "\"" +
         (text.upwards ? " transform=\"rotate(-90 " + x + " " + y + ")\"" : "") + " xml:space=\"preserve\">" +
         markup_text(text.text) + "</text>\n";
}

/// Adds the texts to the bytes of an SVG that has all else.
void add_svg_texts(const Drawing& drawing, Bytes& bytes) {
  static constexpr std::string_view END = "</svg>";
  std::string svg(bytes.begin(), bytes.end());
  std::string texts = "<g transform=\"scale(" + number_text(POINTS_PER_MM) + ")\" font-family=\"'" + FONT +
                      "', sans-serif\" fill=\"black\">\n";
  for (const DrawnText& text : drawing.texts) texts += svg_text(text);
  svg.insert(svg.rfind(END), texts + "</g>\n");
  bytes.assign(svg.begin(), svg.end());
}

cairo_surface_t* surface_for(const Drawing& page, const std::string& format, Bytes& bytes) {
  const glm::dvec2 points = page.size * POINTS_PER_MM;
  if (format == "svg") return cairo_svg_surface_create_for_stream(append, &bytes, points.x, points.y);
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append, &bytes, points.x, points.y);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  return surface;
}

bool encode_pages(const std::vector<Drawing>& pages, const std::string& format, Bytes& bytes,
                  std::string& error) {
  cairo_surface_t* surface = surface_for(pages.front(), format, bytes);
  cairo_t* cairo = cairo_create(surface);
  cairo_scale(cairo, POINTS_PER_MM, POINTS_PER_MM);
  for (const Drawing& page : pages) {
    if (format == "pdf")
      cairo_pdf_surface_set_size(surface, page.size.x * POINTS_PER_MM, page.size.y * POINTS_PER_MM);
    draw_shapes(cairo, page);
    if (format != "pdf") continue;
    for (const DrawnText& text : page.texts) draw_text(cairo, text);
    cairo_show_page(cairo);
  }
  cairo_status_t status = cairo_status(cairo);
  cairo_destroy(cairo);
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  if (status != CAIRO_STATUS_SUCCESS) error = cairo_status_to_string(status);
  if (status == CAIRO_STATUS_SUCCESS && format == "svg") add_svg_texts(pages.front(), bytes);
  return status == CAIRO_STATUS_SUCCESS;
}

/// A file in memory, as libtiff writes it.
struct MemoryFile {
  Bytes& bytes;
  std::size_t at = 0;
};
tmsize_t read_memory(thandle_t, void*, tmsize_t) { return 0; }
tmsize_t write_memory(thandle_t handle, void* data, tmsize_t size) {
  auto& file = *static_cast<MemoryFile*>(handle);
  const std::size_t end = file.at + static_cast<std::size_t>(size);
  if (file.bytes.size() < end) file.bytes.resize(end);
  std::memcpy(file.bytes.data() + file.at, data, static_cast<std::size_t>(size));
  file.at = end;
  return size;
}
toff_t seek_memory(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<MemoryFile*>(handle);
  const std::size_t from = whence == SEEK_SET ? 0 : (whence == SEEK_CUR ? file.at : file.bytes.size());
  return file.at = from + offset;
}
int close_memory(thandle_t) { return 0; }
toff_t size_memory(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }

constexpr ttag_t PIXEL_SCALE = 33550, TIEPOINT = 33922, KEYS = 34735, ASCII = 34737, NO_DATA = 42113;

void add_geo_tags(TIFF* tiff) {
  static const std::array fields = {
      TIFFFieldInfo{PIXEL_SCALE, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
                    const_cast<char*>("ModelPixelScale")},
      TIFFFieldInfo{TIEPOINT, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
      TIFFFieldInfo{KEYS, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")},
      TIFFFieldInfo{ASCII, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GeoAsciiParams")},
      TIFFFieldInfo{NO_DATA, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_NODATA")}};
  TIFFMergeFieldInfo(tiff, fields.data(), static_cast<std::uint32_t>(fields.size()));
}

void set_tags(TIFF* tiff, const GeoRaster& raster, const GeoTags& tags) {
  const bool floats = raster.rgba.empty();
  constexpr std::uint32_t STRIP_ROWS = 64;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, raster.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, raster.height);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, floats ? 1 : 4);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, floats ? 32 : 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, floats ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, floats ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, STRIP_ROWS);
  const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
  if (!floats) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
  if (tags.dots_per_inch > 0.0) {
    TIFFSetField(tiff, TIFFTAG_XRESOLUTION, tags.dots_per_inch);
    TIFFSetField(tiff, TIFFTAG_YRESOLUTION, tags.dots_per_inch);
    TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  }
  if (!tags.description.empty()) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, tags.description.c_str());
  TIFFSetField(tiff, PIXEL_SCALE, static_cast<int>(tags.pixel_scale.size()), tags.pixel_scale.data());
  TIFFSetField(tiff, TIEPOINT, static_cast<int>(tags.tiepoint.size()), tags.tiepoint.data());
  TIFFSetField(tiff, KEYS, static_cast<int>(tags.keys.size()), tags.keys.data());
  if (!tags.ascii.empty()) TIFFSetField(tiff, ASCII, tags.ascii.c_str());
  if (!tags.no_data.empty()) TIFFSetField(tiff, NO_DATA, tags.no_data.c_str());
}

bool write_rows(TIFF* tiff, const GeoRaster& raster) {
  const bool floats = raster.rgba.empty();
  const std::size_t row_bytes = std::size_t{raster.width} * 4;
  Bytes row(row_bytes);  // libtiff's predictor changes what it is given
  for (std::uint32_t y = 0; y < raster.height; ++y) {
    const void* from = floats ? static_cast<const void*>(&raster.floats[std::size_t{y} * raster.width])
                              : &raster.rgba[std::size_t{y} * row_bytes];
    std::memcpy(row.data(), from, row_bytes);
    if (TIFFWriteScanline(tiff, row.data(), y, 0) < 0) return false;
  }
  return true;
}

bool encode_tiff(const GeoRaster& raster, const GeoTags& tags, Bytes& bytes, std::string& error) {
  constexpr std::uint64_t CLASSIC_MOST = 0xF0000000U;
  const bool big = std::uint64_t{raster.width} * raster.height * 4 > CLASSIC_MOST;
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  MemoryFile file{bytes};
  TIFF* tiff = TIFFClientOpen("sheet", big ? "w8" : "w", &file, read_memory, write_memory, seek_memory,
                              close_memory, size_memory, nullptr, nullptr);
  if (tiff == nullptr) {
    error = "libtiff could not begin";
    return false;
  }
  add_geo_tags(tiff);
  set_tags(tiff, raster, tags);
  const bool written = write_rows(tiff, raster) && TIFFFlush(tiff) == 1;
  TIFFClose(tiff);
  if (!written) error = "libtiff could not write";
  return written;
}

}  // namespace
}  // namespace splatray

extern "C" __attribute__((visibility("default"))) const splatray::SheetCodec* splatray_sheet_codec() {
  static const splatray::SheetCodec codec{splatray::encode_pages, splatray::text_extents,
                                          splatray::encode_tiff};
  return &codec;
}

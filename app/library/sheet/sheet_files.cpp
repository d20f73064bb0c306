#include "app/library/sheet/sheet_files.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/library/codec/json_vector.h"
#include "app/library/codec/markup_text.h"
#include "app/library/measure/measure_file.h"
#include "app/library/sheet/geotiff.h"
#include "app/library/sheet/sheet_dxf.h"
#include "app/library/sheet/sheet_page.h"
#include "app/library/sheet/sheet_writer.h"
#include "engine/base/error.h"
#include "engine/base/json_text.h"
#include "engine/base/number_text.h"
#include "engine/base/utf8.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

GeoPlace place_of(const Sheet& sheet, const PixelWindow& window) {
  return {sheet.at(window.x, window.y), sheet.pixel_world, sheet.north_up ? sheet.crs : std::string()};
}

using Bytes = std::vector<unsigned char>;

Bytes encode_tiff(const GeoRaster& raster, const GeoTags& tags, const std::filesystem::path& path) {
  Bytes bytes;
  std::string reason;
  if (!sheet_codec().encode_tiff(raster, tags, bytes, reason))
    throw Error(ExitCode::failed, "cannot write '" + path.string() + "': " + reason);
  return bytes;
}

Bytes encode_pages(const std::vector<Drawing>& pages, const std::string& format,
                   const std::filesystem::path& path) {
  Bytes bytes;
  std::string reason;
  if (!sheet_codec().encode_pages(pages, format, bytes, reason))
    throw Error(ExitCode::failed, "cannot write '" + path.string() + "': " + reason);
  return bytes;
}

/// Heights of a sheet from above, else distances behind the cut or the eye's plane.
Bytes encode_heights(const Shot& shot, const Image& image) {
  const Sheet& sheet = *shot.sheet();
  const Camera camera = sheet.camera();
  const double eye = glm::dot(camera.eye, sheet.toward);
  const bool from_above = sheet.asked.kind == SheetKind::plan;
  GeoRaster raster{image.width, image.height, {}, {}};
  raster.floats.reserve(image.aov.size());
  for (const AovPixel& pixel : image.aov) {
    const double height = eye - static_cast<double>(pixel.z);
    const double value = from_above ? height : sheet.near - height;
    raster.floats.push_back(std::isfinite(pixel.z) ? static_cast<float>(value)
                                                   : std::numeric_limits<float>::quiet_NaN());
  }
  GeoTags tags = geo_tags(place_of(sheet, shot.view.made()));
  tags.no_data = "nan";
  tags.description = from_above ? "heights, world units" : "distances behind the sheet's plane, world units";
  return encode_tiff(raster, tags, shot.request.output.height_raster);
}

/// What is said on a shot's page.
struct PageText {
  PageWords words;
  std::vector<Measure> measures;
};

/// Throws Error: see read_measures.
PageText page_text(const Shot& shot) {
  const Request::Output& output = shot.request.output;
  const std::vector<std::filesystem::path>& inputs = shot.request.source.inputs;
  PageText text{{output.title, output.title_block}, {}};
  if (text.words.title.empty() && !inputs.empty()) text.words.title = path_text(inputs.front().stem());
  const SheetSet* set = shot.sheet_set();
  const Sheet& sheet = set == nullptr ? *shot.sheet() : set->sheets.front();
  if (!output.measures.empty()) text.measures = read_measures(output.measures, sheet.crs);
  return text;
}

/// The pages of the shot, of one sheet that of its window, without pixels. Throws Error: see sheet_page, page_text.
std::vector<Drawing> pages_of(const Shot& shot) {
  const PageText text = page_text(shot);
  if (const SheetSet* set = shot.sheet_set()) return sheet_pages(*set, text.words, text.measures);
  return {sheet_page(*shot.sheet(), shot.view.made(), text.words, text.measures)};
}

Bytes encode_dxf(const Shot& shot) {
  const PageText text = page_text(shot);
  const std::string dxf = sheet_dxf(*shot.sheet(), text.words, text.measures);
  return {dxf.begin(), dxf.end()};
}

/// Where the file's pixels lie in the world.
nlohmann::ordered_json description_of(const Sheet& sheet, const PixelWindow& window) {
  const glm::dvec2 corner = sheet.at(window.x, window.y) + sheet.origin;
  return {{"sheet", sheet_text(sheet.asked)},
          {"width", window.width},
          {"height", window.height},
          {"pixel_world", sheet.pixel_world},
          {"unit_metres", sheet.unit_metres},
          {"crs", sheet.crs},
          {"right", json_vector(sheet.right)},
          {"top", json_vector(sheet.top)},
          {"toward", json_vector(sheet.toward)},
          {"corner", json_vector(corner.x * sheet.right + corner.y * sheet.top + sheet.near * sheet.toward)},
          {"corner_on_paper", {sheet.at(window.x, window.y).x, sheet.at(window.x, window.y).y}},
          {"depth_world", sheet.near - sheet.far}};
}

std::string world_file(const GeoPlace& place) {
  const glm::dvec2 center = place.corner + glm::dvec2(0.5, -0.5) * place.pixel;
  return number_text(place.pixel) + "\n0\n0\n" + number_text(-place.pixel) + "\n" + number_text(center.x) +
         "\n" + number_text(center.y) + "\n";
}

}  // namespace

void require_sheet_writer() { static_cast<void>(sheet_codec()); }

void require_page(const Shot& shot) {
  const std::string extension = lower_extension(shot.request.output.path);
  if (extension == ".svg" || extension == ".pdf") static_cast<void>(pages_of(shot));
}

Bytes encode_sheet(const Shot& shot, const DisplayImage& picture, const Metadata& metadata,
                   const std::filesystem::path& path) {
  const Sheet& sheet = *shot.sheet();
  const PixelWindow window = shot.view.made();
  const std::string extension = lower_extension(path);
  if (extension == ".tif") {
    GeoTags tags = geo_tags(place_of(sheet, window));
    tags.dots_per_inch = sheet.asked.dpi;
    for (const auto& [name, value] : metadata)
      if (name == "command_line") tags.description = value;
    return encode_tiff({picture.width, picture.height, rgba_bytes(picture), {}}, tags, path);
  }
  if (extension == ".dxf") return encode_dxf(shot);
  std::vector<Drawing> pages = pages_of(shot);
  set_picture(picture, pages.front());
  return encode_pages(pages, extension.substr(1), path);
}

Bytes encode_sheets(const Shot& shot, std::vector<SheetPicture> made, const std::filesystem::path& path) {
  Shot drawn = shot;
  SheetSet set{{}, shot.sheet_set()->is_atlas};
  for (SheetPicture& one : made) set.sheets.push_back(std::move(one.sheet));
  const bool is_atlas = set.is_atlas;
  drawn.output = std::move(set);
  const std::string extension = lower_extension(path);
  if (extension == ".dxf") {
    const PageText text = page_text(drawn);
    const std::string dxf = sheets_dxf(*drawn.sheet_set(), text.words, text.measures);
    return {dxf.begin(), dxf.end()};
  }
  std::vector<Drawing> pages = pages_of(drawn);
  for (std::size_t i = 0; i < made.size(); ++i) {
    set_picture(made[i].picture, pages[is_atlas ? i : 0], is_atlas ? 0 : i);
    made[i].picture = {};
  }
  return encode_pages(pages, extension.substr(1), path);
}

void add_sheet_set_places(const SheetSet& set, const std::filesystem::path& path, FileSet& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Sheet& sheet : set.sheets)
    list.push_back(description_of(sheet, {0, 0, sheet.width, sheet.height}));
  const nlohmann::ordered_json all{{"sheets", list}};
  files.add(sheet_places(path).description, json_text(all, 1) + "\n");
}

SheetPlaces sheet_places(const std::filesystem::path& path) {
  const auto beside = [&path](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension);
  };
  SheetPlaces places;
  places.description = path.string() + ".sheet.json";
  const std::string extension = lower_extension(path);
  if (extension == ".tif") places.world_file = beside(".tfw");
  if (extension != ".png") return places;
  places.world_file = beside(".pgw");
  places.crs = beside(".prj");
  places.crs_of_gdal = path.string() + ".aux.xml";
  return places;
}

void add_sheet_places(const Shot& shot, const Image& image, const std::filesystem::path& path,
                      FileSet& files) {
  const Request& request = shot.request;
  const Sheet& sheet = *shot.sheet();
  const PixelWindow window = shot.view.made();
  const GeoPlace place = place_of(sheet, window);
  const SheetPlaces names = sheet_places(path);
  files.add(names.description, json_text(description_of(sheet, window), 1) + "\n");
  if (!request.output.height_raster.empty()) {
    const Bytes heights = encode_heights(shot, image);
    files.add(request.output.height_raster, heights.data(), heights.size());
  }
  if (!names.world_file.empty()) files.add(names.world_file, world_file(place));
  if (names.crs.empty() || place.crs.empty()) return;
  files.add(names.crs, place.crs + "\n");
  files.add(names.crs_of_gdal, "<PAMDataset>\n  <SRS>" + markup_text(place.crs) + "</SRS>\n</PAMDataset>\n");
}

}  // namespace splatray

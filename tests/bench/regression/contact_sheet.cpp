#include "tests/bench/regression/contact_sheet.h"

#include <algorithm>

#include "app/library/image_file.h"

namespace splatray::testing {
namespace {

constexpr std::uint32_t ACROSS = 6, BLOCK = 16;

/// Where a picture lies in the sheet.
struct Place {
  std::uint32_t x, y, width, height;
};

vec3 mean_of(const DisplayImage& image, std::uint32_t x, std::uint32_t y, std::uint32_t width,
             std::uint32_t height) {
  vec3 sum(0.0F);
  for (std::uint32_t row = y; row < y + height; ++row)
    for (std::uint32_t column = x; column < x + width; ++column)
      sum += image.rgb[std::size_t{row} * image.width + column];
  return sum / static_cast<float>(width * height);
}

double difference(const DisplayImage& sheet, const DisplayImage& last, const Place& place) {
  if (place.x + place.width > last.width || place.y + place.height > last.height) return 1.0;
  float most = 0.0F;
  for (std::uint32_t y = 0; y < place.height; y += BLOCK) {
    for (std::uint32_t x = 0; x < place.width; x += BLOCK) {
      const std::uint32_t width = std::min(BLOCK, place.width - x),
                          height = std::min(BLOCK, place.height - y);
      const vec3 off = glm::abs(mean_of(sheet, place.x + x, place.y + y, width, height) -
                                mean_of(last, place.x + x, place.y + y, width, height));
      most = std::max({most, off.r, off.g, off.b});
    }
  }
  return static_cast<double>(most);
}

void put(const DisplayImage& picture, const Place& place, DisplayImage& sheet) {
  for (std::uint32_t y = 0; y < std::min(place.height, picture.height); ++y)
    for (std::uint32_t x = 0; x < std::min(place.width, picture.width); ++x)
      sheet.rgb[std::size_t{place.y + y} * sheet.width + place.x + x] =
          picture.rgb[std::size_t{y} * picture.width + x];
}

}  // namespace

std::vector<double> write_contact_sheet(const std::vector<std::filesystem::path>& pictures,
                                        const std::filesystem::path& last,
                                        const std::filesystem::path& path) {
  DisplayImage sheet, before;
  if (std::filesystem::exists(last)) before = read_display_image(last, {});
  std::vector<Place> places;
  for (const std::filesystem::path& file : pictures) {
    const DisplayImage picture = read_display_image(file, {});
    if (sheet.rgb.empty()) {
      const auto rows = static_cast<std::uint32_t>((pictures.size() + ACROSS - 1) / ACROSS);
      sheet.width = ACROSS * picture.width;
      sheet.height = rows * picture.height;
      sheet.rgb.resize(std::size_t{sheet.width} * sheet.height, vec3(1.0F));
    }
    const auto number = static_cast<std::uint32_t>(places.size());
    const std::uint32_t width = sheet.width / ACROSS;
    places.push_back({number % ACROSS * width, number / ACROSS * picture.height, width, picture.height});
    put(picture, places.back(), sheet);
  }
  std::vector<double> differences;
  for (const Place& place : places) differences.push_back(difference(sheet, before, place));
  write_png(sheet, {}, path);
  return differences;
}

}  // namespace splatray::testing

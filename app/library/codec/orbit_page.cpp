#include "app/library/codec/orbit_page.h"

#include <nlohmann/json.hpp>

#include "app/library/codec/json_vector.h"
#include "app/library/codec/markup_text.h"
#include "app/library/codec/orbit_script.h"
#include "engine/base/json_text.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

/// RFC 4648.
std::string base64(const std::vector<unsigned char>& bytes) {
  static constexpr char LETTERS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) -> std::uint32_t { return at < bytes.size() ? bytes[at] : 0; };
    const std::uint32_t word = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (std::uint32_t part = 0; part < 4; ++part)
      text += i + part > bytes.size() ? '=' : LETTERS[word >> (18U - 6U * part) & 63U];
  }
  return text;
}

}  // namespace

std::string orbit_html(const OrbitPage& page) {
  Json pictures = Json::array();
  for (const OrbitPicture& picture : page.pictures)
    pictures.push_back({{"eye", json_vector(picture.camera.eye)},
                        {"target", json_vector(picture.camera.target)},
                        {"up", json_vector(picture.camera.up)},
                        {"fov", picture.camera.fov_y_deg},
                        {"ortho", picture.camera.ortho_height},
                        {"image", "data:image/jpeg;base64," + base64(picture.jpeg)},
                        {"depth", "data:image/png;base64," + base64(picture.depth_png)}});
  const Json data{{"width", page.width},     {"height", page.height}, {"step", page.depth_step},
                  {"near", page.near},       {"far", page.far},       {"metres", page.unit_metres},
                  {"columns", page.columns}, {"pictures", pictures}};
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1,user-scalable=no\">\n<title>";
  html += markup_text(page.title) + "</title>\n<style>" + ORBIT_STYLE + "</style>\n</head>\n<body>\n" +
          ORBIT_BODY;
  // No "</script>" within: JSON of numbers and base64 has none.
  html +=
      "<script>\nconst data = " + json_text(data) + ";\n" + ORBIT_SCRIPT + "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace splatray

#include "app/library/camera_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/library/codec/json_file.h"
#include "app/library/codec/json_vector.h"
#include "engine/base/error.h"
#include "engine/base/json_text.h"
#include "engine/base/number_text.h"
#include "engine/file/atomic_file.h"
#include "engine/image/view.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

constexpr double MOST_FRAME = 999999.0;

/// The file being read, for messages; `where` is the part of it, such as "key 3: ".
struct Source {
  std::filesystem::path path;
  std::string where;

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw Error(ExitCode::input_unreadable, "cannot read camera '" + path.string() + "': " + where +
                                                "found " + found + ", expected " + expected);
  }
};

/// A member's value as a short text, for messages.
std::string found_member(const Json& object, const char* name) {
  constexpr std::size_t MOST = 60;
  if (!object.contains(name)) return std::string("no ") + name;
  const std::string text = object[name].dump(-1, ' ', true);
  return std::string(name) + " " + (text.size() > MOST ? text.substr(0, MOST) + "..." : text);
}

template <glm::length_t COUNT>
glm::vec<COUNT, double> json_numbers(const Json& object, const char* name, const Source& source) {
  const Json& value = object.contains(name) ? object[name] : Json();
  const auto is_number = [](const Json& element) { return element.is_number(); };
  if (!value.is_array() || value.size() != COUNT || !std::all_of(value.begin(), value.end(), is_number))
    source.refuse(found_member(object, name),
                  std::string(name) + (COUNT == 2 ? " of two numbers" : " of three numbers"));
  glm::vec<COUNT, double> numbers;
  for (glm::length_t i = 0; i < COUNT; ++i) numbers[i] = value[static_cast<std::size_t>(i)].get<double>();
  return numbers;
}

double json_number(const Json& object, const char* name, double most, const Source& source) {
  const double value = object[name].is_number() ? object[name].get<double>() : 0.0;
  if (!(value > 0.0 && value < most))
    source.refuse(found_member(object, name), "a number > 0 and < " + number_text(most));
  return value;
}

/// One of the three.
void read_projection(const Json& json, const Source& source, Camera& camera) {
  std::string found;
  for (const char* name : {"fov_y_deg", "ortho_height", "panorama"})
    if (json.contains(name)) found += (found.empty() ? "" : " and ") + std::string(name);
  if (found.empty() || found.find(' ') != std::string::npos)
    source.refuse(found.empty() ? "no fov_y_deg, ortho_height or panorama" : found,
                  "one of fov_y_deg, ortho_height and panorama");
  if (json.contains("fov_y_deg")) {
    camera.fov_y_deg = json_number(json, "fov_y_deg", 180.0, source);
  } else if (json.contains("ortho_height")) {
    camera.ortho_height = json_number(json, "ortho_height", 1e30, source);
  } else {
    if (json["panorama"] != true) source.refuse(found_member(json, "panorama"), "panorama true");
    camera.panorama = true;
  }
}

Camera camera_of(const Json& json, const Source& source) {
  if (!json.is_object() || json.contains("keys"))
    source.refuse(json.is_object() ? "a camera path" : "no camera",
                  "an object with eye, target, up and fov_y_deg");
  Camera camera;
  camera.eye = json_numbers<3>(json, "eye", source);
  camera.target = json_numbers<3>(json, "target", source);
  camera.up = json_numbers<3>(json, "up", source);
  read_projection(json, source, camera);
  if (json.contains("lens_shift")) camera.lens_shift = json_numbers<2>(json, "lens_shift", source);
  if (json.contains("pixel_aspect"))
    camera.pixel_aspect = json_number(json, "pixel_aspect", MOST_PIXEL_ASPECT, source);
  return camera;
}

CameraKey read_key(const Json& json, const CameraPath& before, const Source& source) {
  CameraKey key{camera_of(json, source), before.empty() ? 0 : before.back().frame + KEY_FRAMES};
  if (json.contains("frame")) {
    const double frame = json["frame"].is_number() ? json["frame"].get<double>() : -1.0;
    const double least = before.empty() ? 0.0 : before.back().frame + 1.0;
    if (!(frame >= least && frame <= MOST_FRAME) || frame != std::floor(frame))
      source.refuse(found_member(json, "frame"),
                    "a whole number from " + number_text(least) + " to " + number_text(MOST_FRAME));
    key.frame = static_cast<std::uint32_t>(frame);
  }
  if (before.empty()) return key;
  const Camera &camera = key.camera, &last = before.back().camera;
  if ((camera.ortho_height > 0.0) != (last.ortho_height > 0.0) || camera.panorama != last.panorama)
    source.refuse("keys of several projections", "all of one kind");
  return key;
}

Json read_json(const Source& source) {
  return read_json_file(source.path, [&source](const std::string& found, const std::string& expected) {
    source.refuse(found, expected);
  });
}

Json to_json(const Camera& camera) {
  Json json = {{"eye", json_vector(camera.eye)},
               {"target", json_vector(camera.target)},
               {"up", json_vector(camera.up)}};
  if (camera.panorama)
    json["panorama"] = true;
  else if (camera.ortho_height > 0.0)
    json["ortho_height"] = camera.ortho_height;
  else
    json["fov_y_deg"] = camera.fov_y_deg;
  if (camera.lens_shift != glm::dvec2(0.0))
    json["lens_shift"] = Json::array({camera.lens_shift.x, camera.lens_shift.y});
  if (camera.pixel_aspect != 1.0) json["pixel_aspect"] = camera.pixel_aspect;
  return json;
}

}  // namespace

Camera read_camera(const std::filesystem::path& path) {
  const Source source{path, ""};
  return camera_of(read_json(source), source);
}

CameraPath read_camera_path(const std::filesystem::path& path) {
  const Json json = read_json({path, ""});
  if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array() || json["keys"].empty())
    Source{path, ""}.refuse("no keys", "a camera path: an object with keys, one camera or more");
  CameraPath keys;
  for (const Json& key : json["keys"])
    keys.push_back(read_key(key, keys, {path, "key " + std::to_string(keys.size()) + ": "}));
  return keys;
}

void write_camera(const Camera& camera, const std::filesystem::path& path) {
  write_text_file(json_text(to_json(camera), 2) + '\n', path);
}

void write_camera_path(const CameraPath& keys, const std::filesystem::path& path) {
  Json json = {{"keys", Json::array()}};
  for (const CameraKey& key : keys) {
    json["keys"].push_back(to_json(key.camera));
    json["keys"].back()["frame"] = key.frame;
  }
  write_text_file(json_text(json, 2) + '\n', path);
}

}  // namespace splatray

#include <cmath>

#include "app/library/camera_file.h"
#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup CAMERA = FieldGroup::camera;

Field resolution_row() {
  Field row = value_row(
      "resolution", CAMERA, "WxH", "size of the picture, pixels; default 1920x1080",
      [](Request& request, const std::string& text) {
        const auto numbers = split_whole_numbers(text, 'x', 2);
        if (numbers.empty() || numbers[0] == 0 || numbers[1] == 0)
          throw Expected{"width x height such as 1920x1080, each 1 to 32768"};
        request.view.width = numbers[0];
        request.view.height = numbers[1];
      },
      [](const Request& request) {
        return std::to_string(request.view.width) + "x" + std::to_string(request.view.height);
      });
  row.between = 'x';
  return row;
}

/// Before the camera, which it takes the place of and whose fields beside it are refused.
Field camera_path_row() {
  return value_row(
      "camera-path", CAMERA, "FILE",
      "one picture for each frame of this camera path (JSON: keys, each a camera with its frame)",
      [](Request& request, const std::string& file) {
        request.output.camera_path = file;
        request.view.eye = request.view.target = request.view.camera_up = std::nullopt;
        request.view.fov_y_deg.reset();
        request.view.ortho_height = 0.0;
        request.view.lens_shift = glm::dvec2(0.0);
        request.view.pixel_aspect = 1.0;
        request.view.panorama = false;
      },
      [](const Request& request) { return request.output.camera_path.string(); });
}

Field camera_row() {
  return with(
      value_row(
          "camera", CAMERA, "FILE",
          "camera file (JSON: eye, target, up, fov_y_deg or ortho_height or panorama, maybe lens_shift and "
          "pixel_aspect); options beside it replace parts",
          [](Request& request, const std::string& file) { set_camera(request.view, read_camera(file)); }, {}),
      {.doors = DOOR_RENDER | DOOR_VIEW,
       .why_not = "the fields of its parts say the same; the library has Camera"});
}

Field view_row() {
  std::vector<Choice<Viewpoint>> viewpoints;
  for (const Viewpoint viewpoint :
       {Viewpoint::automatic, Viewpoint::front, Viewpoint::oblique, Viewpoint::top, Viewpoint::inside,
        Viewpoint::dollhouse, Viewpoint::sensor})
    viewpoints.push_back({viewpoint_name(viewpoint), viewpoint});
  return choice_row(
      "view", CAMERA, MEMBER(view.viewpoint), viewpoints,
      "where a scene is looked at from without --eye; inside: from a scanner's place or the middle; "
      "dollhouse: into a room from above, without what faces away from the eye, with --eye from there; "
      "sensor: as a depth camera or scanner saw it; default auto: the scene's camera, of scans sensor, "
      "inside, dollhouse or oblique by what they are of, else front");
}

/// It takes the place of an up direction that the camera has from a file or picture.
Field up_row() {
  return value_row(
      "up", CAMERA, "X,Y,Z", "up direction of the scene, its environment and the camera; default the scene's",
      [](Request& request, const std::string& text) {
        const glm::dvec3 up = read_vector(text);
        if (up == glm::dvec3(0.0)) throw Expected{"a direction other than 0,0,0"};
        request.look.up = up;
        request.view.camera_up.reset();
      },
      [](const Request& request) { return request.look.up ? number_text(*request.look.up) : ""; });
}

Field fov_row() {
  return value_row(
      "fov", CAMERA, "DEG", "vertical field of view; default 30",
      [](Request& request, const std::string& text) {
        const auto numbers = split_numbers(text, ',', 1);
        if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] < 180.0))
          throw Expected{"degrees between 0 and 180"};
        request.view.fov_y_deg = numbers[0];
      },
      [](const Request& request) {
        return request.view.fov_y_deg ? number_text(*request.view.fov_y_deg) : "";
      });
}

Field lens_shift_row() {
  return value_row(
      "lens-shift", CAMERA, "X,Y",
      "where the point straight ahead lies, to the right of the picture's middle and below it, in widths and "
      "heights of the picture; default 0,0",
      [](Request& request, const std::string& text) {
        const auto numbers = split_numbers(text, ',', 2);
        if (numbers.empty() || !(std::hypot(numbers[0], numbers[1]) <= MOST_LENS_SHIFT))
          throw Expected{"two numbers up to 100 such as 0.1,0"};
        request.view.lens_shift = {numbers[0], numbers[1]};
      },
      [](const Request& request) {
        const glm::dvec2& shift = request.view.lens_shift;
        return number_text(shift.x) + ',' + number_text(shift.y);
      });
}

Field crop_row() {
  return value_row(
      "crop", CAMERA, "X,Y,WIDTH,HEIGHT",
      "only these pixels of the picture, the same as in the whole one; an EXR has them as its data window",
      [](Request& request, const std::string& text) {
        const auto numbers = split_whole_numbers(text, ',', 4);
        if (numbers.empty() || numbers[2] == 0 || numbers[3] == 0)
          throw Expected{"pixels X,Y,WIDTH,HEIGHT from the top left corner, such as 0,0,640,360"};
        request.view.crop = {numbers[0], numbers[1], numbers[2], numbers[3]};
      },
      [](const Request& request) {
        const PixelWindow& crop = request.view.crop;
        return crop.width == 0 ? std::string()
                               : std::to_string(crop.x) + ',' + std::to_string(crop.y) + ',' +
                                     std::to_string(crop.width) + ',' + std::to_string(crop.height);
      });
}

Field tile_row() {
  Field row = value_row(
      "tile", CAMERA, "I/N", "only this one of N bands of rows; splatray-merge joins them",
      [](Request& request, const std::string& text) {
        const auto numbers = split_whole_numbers(text, '/', 2);
        if (numbers.empty() || numbers[0] == 0 || numbers[0] > numbers[1])
          throw Expected{"a part and their number such as 1/4, the first is 1"};
        request.view.tile = numbers[0];
        request.view.tiles = numbers[1];
      },
      [](const Request& request) {
        return request.view.tiles == 0
                   ? std::string()
                   : std::to_string(request.view.tile) + '/' + std::to_string(request.view.tiles);
      });
  row.between = '/';
  return row;
}

}  // namespace

std::vector<Field> camera_fields() {
  return {
      needed(resolution_row(), "size of the picture in pixels, such as 1920x1080")
          .marked(OF_FILES | HAS_OWN_CONTROL),
      camera_path_row().marked(OF_FILES | HAS_OWN_CONTROL),
      camera_row(),
      needed(view_row(), "front, oblique, top, inside, dollhouse or sensor"),
      vector_row("eye", CAMERA, MEMBER(view.eye),
                 "camera position; default: the scene's camera, else a view of the whole scene"),
      vector_row("target", CAMERA, MEMBER(view.target),
                 "point looked at; default the scene's centre; needs --eye"),
      up_row().marked(OF_SCENES),
      vector_row("camera-up", CAMERA, MEMBER(view.camera_up),
                 "up direction of the camera alone; needs --eye"),
      fov_row(),
      with(number_row("ortho-height", CAMERA, MEMBER(view.ortho_height), 0.0, 1e30,
                      "orthographic picture of this height, world units; 0 = perspective; needs --eye"),
           {.old_names = {"ortho"}}),
      switch_row("panorama", CAMERA, MEMBER(view.panorama),
                 "all directions from the eye, equirectangular: longitude across with the target in the "
                 "middle, latitude down; the largest picture within --resolution that is twice as wide as "
                 "high")
          .marked(OF_FILES),
      lens_shift_row(),
      number_row("pixel-aspect", CAMERA, MEMBER(view.pixel_aspect), 1.0 / MOST_PIXEL_ASPECT,
                 MOST_PIXEL_ASPECT, "width of a pixel over its height; default 1"),
      number_row("aperture", CAMERA, MEMBER(view.aperture_world), 0.0, 1e30,
                 "diameter of the lens, world units; default 0: all is sharp; not with --look paper")
          .of_looks({LOOK_LIT, LOOK_CLAY, LOOK_AO, LOOK_SCAN}),
      unset_number_row(
          "focus", CAMERA, MEMBER(settings.focus_world), 1e-30, 1e30,
          "distance from the eye at which all is sharp, world units; default the camera's target")
          .of_looks({LOOK_LIT, LOOK_CLAY, LOOK_AO, LOOK_SCAN}),
      crop_row().marked(OF_FILES),
      tile_row().marked(OF_FILES)};
}

}  // namespace splatray

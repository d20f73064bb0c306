#include <memory>
#include <numbers>
#include <span>

#include "app/cli/option_types.h"
#include "app/cli/options.h"
#include "app/library/camera_file.h"
#include "app/library/materials.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

void add_resolution(OptionList& list, PictureOptions& picture) {
  const auto read = [&picture](const std::string& text) {
    const auto numbers = split_whole_numbers(text, 'x', 2);
    if (numbers.empty() || numbers[0] == 0 || numbers[1] == 0)
      refuse_option("--resolution", text, "width x height such as 1920x1080, each 1 to 32768");
    picture.width = numbers[0];
    picture.height = numbers[1];
  };
  const auto write = [&picture] {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
  };
  list.add_value("--resolution", read, write, "size of the picture, pixels; default 1920x1080", "WxH");
}

void add_fov(OptionList& list, PictureOptions& picture) {
  const auto read = [&picture](const std::string& text) {
    const auto numbers = split_numbers(text, ',', 1);
    if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] < 180.0))
      refuse_option("--fov", text, "degrees between 0 and 180");
    picture.fov_y_deg = numbers[0];
  };
  const auto write = [&picture] { return picture.fov_y_deg ? number_text(*picture.fov_y_deg) : ""; };
  list.add_value("--fov", read, write, "vertical field of view; default 30", "DEG");
}

/// --up takes the place of an up direction that the camera has from a file or picture.
void add_up(OptionList& list, PictureOptions& picture) {
  const auto read = [&picture](const std::string& text) {
    picture.up = read_vector("--up", text);
    picture.camera_up.reset();
  };
  list.add_value(
      "--up", read, [&picture] { return picture.up ? number_text(*picture.up) : ""; },
      "up direction of the scene, its environment and the camera; default the scene's", "X,Y,Z");
  add_vector(list, "--camera-up", picture.camera_up, "up direction of the camera alone; needs --eye");
}

/// Options are applied in the order of adding: those after --camera change parts of its camera.
void add_camera_options(OptionList& list, PictureOptions& picture) {
  add_resolution(list, picture);
  list.add_value(
      "--camera", [&picture](const std::string& file) { set_camera(picture, read_camera(file)); }, {},
      "camera file (JSON: eye, target, up, fov_y_deg or ortho_height); options beside it replace parts",
      "FILE");
  std::vector<Choice<Viewpoint>> viewpoints;
  for (const Viewpoint viewpoint :
       {Viewpoint::automatic, Viewpoint::front, Viewpoint::oblique, Viewpoint::top, Viewpoint::inside,
        Viewpoint::dollhouse, Viewpoint::sensor})
    viewpoints.push_back({viewpoint_name(viewpoint), viewpoint});
  add_choice(
      list, "--view", picture.viewpoint, viewpoints,
      "where a scene is looked at from without --eye; inside: from a scanner's place or the middle; "
      "dollhouse: into a room from above, without what faces away from the eye, with --eye from there; "
      "sensor: as a depth camera or scanner saw it; default auto: the scene's camera, of scans sensor, "
      "inside, dollhouse or oblique by what they are of, else front");
  add_vector(list, "--eye", picture.eye,
             "camera position; default: the scene's camera, else a view of the whole scene");
  add_vector(list, "--target", picture.target, "point looked at; default the scene's centre; needs --eye");
  add_up(list, picture);
  add_fov(list, picture);
  add_number(list, "--ortho", picture.ortho_height, 0.0, 1e30,
             "orthographic picture of this height, world units; 0 = perspective; needs --eye");
}

/// Finite numbers, `least` of them or three more, or either and a last one; how many there are stands in their count.
std::vector<double> light_numbers(const std::string& name, const std::string& text, std::size_t least,
                                  const std::string& expected) {
  for (const std::size_t count : {least, least + 3, least + 4})
    if (auto numbers = split_numbers(text, ',', count); !numbers.empty()) return numbers;
  refuse_option(name, text, expected);
}

void set_power(const std::string& name, const std::string& text, std::span<const double> numbers,
               LightOptions& light) {
  light.power = glm::vec3(numbers[0], numbers[1], numbers[2]);
  if (!(light.power->x >= 0.0F && light.power->y >= 0.0F && light.power->z >= 0.0F) ||
      !std::isfinite(light.power->x + light.power->y + light.power->z))
    refuse_option(name, text, "R,G,B of finite numbers >= 0");
}

/// A light of X,Y,Z[,R,G,B[,SIZE]].
LightOptions read_light(const std::string& name, const std::string& text, std::uint32_t kind) {
  const auto numbers =
      light_numbers(name, text, 3, "three, six or seven numbers such as 1,-2,0.5 or 1,-2,0.5,9,9,9");
  LightOptions light;
  light.kind = kind;
  light.position = {numbers[0], numbers[1], numbers[2]};
  if (kind == LIGHT_DIRECTIONAL && light.position == glm::dvec3(0.0))
    refuse_option(name, text, "a direction other than 0,0,0");
  if (numbers.size() > 3) set_power(name, text, std::span(numbers).subspan(3), light);
  if (numbers.size() == 7) light.size = numbers[6];
  const double most = kind == LIGHT_DIRECTIONAL ? 180.0 : 1e30;
  if (!(light.size >= 0.0 && light.size <= most))
    refuse_option(name, text,
                  kind == LIGHT_DIRECTIONAL ? "a SIZE from 0 to 180 degrees" : "a SIZE of 0 or more");
  return light;
}

/// A rectangle of X,Y,Z,TX,TY,TZ,WIDTH,HEIGHT[,R,G,B].
LightOptions read_rectangle(const std::string& name, const std::string& text) {
  const auto numbers = light_numbers(
      name, text, 8, "eight or eleven numbers such as 0,0,3,0,0,0,2,1 or 0,0,3,0,0,0,2,1,9,9,9");
  LightOptions light;
  light.kind = LIGHT_RECTANGLE;
  light.position = {numbers[0], numbers[1], numbers[2]};
  light.target = {numbers[3], numbers[4], numbers[5]};
  light.edges = {numbers[6], numbers[7]};
  if (light.position == light.target)
    refuse_option(name, text, "a point TX,TY,TZ other than X,Y,Z to shine at");
  if (!(light.edges.x > 0.0 && light.edges.y > 0.0))
    refuse_option(name, text, "a WIDTH and HEIGHT of more than 0");
  if (numbers.size() == 12) refuse_option(name, text, "eight or eleven numbers");
  if (numbers.size() > 8) set_power(name, text, std::span(numbers).subspan(8), light);
  return light;
}

std::string light_word(const LightOptions& light) {
  const bool rectangle = light.kind == LIGHT_RECTANGLE;
  std::string word = rectangle ? "--area-light=" : (light.kind == LIGHT_POINT ? "--light=" : "--sun=");
  word += number_text(light.position);
  if (rectangle)
    word +=
        "," + number_text(light.target) + "," + number_text(light.edges.x) + "," + number_text(light.edges.y);
  if (light.power) word += "," + number_text(*light.power);
  if (light.size > 0.0) word += "," + number_text(light.size);
  return word;
}

Words light_words(const std::optional<std::vector<LightOptions>>& lights) {
  if (!lights) return {};
  if (lights->empty()) return {"--lights=none"};
  Words words;
  for (const LightOptions& light : *lights) words.push_back(light_word(light));
  return words;
}

/// The lights keep the order in which they are given, over both options; the first replaces those there were.
void add_light_options(OptionList& list, PictureOptions& picture) {
  const auto given = std::make_shared<std::vector<LightOptions>>();
  const auto add = [&](const std::string& name, std::uint32_t kind, const std::string& help) {
    const auto read = [&picture, given, name, kind](const std::string& text) {
      given->push_back(kind == LIGHT_RECTANGLE ? read_rectangle(name, text) : read_light(name, text, kind));
      picture.lights = *given;
    };
    list.add_repeated(name, read, help,
                      kind == LIGHT_RECTANGLE ? "X,Y,Z,TX,TY,TZ,W,H[,R,G,B]" : "X,Y,Z[,R,G,B[,SIZE]]");
  };
  add("--light", LIGHT_POINT,
      "a point light here instead of the scene's lights; R,G,B: its intensity, default irradiance pi at the "
      "scene's centre; SIZE: its radius, world units; repeatable");
  add("--sun", LIGHT_DIRECTIONAL,
      "a directional light from X,Y,Z instead of the scene's lights; R,G,B: its irradiance, default pi; "
      "SIZE: the angle it seems to have, degrees (our sun's: 0.53); repeatable");
  add("--area-light", LIGHT_RECTANGLE,
      "a rectangle of W x H here that shines towards TX,TY,TZ, instead of the scene's lights; R,G,B: its "
      "radiance, default irradiance pi "
      "there; not with --look paper; repeatable");
  list.add_value(
      "--lights",
      [&picture, given](const std::string& text) {
        if (text != "none") refuse_option("--lights", text, "none");
        picture.lights = *given;
      },
      {}, "no light but the environment's, unless --light, --sun or --area-light add some", "none");
  list.add_words([&picture] { return light_words(picture.lights); });
}

void add_environment_options(OptionList& list, PictureOptions& picture) {
  Settings& settings = picture.settings;
  add_text(list, "--env", picture.environment,
           "environment: an HDR or EXR file (latitude-longitude), white, black, studio or a radiance r,g,b; "
           "default: the scene's, else studio with a key light over the viewer's left shoulder",
           "FILE|NAME");
  add_number(list, "--env-strength", settings.environment_strength, 0.0, 1e6,
             "factor on the environment; default 1");
  add_number(list, "--env-turn", settings.environment_turn, -1e6, 1e6,
             "turns of the environment about the up axis; default 0");
}

void add_object_options(OptionList& list, PictureOptions& picture) {
  const auto read = [&picture](const std::string& text) {
    picture.objects.push_back(read_object_options(text));
  };
  list.add_repeated("--object", read,
                    "change the material of one object, given by its index or name; keys: preset (a name of "
                    "--material), diffuse=r/g/b, specular, shininess, mirror, ior, tint=r/g/b, and glass, "
                    "two-sided, hidden = on or off; of what path tracing sees: metallic, roughness, coat, "
                    "coat-roughness, emission=r/g/b; "
                    "repeatable, the last change holds",
                    "OBJECT:KEY=VALUE,...");
  list.add_words([&picture] {
    Words words;
    for (const ObjectOptions& object : picture.objects) words.push_back("--object=" + object_text(object));
    return words;
  });
}

/// A list of whole numbers from 0 on, by commas.
void add_number_list(OptionList& list, const std::string& name, std::vector<std::uint32_t>& target,
                     const std::string& help) {
  const auto read = [&target, name](const std::string& text) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      numbers.push_back(read_number<std::uint32_t>(name, text.substr(begin, end - begin), 0, 65535));
      begin = end + 1;
    }
    target = numbers;
  };
  const auto write = [&target] {
    std::string text;
    for (const std::uint32_t number : target) text += (text.empty() ? "" : ",") + std::to_string(number);
    return text;
  };
  list.add_value(name, read, write, help, "N,...");
}

void add_attribute_options(OptionList& list, PictureOptions& picture) {
  AttributeOptions& attributes = picture.attributes;
  add_text(list, "--color-by", attributes.color_by,
           "colours of points: rgb (their own), plain (none), height (low to high: blue-green, green, ochre, "
           "rose), height+intensity (darker where that is low), normal, distance (from the scanner), or an "
           "attribute they have, such as intensity, class, return, source, scan, kind (surface, line or "
           "scatter); default "
           "rgb, of scans without colours intensity, of sites and rooms height with it",
           "NAME");
  list.add_value(
      "--color-range",
      [&attributes](const std::string& text) {
        const auto numbers = split_numbers(text, ',', 2);
        if (numbers.empty() || !(numbers[0] < numbers[1]))
          refuse_option("--color-range", text, "two numbers LOW,HIGH with LOW < HIGH");
        attributes.color_range = {numbers[0], numbers[1]};
      },
      [&attributes] {
        return attributes.color_range ? number_text((*attributes.color_range)[0]) + "," +
                                            number_text((*attributes.color_range)[1])
                                      : "";
      },
      "values at the ends of the colours; default 2 to 98 % of all values", "LOW,HIGH");
  add_number_list(list, "--hide-class", attributes.hidden_classes,
                  "classes that are not shown, such as 7,18");
  add_number_list(list, "--hide-scan", attributes.hidden_scans, "scans that are not shown, from 0");
}

void add_look_options(OptionList& list, PictureOptions& picture) {
  Settings& settings = picture.settings;
  add_choice<std::optional<std::uint32_t>>(
      list, "--look", picture.look,
      {{"auto", std::nullopt},
       {"lit", LOOK_LIT},
       {"clay", LOOK_CLAY},
       {"ao", LOOK_AO},
       {"scan", LOOK_SCAN},
       {"paper", LOOK_PAPER}},
      "lit: path tracing; clay: the same, all of it white clay; ao: ambient occlusion; scan: the points' "
      "colours under occlusion and a "
      "soft light; paper: Phong, hard shadows, mirrors and glass; default auto: scan for points with "
      "colours and without materials, else lit");
  std::vector<Choice<std::optional<Tone>>> tones = {{"auto", std::nullopt}};
  for (std::size_t i = 0; i < TONE_NAMES.size(); ++i) tones.push_back({TONE_NAMES[i], Tone(i)});
  add_choice(list, "--tone", picture.tone, tones,
             "how a PNG shows what is brighter than white: neutral (colours stay), agx (like film), soft "
             "(each channel alone), none (cut off); "
             "default auto: soft with --look paper, else neutral");
  add_number(list, "--ao-radius", settings.reach_world, 0.0, 1e30,
             "ao and scan: how far away something darkens a point, world units; default a tenth of the "
             "scene's diagonal");
  add_choice<bool>(list, "--glass-shadows", settings.straight_shadows, {{"paths", false}, {"straight", true}},
                   "lit: what glass leaves of the light of lights: what paths find, or tinted shadows, "
                   "unbent; default paths");
  add_number(list, "--aperture", picture.aperture_world, 0.0, 1e30,
             "diameter of the lens, world units; default 0: all is sharp; not with paper");
  add_number(list, "--focus", settings.focus_world, 0.0, 1e30,
             "distance from the eye at which all is sharp, world units; default 0: the camera's target");
}

void add_method_options(OptionList& list, PictureOptions& picture) {
  Settings& settings = picture.settings;
  add_number(list, "--samples", settings.samples, 1, 65536, "samples per pixel; default 16");
  add_number(list, "--seed", settings.seed, 0, 4294967295.0, "seed of samples and sampled points; default 1");
  add_number(list, "--max-bounces", settings.max_bounces, 0, 64, "most secondary rays in a path; default 8");
  add_choice<bool>(list, "--shadows", settings.shadows, {{"on", true}, {"off", false}}, "default on");
  add_choice<std::uint32_t>(
      list, "--blend", settings.blend,
      {{"window", BLEND_WINDOW}, {"paper", BLEND_PAPER}, {"nearest", BLEND_NEAREST}, {"leaf", BLEND_LEAF}},
      "blending of the splats at a hit; leaf = the first leaf's only, which shows seams; default window");
  add_choice<std::uint32_t>(list, "--kernel", settings.kernel,
                            {{"rim", KERNEL_RIM}, {"gaussian", KERNEL_GAUSSIAN}},
                            "weight of a splat over its disc; default rim (zero there)");
  add_number(list, "--kappa", settings.kappa, 1e-6, 1e6, "blending depth in splat radii; default 1");
  add_choice<std::uint32_t>(list, "--side", settings.side,
                            {{"side", SIDE_SIDE}, {"delta", SIDE_DELTA}, {"none", SIDE_NONE}},
                            "how secondary rays leave their surface; default side");
  list.add_value(
      "--delta",
      [&picture](const std::string& text) {
        picture.delta_world = read_number<double>("--delta", text, 0.0, 1e30);
      },
      [&picture] { return picture.delta_world ? number_text(*picture.delta_world) : ""; },
      "minimum distance of --side delta, world units; default diagonal / 1000", "X");
  add_choice<std::uint32_t>(list, "--order", settings.order, {{"z", ORDER_Z}, {"linear", ORDER_LINEAR}},
                            "order of threads over pixels; default z");
  list.add_switch("--counters", settings.counters, "count rays, steps and tests (slower) for --stats-json");
  add_text(list, "--device", picture.device,
           "device number or part of its name, or cpu: the processors without Vulkan; default the best",
           "N|NAME");
}

}  // namespace

void add_scene_options(OptionList& list, SceneOptions& scene) {
  list.add_paths("SCENE", scene.inputs,
                 "a .soct scene, or what splatray-preprocess reads: " + format_extensions(), "FILE");
  list.add_words([&scene] {
    Words words;
    for (const std::filesystem::path& input : scene.inputs)
      words.push_back(input.string().starts_with('-') ? "./" + input.string() : input.string());
    return words;
  });
  add_build_options(list, scene, "--points");
  std::vector<Choice<std::string>> materials;
  for (const std::string& name : material_names()) materials.push_back({name, name});
  add_choice(list, "--material", scene.material, materials,
             "material of a scene with one object; glass and ruby need a closed one");
}

Tone choose_tone(const PictureOptions& picture) {
  return picture.tone.value_or(picture.look == LOOK_PAPER ? Tone::soft : Tone::neutral);
}

void set_camera(PictureOptions& picture, const Camera& camera) {
  picture.eye = camera.eye;
  picture.target = camera.target;
  picture.camera_up = camera.up;
  picture.fov_y_deg.reset();
  if (camera.ortho_height == 0.0) picture.fov_y_deg = camera.fov_y_deg;
  picture.ortho_height = camera.ortho_height;
}

void add_picture_options(OptionList& list, PictureOptions& picture) {
  add_camera_options(list, picture);
  add_light_options(list, picture);
  add_environment_options(list, picture);
  add_object_options(list, picture);
  add_attribute_options(list, picture);
  add_look_options(list, picture);
  add_method_options(list, picture);
}

}  // namespace splatray

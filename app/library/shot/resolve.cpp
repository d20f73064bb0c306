#include "app/library/shot/resolve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/library/request/consistent.h"
#include "app/library/request/daylight_text.h"
#include "app/library/request/fields.h"
#include "app/library/shot/picture_notes.h"
#include "app/library/shot/sheet_placement.h"
#include "app/library/shot/sheet_set.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/image/point_sample.h"
#include "engine/image/upright.h"
#include "engine/scene/look_style.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

constexpr const char* ORIENTATION = "orientation";
/// Stops that make up for what LOOK_SCAN keeps for lights (SCAN_SKY in transport.glsl).
constexpr double SKY_EXPOSURE_EV = 0.331;

void note(Shot& shot, const std::string& field, const std::string& text) {
  shot.choices.push_back({field, text});
}

/// Where a scan, or a model of a room, is seen from. An orbit is from outside, a path has cameras of its own.
void resolve_view(const SceneFacts& facts, Shot& shot) {
  Request::View& view = shot.request.view;
  const bool is_plain = facts.kind == SceneKind::none && facts.viewpoint == Viewpoint::front;
  const bool is_asked = view.eye || view.sheet || !shot.request.output.camera_path.empty() ||
                        view.viewpoint != Viewpoint::automatic;
  if (is_plain || is_asked) return;
  const bool from_outside = shot.request.output.orbit_columns > 0;
  view.viewpoint =
      from_outside && facts.viewpoint == Viewpoint::inside ? Viewpoint::dollhouse : facts.viewpoint;
  note(shot, "view", viewpoint_name(view.viewpoint));
  if (view.viewpoint == facts.viewpoint) shot.views = facts.views;
}

/// Says of a scan's doll's house that it stays closed: whoever asked for it looks for the walls' insides.
void note_closed(const Scene& scene, const SceneFacts& facts, Shot& shot) {
  const Request::View& view = shot.request.view;
  if (facts.kind == SceneKind::none || view.eye || view.viewpoint != Viewpoint::dollhouse) return;
  const CheckedView checked = check_view(scene, main_parts(sample_points(scene)), Viewpoint::dollhouse);
  if (checked.fault != ViewFault::closed) return;
  shot.notes.push_back(
      "the doll's house stays closed: " + number_text(std::round(100.0 * checked.share)) +
      " % of what is in front faces away from the camera, of a room most does; " +
      "the sides of its surfaces are unsure, --sensor with the scanner's place decides them");
}

/// How much of a scan was read.
void resolve_lod(const SceneFacts& facts, Shot& shot) {
  if (!facts.overview || shot.request.source.lod == facts.lod) return;
  shot.request.source.lod = facts.lod;
  note(shot, "lod", number_text(facts.lod));
}

bool is_inside(const SceneFacts& facts, const Request& request) {
  return facts.kind == SceneKind::room && request.view.viewpoint == Viewpoint::inside;
}

/// Drawings of rooms and objects are on white paper; of sites heights are the content. Who names a material wants that and no colours
/// over it.
const char* resolve_colors(const SceneFacts& facts, const Request& request) {
  const bool inside = is_inside(facts, request);
  if (facts.has_colors) return "rgb";
  if (request.view.sheet && facts.kind != SceneKind::site && !facts.sees_land) return ORIENTATION;
  if (asks_for_materials(request.look)) return "plain";
  const bool land =
      facts.kind == SceneKind::site || facts.sees_land || (facts.kind == SceneKind::room && !inside);
  if (facts.has_intensity) return land ? "height+intensity" : "intensity";
  return land || facts.kind == SceneKind::room ? "height" : "plain";
}

void resolve_color_by(const SceneFacts& facts, Shot& shot) {
  std::string& color_by = shot.request.look.attributes.color_by;
  if (facts.kind == SceneKind::none || !color_by.empty()) return;
  color_by = facts.color_by.empty() ? resolve_colors(facts, shot.request) : facts.color_by;
  note(shot, "color-by", color_by);
  if (facts.shows_normals && facts.color_by.empty())
    shot.notes.push_back(
        "the colours are the normals' directions and are not shown; --color-by rgb shows them");
}

/// A section lies in the shade of what is above it: the sky's light shows it, too.
void resolve_scan_look(const Scene& scene, const SceneFacts& facts, Shot& shot) {
  Request& request = shot.request;
  if (facts.kind == SceneKind::none || request.look.style || resolve_look(scene, request) != LOOK_SCAN)
    return;
  const bool all_lit =
      request.look.attributes.color_by == "rgb" || is_inside(facts, request) || request.view.sheet;
  request.look.style = all_lit ? LOOK_SCAN : LOOK_LIT;
  note(shot, "look", all_lit ? "scan" : "lit");
}

/// Whether nothing but the studio is asked for around a scene.
bool is_in_studio(const Scene& scene, const Request& request) {
  return request.look.environment.empty() && scene.environment_path.empty();
}

bool has_own_lights(const Scene& scene, const Request& request, std::uint32_t look) {
  return !scene.lights.empty() && !request.look.lights && look_style(look).lights;
}

/// The studio beside a scene's own lights is as strong for them as it is for lights of irradiance pi, unless that is asked for: their
/// power is the file's, which may be any.
void resolve_environment(const Scene& scene, Shot& shot) {
  constexpr double MOST_STRENGTH = 1e6;  // of --environment-strength
  Request& request = shot.request;
  const bool open = is_in_studio(scene, request) &&
                    request.settings.environment_strength == Settings{}.environment_strength;
  const double level = own_light_level(scene);
  if (!open || !has_own_lights(scene, request, shot.settings.look) || !(level > 0.0) || !std::isfinite(level))
    return;
  request.look.environment = "studio";
  request.settings.environment_strength =
      static_cast<float>(std::min(level / std::numbers::pi, MOST_STRENGTH));
  shot.settings.environment_strength = request.settings.environment_strength;
  note(shot, "environment", request.look.environment);
  note(shot, "environment-strength", text_of(request.settings.environment_strength));
}

/// Whether a scan is looked at from among its points.
bool is_within(const Request& request) {
  return request.view.viewpoint == Viewpoint::sensor || request.view.viewpoint == Viewpoint::inside;
}

/// Turns the studio to where a scan is looked at from among its points, so that its lamps stand beside the camera as they do for what is
/// seen from outside, and not in the picture.
void resolve_studio_turn(const Scene& scene, Shot& shot) {
  Request& request = shot.request;
  const bool in_studio =
      is_in_studio(scene, request) && request.settings.environment_turn == Settings{}.environment_turn;
  if (scene.stations.empty() || shot.settings.look != LOOK_LIT || !is_within(request) || !in_studio) return;
  const glm::dmat3 axes = upright_axes(scene.up);
  const glm::dvec3 ahead = shot.view.camera.target - shot.view.camera.eye;
  const double turns =
      std::atan2(-glm::dot(ahead, axes[0]), -glm::dot(ahead, axes[2])) / (2.0 * std::numbers::pi);
  request.settings.environment_turn =
      static_cast<float>(std::round(1000.0 * (turns - std::floor(turns))) / 1000.0);
  if (request.settings.environment_turn == Settings{}.environment_turn) return;
  shot.settings.environment_turn = request.settings.environment_turn;
  note(shot, "environment-turn", text_of(request.settings.environment_turn));
}

/// Gaps between what a scanner met of the land around it are dark in what is seen from there: nothing was met. A studio would be white in
/// them, as it is exposed for the points.
void resolve_background(const Scene& scene, const SceneFacts& facts, Shot& shot) {
  constexpr glm::vec3 DARK(0.004F, 0.004F, 0.005F);
  Request& request = shot.request;
  const bool is_asked =
      request.settings.asked_environment_seen || request.settings.background || request.settings.transparent;
  const bool is_plain = shot.settings.look != LOOK_LIT && shot.settings.look != LOOK_SCAN;
  if (!facts.sees_land || !is_within(request) || !is_in_studio(scene, request) || is_asked || is_plain)
    return;
  request.settings.background = shot.settings.background = DARK;
  note(shot, "background", number_text(DARK));
}

/// Whether the exposure is the picture's where none is asked for: of scans, whose colours are as bright as their scanner took them,
/// within rooms, where little of the light comes, and in light of physical units.
bool exposes_by_default(const Scene& scene, const Request& request, std::uint32_t look) {
  const bool within = request.view.viewpoint == Viewpoint::inside && look_style(look).lights;
  const bool physical = has_own_lights(scene, request, look) ||
                        (is_daylight(request.look.environment) && look_style(look).lights);
  return request.look.exposure_auto || !scene.stations.empty() || within || physical;
}

/// Greys by orientation, where nothing darkens them as bright as they are, and lines where surfaces end.
void resolve_white_paper(Shot& shot) {
  Request::Look& look = shot.request.look;
  if (!shot.request.view.sheet || shot.request.view.xray || look.attributes.color_by != ORIENTATION ||
      look.style != LOOK_SCAN)
    return;
  if (!look.lights) {
    look.lights.emplace();
    note(shot, "lights", "none");
  }
  if (!shot.request.view.ink) {
    shot.request.view.ink = true;
    note(shot, "ink", "on");
  }
  if (!look.tone) {
    look.tone = Tone::none;
    note(shot, "tone", "none");
  }
  if (look.exposure_ev || look.exposure_auto) return;
  look.exposure_ev = SKY_EXPOSURE_EV;
  note(shot, "exposure", number_text(SKY_EXPOSURE_EV));
}

void choose_denoise(Shot& shot) {
  std::optional<bool>& denoise = shot.request.output.denoise;
  if (denoise || !resolve_denoise(shot.request, shot.settings.look)) return;
  denoise = true;
  note(shot, "denoise", "on");
}

/// Has occlusion reach as far as suits what a region holds. Throws Error (usage) where that is nothing.
void resolve_reach(const Scene& scene, const Region& region, double& reach_world) {
  if (region.empty()) return;
  const PointSample kept = sample_points(scene, region);
  if (kept.size() == 0)
    throw Error(ExitCode::usage, "the region holds nothing of the scene, whose points lie between " +
                                     number_text(scene.bounds_min_world) + " and " +
                                     number_text(scene.bounds_max_world) +
                                     "; expected boxes and cuts that do");
  if (reach_world == 0.0) reach_world = REACH_SHARE * diagonal_of(kept);
}

/// What suits a drawing: light of what is kept, nothing in the background, for --xray no tone.
void resolve_sheet(Request& request) {
  Request::View& view = request.view;
  view.region.light_kept = view.region.light_kept.value_or(true);
  if (!request.settings.background) request.settings.transparent = true;
  request.settings.aov = request.settings.aov || (view.ink && view.crop.width == 0 && view.tiles == 0) ||
                         !request.output.height_raster.empty();
  if (!view.xray) return;
  request.look.exposure_ev = 0.0;
  request.look.tone = Tone::none;
}

/// Draws the sheet or, of several, all, of which the shot shows the first.
void resolve_drawing(const Scene& scene, const SceneFacts& facts, Shot& shot) {
  const Request& request = shot.request;
  const bool has_legend = !request.view.xray && look_style(resolve_look(scene, request)).colors;
  const auto show = [&](Sheet& sheet) {
    if (has_legend) sheet.legend = facts.legend;
    for (std::string& odd : odd_sheet(sheet))
      if (std::find(shot.notes.begin(), shot.notes.end(), odd) == shot.notes.end())
        shot.notes.push_back(std::move(odd));
    show_sheet(sheet, shot);
  };
  if (request.view.sheet->is_set()) {
    SheetSet set = make_sheet_set(scene, request);
    for (auto sheet = set.sheets.rbegin(); sheet != set.sheets.rend(); ++sheet) show(*sheet);
    shot.output = std::move(set);
    return;
  }
  Sheet sheet = make_sheet(scene, request);
  require_part_of(request.view, sheet.width, sheet.height);
  show(sheet);
  shot.output = std::move(sheet);
}

void set_pixels(std::uint32_t width, std::uint32_t height, Shot& shot) {
  shot.view.width = width;
  shot.view.height = height;
  shot.view.window = window_of(shot.request.view, width, height);
}

/// The camera but for what lens and pixels have.
Camera placed_camera(const Scene& scene, const Request& request, double aspect) {
  const glm::dvec3 scene_up = request.look.up.value_or(scene.up);
  if (request.view.eye) {
    const glm::dvec3 target =
        request.view.target.value_or(0.5 * (scene.bounds_min_world + scene.bounds_max_world));
    const auto up = request.view.camera_up ? request.view.camera_up : request.look.up;
    return {*request.view.eye, target, up.value_or(up_across(scene.up, target - *request.view.eye)),
            request.view.fov_y_deg.value_or(DEFAULT_FOV_Y_DEG), request.view.ortho_height};
  }
  // A depth camera's view suits the picture's shape; a model's own camera is its author's.
  if (!scene.camera || !scene.stations.empty() || request.look.up ||
      request.view.viewpoint != Viewpoint::automatic)
    return viewpoint_camera(scene, request.view.viewpoint, aspect, request.view.fov_y_deg,
                            region_of(request.view.region, scene_up));
  Camera camera = *scene.camera;
  camera.fov_y_deg = request.view.fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

/// Whether a material is another than readers give to points, whose base colour alone depends on them.
bool is_chosen(const Material& material) {
  const Phong &phong = material.phong, plain = default_material().phong;
  return phong.specular != plain.specular || phong.shininess != plain.shininess ||
         phong.mirror != plain.mirror || (material.flags & MATERIAL_DIELECTRIC) != 0;
}

}  // namespace

std::uint32_t resolve_look(const Scene& scene, const Request& request) {
  if (request.look.style) return *request.look.style;
  const bool plain = scene.lights.empty() && is_in_studio(scene, request) && !request.look.lights;
  const bool materials = asks_for_materials(request.look) ||
                         std::any_of(scene.materials.begin(), scene.materials.end(), is_chosen);
  return !scene.stations.empty() && plain && !materials ? LOOK_SCAN : LOOK_LIT;
}

Settings resolve_settings(const Scene& scene, const Request& request) {
  Settings settings = request.settings;
  settings.region = region_of(request.view.region, request.look.up.value_or(scene.up));
  settings.look = resolve_look(scene, request);
  settings.cutaway = request.view.look_in || request.view.viewpoint == Viewpoint::dollhouse;
  settings.lens_radius_world = 0.5 * request.view.aperture_world;
  settings.delta_world = request.settings.asked_delta_world.value_or(1e-3 * scene.diagonal_world());
  return settings;
}

bool resolve_denoise(const Request& request, std::uint32_t look) {
  if (look == LOOK_PAPER || request.settings.samples < 2) return false;
  const Request::Output& output = request.output;
  if (output.denoise) return *output.denoise;
  const bool decided = output.despeckle || request.settings.has_goal() || !output.reference.empty();
  const bool is_part =
      request.view.crop.width > 0 || request.view.tiles > 0 || request.settings.sample_offset > 0;
  return !decided && !is_part && !request.view.xray && lower_extension(output.path) != ".exr";
}

Tone resolve_tone(const Request& request) {
  const bool has_no_toe = request.look.style == LOOK_PAPER || request.look.style == LOOK_SCAN;
  return request.look.tone.value_or(has_no_toe ? Tone::soft : Tone::neutral);
}

Camera resolve_camera(const Scene& scene, const Request& request, double aspect) {
  Camera camera = placed_camera(scene, request, request.view.pixel_aspect * aspect);
  camera.lens_shift = request.view.lens_shift;
  camera.pixel_aspect = request.view.pixel_aspect;
  camera.panorama = request.view.panorama;
  if (camera.panorama) camera.ortho_height = 0.0;
  return camera;
}

UpFound resolve_up(const Scene& scene, const Request& asked) {
  return asked.look.up ? UpFound{*asked.look.up, UpEvidence::asked} : upright(scene);
}

AttributeOptions resolve_attributes(const Request& asked, const SceneFacts& facts) {
  Shot shot;
  shot.request = asked;
  resolve_view(facts, shot);
  resolve_color_by(facts, shot);
  return shot.request.look.attributes;
}

Shot draft(const Request& asked) {
  Shot shot;
  shot.request = asked;
  shot.settings = asked.settings;
  const glm::uvec2 size = picture_size(asked.view);
  set_pixels(size.x, size.y, shot);
  Plan plan = plan_pictures(asked);
  shot.frames = std::move(plan.frames);
  if (asked.output.many()) shot.output = std::move(plan.sequence);
  if (asked.output.orbit_columns > 0)
    shot.output = Orbit{asked.output.orbit_columns, asked.output.orbit_rows};
  return shot;
}

Shot resolve(const Request& asked, const Scene& scene, const SceneFacts& facts) {
  require_consistent(asked);
  Shot shot = draft(asked);
  resolve_lod(facts, shot);
  resolve_view(facts, shot);
  resolve_color_by(facts, shot);
  resolve_scan_look(scene, facts, shot);
  resolve_white_paper(shot);
  Request& request = shot.request;
  if (request.view.sheet) resolve_sheet(request);
  const Scene& whole = facts.overview ? *facts.overview : scene;
  shot.settings = resolve_settings(whole, request);
  if (request.view.sheet) {
    resolve_drawing(whole, facts, shot);
  } else {
    shot.view.camera =
        resolve_camera(whole, request, static_cast<double>(shot.view.width) / shot.view.height);
  }
  resolve_reach(scene, shot.settings.region, request.settings.reach_world);
  if (facts.overview && request.settings.reach_world == 0.0)
    request.settings.reach_world = REACH_SHARE * whole.diagonal_world();
  shot.settings.reach_world = request.settings.reach_world;
  resolve_environment(scene, shot);
  resolve_studio_turn(whole, shot);
  resolve_background(whole, facts, shot);
  choose_denoise(shot);
  shot.exposes = !request.look.exposure_ev && exposes_by_default(scene, request, shot.settings.look);
  shot.environment = request.look.environment.empty() ? scene.environment_path : request.look.environment;
  for (std::string& ignored : ignored_options(asked, shot.settings.look))
    shot.notes.push_back(std::move(ignored));
  note_closed(whole, facts, shot);
  if (facts.kind != SceneKind::none) shot.of = scan_kind_name(facts.kind);
  return shot;
}

}  // namespace splatray

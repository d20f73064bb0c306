#include "app/library/shot/picture_notes.h"

#include <algorithm>

#include "engine/scene/look_style.h"

namespace splatray {
namespace {

bool is_black(const vec3& radiance) { return radiance == vec3(0.0F); }

bool is_black(const Environment& environment) {
  return environment.texels.empty() ? is_black(environment.constant)
                                    : std::all_of(environment.texels.begin(), environment.texels.end(),
                                                  [](const vec3& texel) { return is_black(texel); });
}

}  // namespace

std::vector<std::string> ignored_options(const Request& request, std::uint32_t look) {
  const LookStyle style = look_style(look);
  const Settings plain;
  std::vector<std::string> notes;
  const auto note = [&](bool asked, bool used, const std::string& option, const std::string& instead) {
    if (asked && !used) notes.push_back("this --look does not use " + option + ", " + instead);
  };
  const bool reach = look == LOOK_AO || look == LOOK_SCAN;
  note(asks_for_materials(request.look), style.surfaces, "materials", "--look lit does");
  note(request.look.lights && !request.look.lights->empty(), style.lights, "lights", "--look lit does");
  note(!request.settings.shadows, style.lights, "--shadows", "--look lit does");
  note(request.settings.reach_world > 0.0, reach, "--ao-radius", "--look ao and scan do");
  note(request.settings.straight_shadows, look == LOOK_LIT, "--glass-shadows", "--look lit does");
  note(request.view.aperture_world > 0.0, look != LOOK_PAPER, "--aperture", "the others do");
  note(request.settings.focus_world > 0.0, look != LOOK_PAPER && request.view.aperture_world > 0.0, "--focus",
       "the others do, beside --aperture");
  note(request.settings.max_bounces != plain.max_bounces, style.paths || look == LOOK_PAPER, "--bounces",
       "--look lit, clay and paper do");
  note(request.settings.clamp > 0.0F, style.paths, "--clamp", "--look lit and clay do");
  return notes;
}

bool sends_out_light(const ObjectLooks& objects) {
  for (std::size_t i = 0; i < objects.surfaces.size(); ++i)
    if (!is_black(shown_emission(objects, i))) return true;
  return false;
}

std::vector<std::string> missing_light(const Look& look, const Settings& settings) {
  if (!look_style(settings.look).lights || settings.look == LOOK_SCAN) return {};
  std::vector<std::string> notes;
  const auto powerless = std::count_if(look.lights.begin(), look.lights.end(),
                                       [](const SceneLight& light) { return is_black(light.power); });
  if (powerless > 0)
    notes.push_back(std::to_string(powerless) + " of " + std::to_string(look.lights.size()) +
                    " lights have no power");
  const bool lit =
      powerless < std::ssize(look.lights) || (settings.look == LOOK_LIT && sends_out_light(look.objects));
  const bool sky = look.environment && settings.environment_strength > 0.0F && !is_black(*look.environment);
  if (!lit && !sky)
    notes.push_back(
        "nothing sends out light and the picture is black; --light, --sun or --environment studio give some");
  return notes;
}

}  // namespace splatray

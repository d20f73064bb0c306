#include "app/library/shot/picture_notes.h"

#include <algorithm>

#include "app/library/request/fields.h"
#include "engine/base/number_text.h"
#include "engine/scene/look_style.h"

namespace splatray {
namespace {

bool is_black(const vec3& radiance) { return radiance == vec3(0.0F); }

bool is_black(const Environment& environment) {
  return environment.texels.empty() ? is_black(environment.constant)
                                    : std::all_of(environment.texels.begin(), environment.texels.end(),
                                                  [](const vec3& texel) { return is_black(texel); });
}

/// "--look lit, clay and paper do": the looks that use a field.
std::string users_of(const Field& field) {
  const Field& look = *find_field("look", DOOR_RENDER);
  std::vector<std::string> names;
  for (const std::string& name : look.choices) {
    Request request;
    look.read(request, name);
    if (request.look.style && field.used_by(*request.look.style)) names.push_back(name);
  }
  std::string text = "--look ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : (i + 1 == names.size() ? " and " : ", ")) + names[i];
  return text + (names.size() == 1 ? " does" : " do");
}

}  // namespace

std::vector<std::string> ignored_options(const Request& request, std::uint32_t look) {
  std::vector<std::string> notes;
  if (asks_for_materials(request.look) && !look_style(look).materials)
    notes.emplace_back("this --look does not use materials, --look lit does");
  for (const Field& field : fields()) {
    if (field.used_by(look) || !field.write) continue;
    const std::vector<FieldText> values = field.write(request);
    if (!values.empty() && values != field.write(Request{}))
      notes.push_back("this --look does not use --" + values.front().name + ", " + users_of(field));
  }
  if (request.settings.focus_world > 0.0 && request.view.aperture_world == 0.0 && look != LOOK_PAPER)
    notes.emplace_back("--focus does nothing without --aperture");
  return notes;
}

bool sends_out_light(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& material) { return !is_black(shown_emission(material)); });
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
      powerless < std::ssize(look.lights) || (settings.look == LOOK_LIT && sends_out_light(look.materials));
  const bool sky = look.environment && settings.environment_strength > 0.0F && !is_black(*look.environment);
  if (!lit && !sky)
    notes.push_back(
        "nothing sends out light and the picture is black; --light, --sun or --environment studio give some");
  return notes;
}

std::vector<std::string> odd_sheet(const Sheet& sheet) {
  std::vector<std::string> notes;
  if (!sheet.unit_known)
    notes.emplace_back(
        "the file names no unit; the sheet takes its coordinates for metres, unit= in --sheet says others");
  if (sheet.cuts && !sheet.floor && sheet.asked.weight_mm > 0.0 && sheet.cut_curves.empty())
    notes.push_back("the sheet's cut" +
                    (sheet.asked.height ? " at height " + number_text(*sheet.asked.height) : std::string()) +
                    " meets no surface");
  return notes;
}

}  // namespace splatray

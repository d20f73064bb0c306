#include <memory>

#include "app/library/materials.h"
#include "app/library/request/fields.h"
#include "engine/base/number_text.h"
#include "engine/base/utf8.h"

namespace splatray {
namespace {

constexpr FieldGroup LOOK = FieldGroup::look;

Field look_row() {
  return choice_row<std::optional<std::uint32_t>>(
      "look", LOOK, MEMBER(look.style),
      {{"auto", std::nullopt},
       {"lit", LOOK_LIT},
       {"clay", LOOK_CLAY},
       {"ao", LOOK_AO},
       {"scan", LOOK_SCAN},
       {"paper", LOOK_PAPER}},
      "lit: path tracing; clay: the same, all of it white clay; ao: ambient occlusion; scan: the points' "
      "colours under occlusion and a soft light; paper: Phong, hard shadows, mirrors and glass; default "
      "auto: scan for points with colours and without materials, else lit");
}

Field material_row() {
  std::vector<Choice<std::string>> materials;
  for (const std::string& name : material_names()) materials.push_back({name, name});
  return choice_row("material", LOOK, MEMBER(look.material), materials,
                    "material of a scene with one object; glass and ruby need a closed one");
}

Field object_row() {
  Field row = value_row(
      "object", LOOK, "OBJECT:KEY=VALUE,...",
      "change the material of one object, given by its index or name; keys: " + object_keys_help() +
          "; diffuse, specular, shininess, mirror and tint are of --look paper, and what path tracing sees "
          "follows from them unless the keys from metallic on say it; repeatable, the last change holds",
      [](Request& request, const std::string& text) {
        request.look.objects.push_back(read_object_change(to_utf8(text)));
      },
      {});
  row.repeated = row.adds = true;
  row.clear = [](Request& request) { request.look.objects.clear(); };
  row.write = [](const Request& request) {
    std::vector<FieldText> texts;
    for (const ObjectChange& object : request.look.objects) texts.push_back({"object", object_text(object)});
    return texts;
  };
  return row;
}

Field color_range_row() {
  return value_row(
      "color-range", LOOK, "LOW,HIGH", "values at the ends of the colours; default 2 to 98 % of all values",
      [](Request& request, const std::string& text) {
        const auto numbers = split_numbers(text, ',', 2);
        if (numbers.empty() || !(numbers[0] < numbers[1]))
          throw Expected{"two numbers LOW,HIGH with LOW < HIGH"};
        request.look.attributes.color_range = {numbers[0], numbers[1]};
      },
      [](const Request& request) {
        const auto& range = request.look.attributes.color_range;
        return range ? number_text((*range)[0]) + "," + number_text((*range)[1]) : "";
      });
}

/// A list of whole numbers from 0 on, by commas.
template <class Member>
Field number_list_row(std::string name, Member member, std::string help) {
  return value_row(
      std::move(name), LOOK, "N,...", std::move(help),
      [=](Request& request, const std::string& text) {
        std::vector<std::uint32_t> numbers;
        for (const std::string& number : split_names(text))
          numbers.push_back(static_cast<std::uint32_t>(read_number(number, 0, 65535, true)));
        member(request) = numbers;
      },
      [=](const Request& request) {
        std::string text;
        for (const std::uint32_t number : member(request))
          text += (text.empty() ? "" : ",") + std::to_string(number);
        return text;
      });
}

Field tone_row() {
  std::vector<Choice<std::optional<Tone>>> tones = {{"auto", std::nullopt}};
  for (std::size_t i = 0; i < TONE_NAMES.size(); ++i) tones.push_back({TONE_NAMES[i], Tone(i)});
  return choice_row(
      "tone", LOOK, MEMBER(look.tone), tones,
      "how a PNG shows what is brighter than white: neutral (colours stay), agx (like film), soft (each "
      "channel alone), none (cut off); default auto: soft with --look paper and scan, else neutral");
}

Field exposure_row() {
  return value_row(
      "exposure", LOOK, "EV|auto",
      "brightness of a PNG in stops, or auto: what is seen becomes middle grey on the mean, less where it "
      "would be too bright, as measured on a small picture of the same view; near that in daylight and a "
      "file's own lights "
      "what makes white look white in the open; default auto for scans, in "
      "daylight and in a "
      "file's own lights, else 0",
      [](Request& request, const std::string& text) {
        request.look.exposure_ev.reset();
        request.look.exposure_auto = text == "auto";
        if (!request.look.exposure_auto) request.look.exposure_ev = read_number(text, -60.0, 60.0, false);
      },
      [](const Request& request) {
        if (request.look.exposure_ev) return number_text(*request.look.exposure_ev);
        return std::string(request.look.exposure_auto ? "auto" : "");
      });
}

}  // namespace

std::vector<Field> look_fields() {
  return {
      needed(look_row(), "lit, clay, ao, scan or paper"),
      needed(text_row("color-by", LOOK, MEMBER(look.attributes.color_by),
                      "colours of points: rgb (their own), plain (none), height (low to high: blue-green, "
                      "green, ochre, rose), height+intensity (darker where that is low), normal, orientation "
                      "(greys), distance "
                      "(from the scanner), or an attribute they have, such as intensity, class, return, "
                      "source, scan, kind (surface, line or scatter); default rgb, of scans without colours "
                      "intensity, of sites and rooms height with it, of rooms on sheets orientation",
                      "NAME"),
             "rgb, height, intensity, class, normal, ...")
          .marked(OF_SCENES),
      color_range_row().marked(OF_SCENES),
      number_list_row("hide-class", MEMBER(look.attributes.hidden_classes),
                      "classes that are not shown, such as 7,18")
          .marked(OF_SCENES),
      number_list_row("hide-scan", MEMBER(look.attributes.hidden_scans), "scans that are not shown, from 0")
          .marked(OF_SCENES),
      needed(material_row(), "what a scene of one object is made of").marked(OF_SCENES | OF_PICTURES),
      object_row().marked(OF_SCENES | OF_PICTURES),
      needed(exposure_row(), "brightness in stops, or auto").marked(NOT_OF_LIGHT),
      tone_row().marked(NOT_OF_LIGHT),
      unset_number_row("ao-radius", LOOK, MEMBER(settings.reach_world), 1e-30, 1e30,
                       "ao and scan: how far away something darkens a point, world units; default a tenth of "
                       "the scene's diagonal")
          .of_looks({LOOK_AO, LOOK_SCAN}),
      choice_row<bool>("glass-shadows", LOOK, MEMBER(settings.straight_shadows),
                       {{"paths", false}, {"straight", true}},
                       "lit: what glass leaves of the light of lights: what paths find, or tinted shadows, "
                       "without refraction; default paths")
          .of_looks({LOOK_LIT})};
}

}  // namespace splatray

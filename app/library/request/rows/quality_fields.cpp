#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup QUALITY = FieldGroup::quality;

/// Seeds the picture's samples, the points sampled on meshes and the probe rays.
Field seed_row() {
  Field row = number_row("seed", QUALITY, MEMBER(settings.seed), 0, 4294967295.0,
                         "seed of samples and of points sampled on meshes; default 1");
  row.read = [read = row.read](Request& request, const std::string& text) {
    read(request, text);
    request.source.params.seed = request.settings.seed;
  };
  row.doors = DOORS_ALL;
  return row;
}

/// One of two names for whether noise is taken out, of which the last one holds.
Field noise_row(std::string name, bool denoises, std::string help) {
  Field row = switch_row(std::move(name), QUALITY, MEMBER(output.despeckle), std::move(help));
  row.family = "noise";
  row.read = [denoises](Request& request, const std::string& text) {
    if (text != "on" && text != "off") throw Expected{"on or off"};
    request.output.denoise = denoises == (text == "on");
  };
  row.write = [name = row.name, denoises](const Request& request) {
    const bool said = request.output.denoise == denoises;
    return said ? std::vector<FieldText>{{name, "on"}} : std::vector<FieldText>{};
  };
  return row;
}

Field shadows_row() {
  return on_off_row("shadows", QUALITY, MEMBER(settings.shadows), "whether lights cast shadows; default on");
}

}  // namespace

std::vector<Field> quality_fields() {
  return {
      needed(
          number_row("samples", QUALITY, MEMBER(settings.samples), 1, 65536, "samples per pixel; default 16"),
          "samples a pixel: more for less noise")
          .marked(OF_FILES | HAS_OWN_CONTROL | NOT_OF_LIGHT),
      number_row("sample-offset", QUALITY, MEMBER(settings.sample_offset), 0, 65535,
                 "index of the first sample, a multiple of the part's length (64, 128, 256 ...): "
                 "splatray-merge adds "
                 "up such parts of a picture; default 0")
          .marked(OF_FILES),
      unset_number_row("error", QUALITY, MEMBER(settings.error_goal), 1e-6, 1e3,
                       "render until the estimated relative error is below X in every 32 x 32 pixels, e.g. "
                       "0.02; replaces --samples; default none")
          .marked(OF_FILES),
      unset_number_row("time", QUALITY, MEMBER(settings.seconds_goal), 1e-3, 1e9,
                       "the best picture in X seconds of tracing, instead of --samples; beside --error the "
                       "end of it; default none")
          .marked(OF_FILES),
      needed(noise_row("denoise", /*denoises=*/true,
                       "take the noise out: by Open Image Denoise 2 where it is installed, else by a filter "
                       "of our own; whole pictures but .exr go through it anyway, unless --keep-noise, "
                       "--despeckle, --error, --time or --reference say otherwise or the look has none"),
             "take the noise out")
          .marked(OF_FILES | NOT_OF_LIGHT),
      switch_row("despeckle", QUALITY, MEMBER(output.despeckle),
                 "take out only bright dots: pixels that one half of the samples finds more than 1.5 times "
                 "as bright as the other half finds any around them; a little light is lost")
          .marked(OF_FILES),
      noise_row("keep-noise", /*denoises=*/false, "do not take the noise out")
          .marked(OF_FILES | NOT_OF_LIGHT),
      with(number_row(
               "bounces", QUALITY, MEMBER(settings.max_bounces), 0, 64,
               "most secondary rays in a path, but for the ray by which its last surface sees what sends out "
               "light; default 8"),
           {.old_names = {"max-bounces"}})
          .of_looks({LOOK_PAPER, LOOK_LIT, LOOK_CLAY}),
      number_row("clamp", QUALITY, MEMBER(settings.clamp), 0.0, 1e9,
                 "lit: most that a path's light after its first bounce adds to a channel, e.g. 10: fewer "
                 "bright dots, but light is lost; default 0 = any")
          .of_looks({LOOK_LIT, LOOK_CLAY}),
      shadows_row().of_looks({LOOK_PAPER, LOOK_LIT, LOOK_CLAY, LOOK_SCAN}),
      seed_row().marked(OF_SCENES | OF_PICTURES),
      text_row(
          "device", QUALITY, MEMBER(settings.device),
          "device number or part of its name, or cpu: the CPU without Vulkan; default the best GPU, else cpu",
          "N|NAME")
          .marked(OF_SCENES | NOT_OF_LIGHT),
      with(path_row("cache", QUALITY, MEMBER(settings.cache),
                    "folder that compiled pipelines are kept in between runs; default nowhere"),
           {.doors = DOOR_LIBRARY, .why_not = "programs keep them in the user's cache folder"})
          .marked(OF_SCENES | NOT_OF_LIGHT)};
}

}  // namespace splatray

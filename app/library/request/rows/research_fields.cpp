#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup RESEARCH = FieldGroup::research;

/// How splats and their octree are made.
std::vector<Field> build_fields() {
  std::vector<Field> rows = {
      number_row("leaf-size", RESEARCH, MEMBER(source.params.leaf_size), 0, 65536,
                 "octree cells of more splat centres are divided; default 0 = 16, or 24 or 8 where that "
                 "would take more than 64 bytes of GPU memory a splat"),
      choice_row<Insertion>(
          "insertion", RESEARCH, MEMBER(source.params.insertion),
          {{"overlap", Insertion::overlap}, {"probe", Insertion::probe}, {"centre", Insertion::centre}},
          "leaves a splat goes into; default overlap"),
      number_row("probes", RESEARCH, MEMBER(source.params.probes), 1, 65536,
                 "probe rays per leaf for --insertion probe; default 32"),
      choice_row<RadiusRule>("radius-rule", RESEARCH, MEMBER(source.params.radius_rule),
                             {{"coverage", RadiusRule::coverage}, {"knn", RadiusRule::knn}},
                             "radii of points that have none; default coverage"),
      on_off_row("normal-fields", RESEARCH, MEMBER(source.params.normal_fields),
                 "how normals change across each disc, where the scene curves; default on"),
      on_off_row("clip", RESEARCH, MEMBER(source.params.clip),
                 "discs end at borders and creases, of points alone where those are clear; default on")};
  for (Field& row : rows) {
    row.doors = DOORS_ALL;
    row.traits = OF_SCENES;
  }
  return rows;
}

Field delta_row() {
  return value_row(
      "delta", RESEARCH, "X", "minimum distance of --side delta, world units; default diagonal / 1000",
      [](Request& request, const std::string& text) {
        request.settings.asked_delta_world = read_number(text, 0.0, 1e30, false);
      },
      [](const Request& request) {
        const auto& delta_world = request.settings.asked_delta_world;
        return delta_world ? number_text(*delta_world) : "";
      });
}

}  // namespace

std::vector<Field> research_fields() {
  std::vector<Field> rows = build_fields();
  for (Field& row : std::vector<Field>{
           choice_row<std::uint32_t>("blend", RESEARCH, MEMBER(settings.blend),
                                     {{"window", BLEND_WINDOW},
                                      {"paper", BLEND_PAPER},
                                      {"nearest", BLEND_NEAREST},
                                      {"leaf", BLEND_LEAF}},
                                     "blending of the splats at a hit; leaf = the first leaf's only, which "
                                     "shows seams; default window"),
           choice_row<std::uint32_t>("kernel", RESEARCH, MEMBER(settings.kernel),
                                     {{"rim", KERNEL_RIM}, {"gaussian", KERNEL_GAUSSIAN}},
                                     "weight of a splat over its disc; default rim (zero there)"),
           number_row("kappa", RESEARCH, MEMBER(settings.kappa), 1e-6, 1e6,
                      "blending depth in splat radii; default 1"),
           choice_row<std::uint32_t>("side", RESEARCH, MEMBER(settings.side),
                                     {{"side", SIDE_SIDE}, {"delta", SIDE_DELTA}, {"none", SIDE_NONE}},
                                     "how secondary rays leave their surface; default side"),
           delta_row(),
           choice_row<std::uint32_t>("order", RESEARCH, MEMBER(settings.order),
                                     {{"z", ORDER_Z}, {"linear", ORDER_LINEAR}},
                                     "order of threads over pixels; default z"),
           switch_row("counters", RESEARCH, MEMBER(settings.counters),
                      "count rays, steps and tests (slower) for --stats-json")
               .marked(NOT_OF_LIGHT)})
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace splatray

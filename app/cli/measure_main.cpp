/// splatray-measure: a scene and places in, lengths, heights, angles, areas and radii out, each with its uncertainty.
#include <algorithm>
#include <cstdio>

#include "app/cli/load_reporting.h"
#include "app/cli/option_types.h"
#include "app/cli/options.h"
#include "app/cli/typical_work.h"
#include "app/library/measure/measure_file.h"
#include "app/library/picture/measuring.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/shot/scene_source.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/progress.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"

namespace {

using namespace splatray;

struct Asked {
  Request request;
  std::vector<GivenMeasure> measures;
  std::filesystem::path output;
};

constexpr const char* PLACES =
    "; each place X,Y,Z in the file's coordinates, on a surface or a few spacings of its points beside it, "
    "or a "
    "ray X,Y,Z>DX,DY,DZ, of which the first hit counts; several with ; between them; repeatable";

void add_measures(OptionList& list, std::vector<GivenMeasure>& measures) {
  list.set_group("Measures");
  const auto add = [&](MeasureKind kind, const std::string& help, const char* value) {
    const std::string brief = help.substr(0, help.find(';'));
    const std::string name = std::string("--") + measure_name(kind);
    list.add_repeated(
        name,
        [&measures, kind, name](const std::string& text) {
          try {
            measures.push_back(read_measure(kind, text));
          } catch (const Expected& expected) {
            throw Error(ExitCode::usage, name + ": found '" + text + "', expected " + expected.what);
          }
        },
        help, value);
    list.set_brief(name, brief);
  };
  add(MeasureKind::point, std::string("coordinates of a place") + PLACES, "PLACE");
  add(MeasureKind::distance, "distance along two places and more", "PLACE;PLACE...");
  add(MeasureKind::height, "height of the second place above the first", "PLACE;PLACE");
  add(MeasureKind::angle, "angle at the second of three places", "PLACE;PLACE;PLACE");
  add(MeasureKind::area, "area and perimeter of the polygon of three places and more",
      "PLACE;PLACE;PLACE...");
  add(MeasureKind::sphere, "radius of the sphere through what is within REACH of a place", "PLACE;REACH");
  add(MeasureKind::cylinder, "radius of the cylinder through what is within REACH of a place", "PLACE;REACH");
}

/// Nothing when help was asked for and printed.
std::optional<Asked> parse(int argc, char** argv) {
  OptionList list(
      "Measures on the surface of a scan or scene, with the interval that holds the true value 95 times of "
      "100.",
      "splatray-measure");
  GivenFields given;
  Asked asked;
  add_fields(list, DOOR_RENDER, "SCENE", given, {FieldGroup::input, FieldGroup::region});
  add_measures(list, asked.measures);
  list.set_group("Files");
  add_path(list, "-o,--output", asked.output,
           "file to write: .geojson, .dxf or .csv; default: a table on stdout");
  list.set_brief("--output", "file to write: .geojson, .dxf or .csv");
  list.set_examples({{"splatray-measure room.e57 --distance '0,0,0>1,0,0;0,0,0>-1,0,0'",
                      "from wall to wall, along rays from the scanner"},
                     {"splatray-measure room.e57 --height '1,2,0;1,2,2.5' --point 1,2,0",
                      "a height between two places, and one of them"},
                     {"splatray-measure pipes.laz --cylinder '4.1,0.3,1.2;0.15' -o pipe.dxf",
                      "a pipe's radius, for a drawing"}});
  if (!list.parse(argc, argv)) return {};
  assign(asked.request, given, DOOR_RENDER);
  require_inputs(asked.request.source);
  if (asked.measures.empty())
    throw Error(ExitCode::usage, "found nothing to measure, expected for example --distance '0,0,0;1,0,0'");
  if (!asked.output.empty()) {
    require_measures_name(asked.output);
    note_inputs(asked.request);
    claim_output(asked.output);
    require_writable(asked.output);
  }
  return asked;
}

int run(int argc, char** argv) {
  const std::optional<Asked> asked = parse(argc, argv);
  if (!asked) return static_cast<int>(ExitCode::done);
  catch_interrupts();
  ProgressLine line(/*quiet=*/false, ProgressStyle::line, work_of_scene(asked->request.source));
  LoadedScene loaded = load_reporting(asked->request, "splatray-measure", line);
  if (loaded.facts.kind == SceneKind::camera)
    std::fprintf(
        stderr,
        "splatray-measure: note: the scan is a depth camera's, whose depths may be farther off than the "
        "intervals say\n");
  const std::unique_ptr<Device> device = open_device(HOST_DEVICE);
  SceneOnDevice shown(*device);
  shown.open(loaded.scene);
  const Region region = region_of(asked->request.view.region, loaded.scene.up);
  std::vector<Measure> measures;
  for (const GivenMeasure& given : asked->measures)
    measures.push_back(take_measure(loaded.scene, region, given, &shown));
  const MeasureFrame frame{loaded.scene.up, loaded.scene.crs};
  if (!asked->output.empty()) write_measures(measures, frame, asked->output);
  std::fputs(table_of(measures, frame.up).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-measure", run, argc, argv); }

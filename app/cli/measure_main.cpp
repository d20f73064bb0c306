/// splatray-measure: a scene and places in, lengths, heights, angles, areas, radii and volumes out, each with its uncertainty.
#include <algorithm>
#include <cstdio>

#include "app/cli/load_reporting.h"
#include "app/cli/option_types.h"
#include "app/cli/options.h"
#include "app/cli/typical_work.h"
#include "app/library/measure/measure_file.h"
#include "app/library/picture/measuring.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/request/sheet_request.h"
#include "app/library/shot/scene_source.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/progress.h"
#include "engine/base/utf8.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"

namespace {

using namespace splatray;

struct Asked {
  Request request;
  std::vector<GivenMeasure> measures;
  std::optional<double> unit_metres;
  std::filesystem::path output;
};

constexpr const char* PLACES =
    "; each place X,Y,Z in the file's coordinates, on a surface or a few spacings of its points beside it, "
    "or a "
    "ray X,Y,Z>DX,DY,DZ, of which the first hit counts; several with ; between them; repeatable";

/// Reads a value of an option. Throws Error (usage), one sentence.
template <typename Read>
auto read_option(const std::string& name, const std::string& text, const Read& read) {
  try {
    return read(text);
  } catch (const Expected& expected) {
    throw Error(ExitCode::usage, name + ": found '" + text + "', expected " + expected.what);
  }
}

void add_measures(OptionList& list, std::vector<GivenMeasure>& measures) {
  list.set_group("Measures");
  const auto add_named = [&](const std::string& name, MeasureKind kind, const std::string& help,
                             const char* value) {
    const std::string brief = help.substr(0, help.find(';'));
    list.add_repeated(
        name,
        [&measures, kind, name](const std::string& text) {
          measures.push_back(
              read_option(name, text, [kind](const std::string& t) { return read_measure(kind, t); }));
        },
        help, value);
    list.set_brief(name, brief);
  };
  const auto add = [&](MeasureKind kind, const std::string& help, const char* value) {
    add_named(std::string("--") + measure_name(kind), kind, help, value);
  };
  add(MeasureKind::point, std::string("coordinates of a place") + PLACES, "PLACE");
  add(MeasureKind::distance, "distance along two places and more", "PLACE;PLACE");
  add(MeasureKind::horizontal, "distance of two places across the up direction", "PLACE;PLACE");
  add(MeasureKind::vertical, "height of the second place above the first", "PLACE;PLACE");
  list.set_group("");
  add_named(std::string("--") + OLD_VERTICAL, MeasureKind::vertical, "", "PLACE;PLACE");
  list.set_group("Measures");
  add(MeasureKind::angle, "angle at the second of three places", "PLACE;PLACE;PLACE");
  add(MeasureKind::area, "area and perimeter of a polygon of places", "PLACE;PLACE;PLACE...");
  add(MeasureKind::sphere, "radius of the sphere within REACH of a place", "PLACE;REACH");
  add(MeasureKind::cylinder, "radius of the cylinder within REACH of a place", "PLACE;REACH");
  add(MeasureKind::plane, "tilt from level of the plane within REACH", "PLACE;REACH");
  add(MeasureKind::volume,
      "cut and fill between the surface and a base; BASE is z=HEIGHT, plane=X,Y,Z,NX,NY,NZ, earlier=FILE or "
      "corners, the plane through the outline's places on the surface; without an outline over all that the "
      "region holds",
      "[PLACE;PLACE;PLACE...;]BASE");
  list.add_repeated(
      "--name",
      [&measures](const std::string& text) {
        if (measures.empty())
          throw Error(ExitCode::usage, "--name: found '" + text +
                                           "' before any measure, expected it behind the one that it names");
        measures.back().name = to_utf8(text);
      },
      "name of the measure before it, in tables and drawings", "TEXT");
  list.set_brief("--name", "name of the measure before it");
}

void add_unit(OptionList& list, std::optional<double>& metres) {
  list.add_value(
      "--unit", [&metres](const std::string& text) { metres = read_option("--unit", text, read_unit); },
      "unit of the file's coordinates where the file does not say: m, cm, mm, ft, us-ft or a number of "
      "metres",
      "UNIT");
}

/// Nothing when help was asked for and printed.
std::optional<Asked> parse(int argc, char** argv) {
  OptionList list(
      "Measures on the surface of a scan or scene, with the interval that holds the true value 95 times of "
      "100.",
      "splatray-measure");
  GivenFields given;
  Asked asked;
  add_fields(list, DOOR_RENDER, "SCENE", given, {FieldGroup::input, FieldGroup::region}, {"up"});
  add_measures(list, asked.measures);
  add_unit(list, asked.unit_metres);
  list.set_group("Files");
  add_path(list, "-o,--output", asked.output,
           "file to write: .geojson, .dxf or .csv; default: a table on stdout");
  list.set_brief("--output", "file to write: .geojson, .dxf or .csv");
  list.set_examples({{"splatray-measure room.e57 --distance '0,0,0>1,0,0;0,0,0>-1,0,0'",
                      "from wall to wall, along rays from the scanner"},
                     {"splatray-measure room.e57 --vertical '1,2,0;1,2,2.5' --name door",
                      "a height between two places, with a name"},
                     {"splatray-measure heap.laz --volume '0,0,0;9,0,0;9,9,0;0,9,0;corners'",
                      "a heap over the plane through its foot"},
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
  const bool has_lengths =
      std::any_of(asked->measures.begin(), asked->measures.end(),
                  [](const GivenMeasure& given) { return given.kind != MeasureKind::point; });
  const double metres = has_lengths ? require_unit_metres(loaded.scene.crs, asked->unit_metres)
                                    : asked->unit_metres.value_or(0.0);
  const std::unique_ptr<Device> device = open_device(HOST_DEVICE);
  SceneOnDevice shown(*device);
  shown.open(loaded.scene);
  const Region region = region_of(asked->request.view.region, loaded.scene.up);
  std::vector<Measure> measures;
  for (const GivenMeasure& given : asked->measures)
    measures.push_back(take_measure(loaded.scene, region, given, &shown));
  const MeasureFrame frame{loaded.scene.up, loaded.scene.crs, metres};
  if (!asked->unit_metres && !(describe_crs(frame.crs).horizontal_metres > 0.0))
    std::fputs("splatray-measure: note: the file names no unit; its coordinates are taken for metres\n",
               stderr);
  if (!asked->output.empty()) write_measures(measures, frame, asked->output);
  std::fputs(table_of(measures, frame).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-measure", run, argc, argv); }

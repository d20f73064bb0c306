#include <cmath>

#include "app/library/request/fields.h"
#include "engine/base/number_text.h"
#include "engine/base/utf8.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

constexpr FieldGroup INPUT = FieldGroup::input;

/// auto, off or a radius (BuildParams::smooth_world).
Field smooth_row() {
  constexpr double MOST = 1e12;
  return value_row(
      "smooth", INPUT, "auto|off|RADIUS",
      "noisy scans are smoothed as their noise asks for, not at all, or so far around each point (world "
      "units); "
      "default auto",
      [](Request& request, const std::string& text) {
        double& smooth_world = request.source.params.smooth_world;
        if (text == "auto" || text == "off") return void(smooth_world = text == "auto" ? -1.0 : 0.0);
        const auto radius = split_numbers(text, ',', 1);
        if (radius.empty() || !(radius[0] > 0.0 && radius[0] <= MOST))
          throw Expected{"auto, off or a number above 0, to 1e12"};
        smooth_world = radius[0];
      },
      [](const Request& request) -> std::string {
        const double smooth_world = request.source.params.smooth_world;
        return smooth_world < 0.0 ? "auto" : smooth_world == 0.0 ? "off" : number_text(smooth_world);
      });
}

Field attributes_row() {
  return value_row(
      "attributes", INPUT, "NAME,...",
      "further attributes of scans to keep: extra bytes, fields of LAS, columns",
      [](Request& request, const std::string& text) {
        request.source.scans.attributes = split_names(to_utf8(text));
      },
      [](const Request& request) {
        std::string text;
        for (const std::string& name : request.source.scans.attributes)
          text += (text.empty() ? "" : ",") + name;
        return text;
      });
}

Field inputs_row() {
  Field row = with(paths_row("inputs", INPUT, MEMBER(source.inputs),
                             "a .soct scene alone, or files or folders with points, meshes or a scene: " +
                                 format_extensions(),
                             "FILE"),
                   {.doors = DOORS_ALL});
  row.brief = "scans, meshes or a scene: files, folders, or a .soct";
  row.extensions = ".soct " + format_extensions();
  return row;
}

Field lod_row() {
  return value_row(
      "lod", INPUT, "X",
      "of files in levels (COPC, EPT) the points that lie X pixels apart in the pictures are read; 0 = all; "
      "default "
      "1",
      [](Request& request, const std::string& text) {
        request.source.lod = read_number(text, 0.0, 1e6, false);
      },
      [](const Request& request) { return request.source.lod ? number_text(*request.source.lod) : ""; });
}

/// A number of bytes, with a letter for powers of 1024.
Field max_memory_row() {
  constexpr double MOST = 1e9, KIB = 1024.0;
  return value_row(
      "max-memory", INPUT, "SIZE",
      "memory that the points of files in levels may take, such as 4G; default 60 % of what there is",
      [](Request& request, const std::string& text) {
        const std::size_t letter = std::string("KMG").find(text.empty() ? ' ' : text.back());
        const auto number = split_numbers(text.substr(0, text.empty() ? 0 : text.size() - 1), ',', 1);
        if (letter == std::string::npos || number.empty() || !(number[0] > 0.0 && number[0] <= MOST))
          throw Expected{"a number with K, M or G, such as 4G"};
        const double bytes = number[0] * std::pow(KIB, 1.0 + static_cast<double>(letter));
        request.source.memory_bytes = static_cast<std::uint64_t>(bytes);
      },
      [](const Request& request) {
        const std::uint64_t bytes = request.source.memory_bytes;
        return bytes == 0 ? "" : number_text(static_cast<double>(bytes) / KIB) + "K";
      });
}

}  // namespace

std::vector<Field> input_fields() {
  constexpr double MOST_WHOLE = 9007199254740992.0;  // 2^53: whole numbers are exact up to here
  std::vector<Field> rows = {
      inputs_row(),
      paths_row("data-path", INPUT, MEMBER(source.data_paths),
                "folder searched for models a scene names; repeatable; then the variable SPLATRAY_DATA_DIR",
                "FOLDER"),
      needed(number_row("mesh-points", INPUT, MEMBER(source.params.samples), 0, MOST_WHOLE,
                        "points sampled on meshes by area; default 0 = their vertices where fine enough"),
             "points sampled on meshes"),
      number_row("radius-scale", INPUT, MEMBER(source.params.radius_scale), 1e-6, 1e6,
                 "factor on every radius; default 1"),
      number_row(
          "crease", INPUT, MEMBER(source.params.crease_degrees), 0, 180,
          "degrees by which a surface turns at a crease, where a mesh is not shaded smoothly; default 30"),
      switch_row("strict", INPUT, MEMBER(source.scans.strict), "refuse a scan that holds less than it says"),
      needed(vector_row("sensor", INPUT, MEMBER(source.scans.sensor_world),
                        "where the scanner stood, for points whose file does not say; decides the sides of "
                        "their normals"),
             "where the scanner stood, if the file does not say"),
      path_row("trajectory", INPUT, MEMBER(source.scans.trajectory),
               "text of times and places (time, x, y, z) where the scanner moved, for points with times"),
      number_row("z-scale", INPUT, MEMBER(source.scans.z_scale), 1e-6, 1e6,
                 "factor on the heights of points; default 1"),
      switch_row("ignore-checksums", INPUT, MEMBER(source.scans.ignore_checksums),
                 "read an E57 with damaged pages"),
      switch_row("keep-withheld", INPUT, MEMBER(source.scans.keep_withheld),
                 "keep points that are marked as deleted or as noise (classes 7 and 18)"),
      needed(text_row("columns", INPUT, MEMBER(source.scans.columns),
                      "columns of text files, such as x,y,z,intensity,-,r,g,b; - is skipped; default by "
                      "header or values",
                      "NAME,..."),
             "columns of text files, such as x,y,z,-,r,g,b"),
      attributes_row(),
      switch_row("keep-strays", INPUT, MEMBER(source.params.keep_strays),
                 "keep the points of scans that lie on no surface, but for those far from all others"),
      smooth_row(),
      switch_row(
          "ground", INPUT, MEMBER(source.params.ground),
          "add a grey ground for shadows below the scene's lowest point, across the format's up axis or "
          "that of --up; the camera is placed as without it"),
      number_row("threads", INPUT, MEMBER(source.threads), 0, 4096,
                 "threads of reading, preprocess and the device cpu; default 0 = all cores")};
  for (Field& row : rows) {
    row.doors |= DOOR_PREPROCESS;
    row.traits |= OF_SCENES;
  }
  rows.front().traits = 0;  // what is opened, not how
  rows.back().traits |= NOT_OF_LIGHT;
  for (Field row : {lod_row(), max_memory_row()}) {  // of pictures alone
    row.traits |= OF_SCENES | NOT_OF_LIGHT;
    rows.push_back(row);
  }
  rows[2].old_names = {"points", "samples"};
  return rows;
}

}  // namespace splatray

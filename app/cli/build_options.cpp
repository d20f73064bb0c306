#include "app/cli/build_options.h"

#include <algorithm>
#include <cstdlib>

#include "app/cli/option_types.h"

namespace splatray {
namespace {

/// auto, off or a radius (BuildParams::smooth_world).
void add_smoothing(OptionList& list, double& smooth_world) {
  constexpr double MOST = 1e12;
  const auto read = [&smooth_world](const std::string& text) {
    if (text == "auto") {
      smooth_world = -1.0;
    } else if (text == "off") {
      smooth_world = 0.0;
    } else {
      const auto radius = split_numbers(text, ',', 1);
      if (radius.empty() || !(radius[0] > 0.0 && radius[0] <= MOST))
        refuse_option("--smooth", text, "auto, off or a number above 0, to 1e12");
      smooth_world = radius[0];
    }
  };
  const auto write = [&smooth_world]() -> std::string {
    return smooth_world < 0.0 ? "auto" : smooth_world == 0.0 ? "off" : number_text(smooth_world);
  };
  list.add_value("--smooth", read, write,
                 "noisy scans are smoothed as their noise asks for, not at all, or so far around each point "
                 "(world units); default auto",
                 "auto|off|RADIUS");
}

void add_scan_options(OptionList& list, ScanOptions& scans) {
  list.add_switch("--strict", scans.strict, "refuse a scan that holds less than it says");
  add_vector(list, "--sensor", scans.sensor_world,
             "where the scanner stood, for points whose file does not say; tells the sides of their normals");
  add_path(list, "--trajectory", scans.trajectory,
           "text of times and places (time, x, y, z) where the scanner moved, for points with times");
  add_number(list, "--z-scale", scans.z_scale, 1e-6, 1e6, "factor on the heights of points; default 1");
  list.add_switch("--ignore-checksums", scans.ignore_checksums, "read an E57 with damaged pages");
  list.add_switch("--keep-withheld", scans.keep_withheld,
                  "keep points that are marked as deleted or as noise (classes 7 and 18)");
  add_text(
      list, "--columns", scans.columns,
      "columns of text files, such as x,y,z,intensity,-,r,g,b; - is skipped; default by header or values",
      "NAME,...");
  const auto read = [&scans](const std::string& text) {
    scans.attributes.clear();
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      if (end == begin) refuse_option("--attributes", text, "names with a comma between");
      scans.attributes.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  };
  const auto write = [&scans] {
    std::string text;
    for (const std::string& name : scans.attributes) text += (text.empty() ? "" : ",") + name;
    return text;
  };
  list.add_value("--attributes", read, write, "further attributes of scans to keep: extra bytes, columns",
                 "NAME,...");
}

}  // namespace

void add_build_options(OptionList& list, BuildOptions& options, const std::string& samples_name) {
  constexpr double MOST_WHOLE = 9007199254740992.0;  // 2^53: whole numbers are exact up to here
  BuildParams& params = options.params;
  list.add_paths("--data-path", options.data_paths,
                 "folder searched for models a scene names; repeatable; then the variable SPLATRAY_DATA_DIR",
                 "FOLDER");
  list.add_words([&options] {
    Words words;
    for (const std::filesystem::path& folder : options.data_paths)
      words.push_back("--data-path=" + folder.string());
    return words;
  });
  add_number(list, samples_name, params.samples, 0, MOST_WHOLE,
             "points sampled on meshes by area; default 0 = their vertices where fine enough");
  add_number(list, "--leaf-size", params.leaf_size, 0, 65536,
             "octree cells of more splat centres are divided; default 0 = 16, or 24 or 8 where "
             "that would take more than 64 bytes of GPU memory a splat");
  add_choice<Insertion>(
      list, "--insertion", params.insertion,
      {{"overlap", Insertion::overlap}, {"probe", Insertion::probe}, {"centre", Insertion::centre}},
      "leaves a splat goes into; default overlap");
  add_number(list, "--probes", params.probes, 1, 65536,
             "probe rays per leaf for --insertion probe; default 32");
  add_choice<RadiusRule>(list, "--radius-rule", params.radius_rule,
                         {{"coverage", RadiusRule::coverage}, {"knn", RadiusRule::knn}},
                         "radii of points that have none; default coverage");
  add_number(list, "--radius-scale", params.radius_scale, 1e-6, 1e6, "factor on every radius; default 1");
  add_choice<bool>(list, "--normal-fields", params.normal_fields, {{"on", true}, {"off", false}},
                   "how normals change across each disc, where the scene curves; default on");
  add_choice<bool>(list, "--clip", params.clip, {{"on", true}, {"off", false}},
                   "discs end at borders and creases, of points alone where those are clear; default on");
  add_number(list, "--crease", params.crease_degrees, 0, 180,
             "degrees by which a surface turns at a crease, where a mesh is not shaded smoothly; default 30");
  add_scan_options(list, options.scans);
  list.add_switch("--keep-strays", params.keep_strays,
                  "keep the points of scans that lie on no surface, but for those far from all others");
  add_smoothing(list, params.smooth_world);
  add_number(list, "--threads", options.threads, 0, 4096,
             "threads of reading, preprocess and the device cpu; default 0 = all cores");
}

std::vector<std::filesystem::path> model_folders(const BuildOptions& options) {
  std::vector<std::filesystem::path> folders = options.data_paths;
  if (const char* folder = std::getenv("SPLATRAY_DATA_DIR")) folders.emplace_back(folder);
  return folders;
}

ReadOptions read_options(const BuildOptions& options, const Progress& progress) {
  ReadOptions reading;
  reading.samples = options.params.samples;
  reading.seed = options.params.seed;
  reading.data_paths = model_folders(options);
  reading.threads = options.threads;
  reading.clip = options.params.clip;
  reading.crease_degrees = options.params.crease_degrees;
  reading.scans = options.scans;
  reading.progress = progress;
  return reading;
}

}  // namespace splatray

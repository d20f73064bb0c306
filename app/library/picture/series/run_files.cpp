#include "app/library/picture/series/run_files.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/make.h"
#include "app/library/sheet/sheet_files.h"
#include "app/library/shot/environment.h"
#include "engine/base/error.h"
#include "engine/file/file_roles.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// Whether samples are added to a picture in its place: the one exception.
bool resumes_in_place(const Request::Output& output) {
  std::error_code error;
  return fs::equivalent(output.resume, output.path, error) ||
         fs::equivalent(output.resume, unfinished_file(output.path), error);
}

void claim_if_named(const fs::path& file) {
  if (!file.empty()) claim_output(file);
}

/// A picture and what lies beside it.
void claim_picture(const Request& request, const fs::path& file) {
  claim_output(file);
  if (!request.view.sheet) return;
  const SheetPlaces places = sheet_places(file);
  for (const fs::path& beside : {places.description, places.world_file, places.crs, places.crs_of_gdal})
    claim_if_named(beside);
}

/// What the request reads, but for --resume; empty ones are none.
std::vector<fs::path> read_files(const Request& request) {
  std::vector<fs::path> files = request.source.inputs;
  const Request::Output& output = request.output;
  files.insert(files.end(),
               {request.source.scans.trajectory, output.camera_path, output.measures, output.reference});
  const std::string& environment = request.look.environment;
  if (!built_in_environment(environment)) files.emplace_back(environment);
  return files;
}

}  // namespace

void note_inputs(const Request& request) {
  for (const fs::path& file : read_files(request)) note_input(file);
  if (!resumes_in_place(request.output)) note_input(request.output.resume);
}

void require_inputs_present(const Request& request) {
  std::vector<fs::path> files = read_files(request);
  files.push_back(request.output.resume);
  for (const fs::path& file : files) {
    std::error_code error;
    if (!file.empty() && !fs::exists(file, error))
      throw Error(ExitCode::input_unreadable, file.string() + ": no such file");
  }
}

void claim_outputs(const Request& request, const std::vector<SequenceFrame>& frames) {
  const Request::Output& output = request.output;
  for (const SequenceFrame& frame : frames) claim_picture(request, frame.output);
  const bool has_sums = lower_extension(output.path) == ".exr";
  if (!output.many() && output.orbit_columns == 0 && !has_sums)
    claim_picture(request, unfinished_file(output.path));
  if (!output.reference.empty()) claim_output(difference_file(output.path));
  claim_if_named(output.height_raster);
  claim_if_named(output.stats_json);
}

}  // namespace splatray

#include "app/library/picture/series/run_files.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/film.h"
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

/// A picture and what lies beside it; empty ones are none.
void add_picture(const Request& request, const fs::path& file, std::vector<fs::path>& files) {
  files.push_back(file);
  if (!request.view.sheet) return;
  const SheetPlaces places = sheet_places(file);
  files.insert(files.end(), {places.description, places.world_file, places.crs, places.crs_of_gdal});
}

/// All that a run may write; empty ones are none.
std::vector<fs::path> written_files(const Request& request, const std::vector<SequenceFrame>& frames) {
  const Request::Output& output = request.output;
  std::vector<fs::path> files{output.film, output.height_raster, output.stats_json};
  for (const SequenceFrame& frame : frames) add_picture(request, frame.output, files);
  const bool has_sums = lower_extension(output.path) == ".exr";
  if (!output.many() && output.orbit_columns == 0 && !has_sums)
    add_picture(request, unfinished_file(output.path), files);
  if (!output.reference.empty()) files.push_back(difference_file(output.path));
  return files;
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
    if (!file.empty() && !is_url(file) && !fs::exists(file, error))
      throw Error(ExitCode::input_unreadable, file.string() + ": no such file");
  }
}

void claim_outputs(const Request& request, const std::vector<SequenceFrame>& frames) {
  require_film_maker(request.output);
  for (const fs::path& file : written_files(request, frames))
    if (!file.empty()) claim_output(file);
}

void require_no_inputs_replaced(const Request& request, const std::vector<SequenceFrame>& frames) {
  for (const fs::path& file : written_files(request, frames)) require_no_input(file);
}

}  // namespace splatray

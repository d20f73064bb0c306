#include "app/library/picture/series/run_files.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/render_sequence.h"
#include "app/library/sheet/sheet_files.h"
#include "engine/file/file_roles.h"

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

}  // namespace

void note_inputs(const Request& request) {
  const Request::Output& output = request.output;
  for (const fs::path& input : request.source.inputs) note_input(input);
  for (const fs::path& input : {request.source.scans.trajectory, fs::path(request.look.environment),
                                output.camera_path, output.measures, output.reference})
    note_input(input);
  if (!resumes_in_place(output)) note_input(output.resume);
}

void claim_outputs(const Request& request, const Sequence& sequence) {
  const Request::Output& output = request.output;
  for (const SequenceFrame& frame : sequence.frames) claim_picture(request, frame.output);
  if (!output.many() && is_png(output.path)) claim_picture(request, unfinished_file(output.path));
  if (!output.reference.empty()) claim_output(difference_file(output.path));
  claim_if_named(output.height_raster);
  claim_if_named(output.stats_json);
}

}  // namespace splatray

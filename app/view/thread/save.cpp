#include "app/view/thread/save.h"

#include "app/cli/picture.h"
#include "app/cli/sequence.h"
#include "app/view/model/document_options.h"

namespace splatray {

SaveJob save_job(const Document& document, const SaveRequest& request) {
  SaveJob job{document, render_options(document, request.width, request.height)};
  job.options.output = request.path;
  job.options.aov_depth = request.aov_depth;
  job.options.aov_normal = request.aov_normal;
  job.options.aov_id = request.aov_id;
  job.options.picture.settings.samples = request.samples;
  job.options.picture.settings.aov = request.aov_depth || request.aov_normal || request.aov_id;
  return job;
}

SaveJob save_job(const Document& document, const RecordRequest& request) {
  SaveJob job{document, render_options(document, request.width, request.height)};
  job.options.output = request.path;
  job.options.picture.settings.samples = request.samples;
  if (request.turntable)
    job.options.sequence.turntable = request.frames;
  else
    job.options.sequence.camera_path = request.camera_path;
  job.options.sequence.skip_existing = request.skip_existing;
  return job;
}

std::string save_pictures(const SaveJob& job, LiveScene& live, const Context& context,
                          const SaveProgress& progress) {
  const RenderOptions& options = job.options;
  const PictureOptions& picture = options.picture;
  const Sequence sequence = plan_sequence(options);
  require_outputs_writable(options);
  live.match(job.document, ViewMode::shaded);
  double done = 0.0;
  for (const SequenceFrame& frame : sequence.frames) {
    const Camera camera = frame_camera(sequence, frame.number, job.document.camera, job.document.up);
    const View view{camera, picture.width, picture.height};
    const std::string stage = "saving " + frame.output.filename().string();
    const Image image = live.tracer().render(view, picture.settings, [&](double share) {
      return progress({stage, (done + share) / static_cast<double>(sequence.frames.size())});
    });
    write_output(options, image, picture_metadata(options, live.scene(), view, context), frame.output);
    done += 1.0;
  }
  if (!options.sequence.many()) return "saved '" + options.output.string() + "'";
  return "saved " + std::to_string(sequence.frames.size()) + " pictures as '" + options.output.string() + "'";
}

}  // namespace splatray

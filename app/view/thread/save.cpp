#include "app/view/thread/save.h"

#include "app/cli/picture.h"
#include "app/cli/render_sequence.h"
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
  const Sequence sequence = plan_sequence(options);
  require_outputs_writable(options);
  live.match(job.document, ViewMode::shaded);
  live.forget_lights();
  const auto pictures = static_cast<double>(sequence.frames.size());
  const SequenceListener listener{[&](const SequenceFrame& frame, std::size_t before, double share) {
                                    return progress({"saving " + frame.output.filename().string(),
                                                     (static_cast<double>(before) + share) / pictures});
                                  },
                                  [](const std::string&) {}, [](const FailedPicture&) {}};
  const SequenceRecord record =
      render_sequence(options, sequence, live.scene(), job.document.camera, context, live.tracer(), listener);
  require_all_made(record);
  const std::string saved = "saved '" + options.output.string() + "'";
  if (!options.sequence.many()) return saved;
  const std::string all = std::to_string(sequence.frames.size()) + " pictures";
  if (record.skipped == 0) return saved + ": " + all;
  return saved + ": " + std::to_string(record.made.size()) + " of " + all + ", the others were there";
}

}  // namespace splatray

#include "app/view/thread/save.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/render_sequence.h"
#include "app/view/model/document_request.h"

namespace splatray {

SaveJob save_job(const Document& document, const Request& asked) {
  SaveJob job{document, request_of(document, asked.view.width, asked.view.height)};
  job.request.output = asked.output;
  job.request.view.crop = asked.view.crop;
  job.request.view.tile = asked.view.tile;
  job.request.view.tiles = asked.view.tiles;
  Request::Settings& settings = job.request.settings;
  settings.samples = asked.settings.samples;
  settings.sample_offset = asked.settings.sample_offset;
  settings.error_goal = asked.settings.error_goal;
  settings.seconds_goal = asked.settings.seconds_goal;
  settings.aov = asked.settings.aov;
  settings.estimate_error = asked.settings.estimate_error;
  return job;
}

std::string save_pictures(const SaveJob& job, LiveScene& live, const SaveProgress& progress) {
  const Request& request = job.request;
  require_consistent(request);
  const Sequence sequence = plan_sequence(request);
  require_outputs_writable(request);
  live.match(job.document, ViewMode::shaded);
  const auto pictures = static_cast<double>(sequence.frames.size());
  const SequenceListener listener{[&](const SequenceFrame& frame, std::size_t before, double share) {
                                    return progress({"saving " + frame.output.filename().string(),
                                                     (static_cast<double>(before) + share) / pictures});
                                  },
                                  [](const std::string&) {}, [](const FailedPicture&) {}};
  const SequenceRecord record =
      render_sequence(request, sequence, live.shown(), job.document.camera, listener);
  require_all_made(record);
  const std::string saved = "saved '" + request.output.path.string() + "'";
  if (!request.output.many()) return saved;
  const std::string all = std::to_string(sequence.frames.size()) + " pictures";
  if (record.skipped == 0) return saved + ": " + all;
  return saved + ": " + std::to_string(record.made.size()) + " of " + all + ", the others were there";
}

}  // namespace splatray

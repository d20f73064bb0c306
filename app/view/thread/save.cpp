#include "app/view/thread/save.h"

#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/make.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/view/model/document_request.h"

namespace splatray {

SaveJob save_job(const Document& document, const Request& asked) {
  return {document, saved_request(document, asked)};
}

std::string save_pictures(const SaveJob& job, LiveScene& live, const SaveProgress& progress) {
  const Document& document = job.document;
  SceneFacts facts = document.loaded->facts;
  live.match(document, ViewMode::shaded);
  facts.legend = live.legend();
  Shot shot = resolve(job.request, live.scene(), facts);
  require_no_inputs_replaced(shot.request, shot.frames);
  require_outputs_writable(shot.request);
  require_picture_memory(shot);
  expose(shot, live.shown());
  const auto pictures = static_cast<double>(shot.frames.size());
  const SequenceListener listener{[&](const SequenceFrame& frame, std::size_t before, double share) {
                                    return progress({"saving " + frame.output.filename().string(),
                                                     (static_cast<double>(before) + share) / pictures});
                                  },
                                  [](const std::string&) {}, [](const FailedPicture&) {}};
  const SequenceRecord record = make(shot, live.shown(), listener);
  require_all_made(record);
  const std::string saved = "saved '" + shot.request.output.path.string() + "'";
  if (!shot.is_sequence()) return saved;
  const std::string all = std::to_string(shot.frames.size()) + " pictures";
  if (record.skipped == 0) return saved + ": " + all;
  return saved + ": " + std::to_string(record.made.size()) + " of " + all + ", the others were there";
}

}  // namespace splatray

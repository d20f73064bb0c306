#include "app/view/model/history.h"

namespace splatray {
namespace {

/// But for the camera.
bool same(const Document& a, const Document& b) {
  return a.request == b.request && a.mode == b.mode && a.measures == b.measures &&
         same_bytes(a.materials, b.materials);
}

}  // namespace

void History::start(const Document& document) {
  steps_ = {document};
  now_ = 0;
}

void History::see(const Document& document, bool goes_on) {
  if (steps_.empty() || goes_on || same(document, steps_[now_])) return;
  steps_.resize(now_ + 1);
  steps_.push_back(document);
  if (steps_.size() > MOST) steps_.erase(steps_.begin());
  now_ = steps_.size() - 1;
}

bool History::undo(Document& document) { return now_ > 0 && go(now_ - 1, document); }

bool History::redo(Document& document) { return now_ + 1 < steps_.size() && go(now_ + 1, document); }

bool History::go(std::size_t to, Document& document) {
  now_ = to;
  const Camera camera = document.camera;
  document = steps_[now_];
  document.camera = camera;
  return true;
}

}  // namespace splatray

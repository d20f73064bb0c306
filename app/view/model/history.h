/// What a person did to the document, to be undone.
#pragma once
#include <vector>

#include "app/view/model/document.h"

namespace splatray {

/// Documents of one scene, each differing from the one before by more than its camera.
class History {
 public:
  static constexpr std::size_t MOST = 100;

  /// Forgets all: another scene is shown.
  void start(const Document& document);
  /// Hears of the document as it is now. While a change goes on, as during a drag, it is not yet a step.
  void see(const Document& document, bool goes_on);
  /// The step before or after; the camera stays. Returns whether there was one.
  bool undo(Document& document);
  bool redo(Document& document);

 private:
  bool go(std::size_t to, Document& document);

  std::vector<Document> steps_;
  std::size_t now_ = 0;
};

}  // namespace splatray

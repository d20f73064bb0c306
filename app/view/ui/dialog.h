/// A dialog in the middle of the window.
#pragma once
#include <string>

namespace splatray {

/// For as long as it is open; its fields go between construction and destruction when it is true.
class Dialog {
 public:
  Dialog(const char* title, bool& open);
  ~Dialog();
  Dialog(const Dialog&) = delete;
  Dialog& operator=(const Dialog&) = delete;

  explicit operator bool() const { return shown_; }

  /// The last row: returns whether the work is to be done, for which Enter stands too; `refusal`: why it cannot be.
  [[nodiscard]] bool done_or_cancelled(const char* verb, const std::string& refusal);

 private:
  bool& open_;
  bool shown_ = false;
};

}  // namespace splatray

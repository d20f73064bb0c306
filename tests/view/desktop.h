/// A display without a screen, and what a person with a desktop does to a window on it.
#pragma once
#include <sys/types.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// An X server of its own (Xvfb) for as long as the object lives.
class Desktop {
 public:
  /// All members throw std::runtime_error, which ends the test as failed, where Xvfb or xdotool (Debian's packages of
  /// these names) does not run.
  Desktop();
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// DISPLAY's value.
  [[nodiscard]] const std::string& display() const { return display_; }
  /// The window whose title holds `title`, as soon as there is one; 0 after `seconds` without.
  [[nodiscard]] unsigned long wait_for_window(const std::string& title, double seconds = 60.0) const;
  /// Runs xdotool with these words.
  void xdotool(const std::vector<std::string>& words) const;
  /// Drops a file on a window, as a file manager does: the XDND protocol, version 5.
  void drop(unsigned long window, const std::string& file) const;
  /// The pixels that a window shows now, row by row.
  [[nodiscard]] std::vector<std::uint32_t> pixels(unsigned long window) const;
  /// Width and height of a window.
  [[nodiscard]] std::array<int, 2> size(unsigned long window) const;
  /// Sets what programs that start from now on are told of the display, such as "Xft.dpi: 192", as xrdb does.
  void set_resources(const std::string& text) const;
  /// Asks a window to close, as the button in its title bar does.
  void close(unsigned long window) const;

 private:
  pid_t server_ = 0;
  std::string display_;
};

/// A program that runs beside the test.
class Program {
 public:
  /// Starts it in `folder`, with further environment variables (NAME=VALUE); what it writes to stderr goes to `log`.
  Program(const std::vector<std::string>& command, const std::vector<std::string>& environment,
          const std::string& folder, const std::string& log);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Its exit status, 128 + signal number when a signal ended it; -1 when it does not end within `seconds`.
  [[nodiscard]] int wait(double seconds = 60.0);

 private:
  pid_t child_ = 0;
};

/// A file's bytes; empty where there is none.
[[nodiscard]] std::string content(const std::filesystem::path& path);

}  // namespace splatray

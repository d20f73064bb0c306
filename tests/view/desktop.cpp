#include "tests/view/desktop.h"

#include <gtest/gtest.h>
// After GoogleTest, whose names Xlib's macros would replace.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "tests/cli/child_process.h"

namespace splatray {
namespace {

using Clock = std::chrono::steady_clock;
using Connection = std::unique_ptr<Display, decltype(&XCloseDisplay)>;

constexpr std::chrono::milliseconds PAUSE{20};

/// Ends the test, with a failure that says why, unless `met`: without a desktop nothing else can be judged.
void require(bool met, const std::string& sentence) {
  if (!met) throw std::runtime_error(sentence);
}

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

Atom atom(const Connection& connection, const char* name) {
  return XInternAtom(connection.get(), name, False);
}

/// Sends a window a client message of 32-bit words.
void send(const Connection& connection, unsigned long window, const char* type,
          const std::vector<long>& words) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = atom(connection, type);
  event.xclient.format = 32;
  for (std::size_t i = 0; i < words.size(); ++i) event.xclient.data.l[i] = words[i];
  XSendEvent(connection.get(), window, False, NoEventMask, &event);
  XFlush(connection.get());
}

/// Gives the dropped text to the window that asks for it.
void answer(const Connection& connection, const XSelectionRequestEvent& request, const std::string& text) {
  XChangeProperty(connection.get(), request.requestor, request.property, request.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  XEvent reply{};
  reply.xselection.type = SelectionNotify;
  reply.xselection.requestor = request.requestor;
  reply.xselection.selection = request.selection;
  reply.xselection.target = request.target;
  reply.xselection.property = request.property;
  reply.xselection.time = request.time;
  XSendEvent(connection.get(), request.requestor, False, NoEventMask, &reply);
  XFlush(connection.get());
}

/// The window below `root` whose name holds `title`, or 0.
unsigned long find_window(const Connection& connection, unsigned long root, const std::string& title) {
  Window parent = 0, top = 0, *children = nullptr;
  unsigned count = 0;
  if (XQueryTree(connection.get(), root, &top, &parent, &children, &count) == 0) return 0;
  unsigned long found = 0;
  for (unsigned i = 0; i < count && found == 0; ++i) {
    char* name = nullptr;
    if (XFetchName(connection.get(), children[i], &name) != 0 && name != nullptr) {
      if (std::strstr(name, title.c_str()) != nullptr) found = children[i];
      XFree(name);
    }
  }
  if (children != nullptr) XFree(children);
  return found;
}

Connection connect(const std::string& display) {
  Connection connection(XOpenDisplay(display.c_str()), &XCloseDisplay);
  require(connection != nullptr, "no connection to the X server " + display);
  return connection;
}

}  // namespace

Desktop::Desktop() {
  int channel[2];
  require(pipe(channel) == 0, "no pipe to Xvfb");
  server_ = fork();
  if (server_ == 0) {
    const std::string number = std::to_string(channel[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1600x1000x24", "-nolisten", "tcp",
           nullptr);
    _exit(127);
  }
  ::close(channel[1]);
  char digits[16] = {};
  const ssize_t length = read(channel[0], digits, sizeof(digits) - 1);
  ::close(channel[0]);
  if (length <= 0) waitpid(server_, nullptr, 0);
  require(length > 0, "Xvfb did not start; Debian's package xvfb has it");
  display_ = ":" + std::to_string(std::atoi(digits));
}

Desktop::~Desktop() {
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

unsigned long Desktop::wait_for_window(const std::string& title, double seconds) const {
  const Connection connection = connect(display_);
  const Clock::time_point end = after(seconds);
  while (Clock::now() < end) {
    if (const unsigned long window = find_window(connection, DefaultRootWindow(connection.get()), title))
      return window;
    std::this_thread::sleep_for(PAUSE);
  }
  return 0;
}

void Desktop::xdotool(const std::vector<std::string>& words) const {
  std::vector<std::string> command = {"xdotool"};
  command.insert(command.end(), words.begin(), words.end());
  const pid_t child = fork();
  if (child == 0) {
    setenv("DISPLAY", display_.c_str(), 1);
    execvp(command[0].c_str(), pointers(command).data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  require(status == 0, "xdotool failed; Debian's package xdotool has it");
}

void Desktop::drop(unsigned long window, const std::string& file) const {
  const Connection connection = connect(display_);
  const std::string text = "file://" + file + "\r\n";
  const Window source =
      XCreateSimpleWindow(connection.get(), DefaultRootWindow(connection.get()), 0, 0, 1, 1, 0, 0, 0);
  const long list = static_cast<long>(atom(connection, "text/uri-list")), owner = static_cast<long>(source);
  XSetSelectionOwner(connection.get(), atom(connection, "XdndSelection"), source, CurrentTime);
  send(connection, window, "XdndEnter", {owner, 5L << 24, list, 0, 0});
  send(connection, window, "XdndPosition",
       {owner, 0, 100L << 16 | 100, CurrentTime, static_cast<long>(atom(connection, "XdndActionCopy"))});
  send(connection, window, "XdndDrop", {owner, 0, CurrentTime, 0, 0});
  const Clock::time_point end = after(20.0);
  while (Clock::now() < end) {
    if (XPending(connection.get()) == 0) {
      std::this_thread::sleep_for(PAUSE);
      continue;
    }
    XEvent event{};
    XNextEvent(connection.get(), &event);
    if (event.type == SelectionRequest) answer(connection, event.xselectionrequest, text);
    if (event.type == ClientMessage && event.xclient.message_type == atom(connection, "XdndFinished")) return;
  }
  ADD_FAILURE() << "the window did not take the drop";
}

std::vector<std::uint32_t> Desktop::pixels(unsigned long window) const {
  const Connection connection = connect(display_);
  // A window that is moved or resized in between has other pixels than were asked for, an error that would end the test's process.
  const auto before = XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  XImage* image = nullptr;
  for (const Clock::time_point end = after(20.0); image == nullptr && Clock::now() < end;) {
    XWindowAttributes shape{};
    require(XGetWindowAttributes(connection.get(), window, &shape) != 0, "the window is gone");
    image = XGetImage(connection.get(), window, 0, 0, static_cast<unsigned>(shape.width),
                      static_cast<unsigned>(shape.height), AllPlanes, ZPixmap);
    if (image == nullptr) std::this_thread::sleep_for(PAUSE);
  }
  XSetErrorHandler(before);
  require(image != nullptr, "the window shows nothing");
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x)
      pixels.push_back(static_cast<std::uint32_t>(XGetPixel(image, x, y)));
  XDestroyImage(image);
  return pixels;
}

std::array<int, 2> Desktop::size(unsigned long window) const {
  const Connection connection = connect(display_);
  XWindowAttributes shape{};
  require(XGetWindowAttributes(connection.get(), window, &shape) != 0, "the window is gone");
  return {shape.width, shape.height};
}

void Desktop::set_resources(const std::string& text) const {
  const Connection connection = connect(display_);
  XSetCloseDownMode(connection.get(),
                    RetainPermanent);  // else a server that nobody is connected to starts anew
  XChangeProperty(connection.get(), DefaultRootWindow(connection.get()), XA_RESOURCE_MANAGER, XA_STRING, 8,
                  PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                  static_cast<int>(text.size()));
}

void Desktop::close(unsigned long window) const {
  const Connection connection = connect(display_);
  send(connection, window, "WM_PROTOCOLS",
       {static_cast<long>(atom(connection, "WM_DELETE_WINDOW")), CurrentTime});
}

Program::Program(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                 const std::string& folder, const std::string& log) {
  child_ = fork();
  if (child_ != 0) return;
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDERR_FILENO);
  set_child_environment(environment);
  std::vector<std::string> words = command;
  if (chdir(folder.c_str()) == 0) execv(words[0].c_str(), pointers(words).data());
  _exit(127);
}

Program::~Program() {
  if (child_ <= 0) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

int Program::wait(double seconds) {
  const Clock::time_point end = after(seconds);
  int status = 0;
  while (waitpid(child_, &status, WNOHANG) == 0) {
    if (Clock::now() >= end) return -1;
    std::this_thread::sleep_for(PAUSE);
  }
  child_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace splatray

#include "tests/cli/child_process.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace splatray {
namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The child's side of a fork.
[[noreturn]] void become(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                         const Limits& limits, const std::string& out, const std::string& err) {
  const int out_file = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(out_file, STDOUT_FILENO);
  dup2(err_file, STDERR_FILENO);
  set_child_environment(environment);
  const rlimit size{limits.most_bytes, limits.most_bytes};
  if (limits.most_bytes > 0) setrlimit(RLIMIT_FSIZE, &size);
  if (limits.bound_by_permissions) prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

/// Whether a child has ended; it stays to be waited for.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child;
}

/// Whether a process has a handler for a signal, as the kernel reports it (proc(5), SigCgt).
bool catches(pid_t process, int signal) {
  std::istringstream status(read_text("/proc/" + std::to_string(process) + "/status"));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:"))
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0;
  return false;
}

}  // namespace

void set_child_environment(const std::vector<std::string>& environment) {
  // GCC 12's leak sanitizer now and then crashes at the end of programs that have loaded the picture codec ("Tracer caught signal
  // 11"): leaks are looked for in the tests' own processes.
  if (const char* options = std::getenv("ASAN_OPTIONS"))
    setenv("ASAN_OPTIONS", (std::string(options) + ":detect_leaks=0").c_str(), 1);
  for (const std::string& variable : environment) {
    const std::size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.c_str() + equals + 1, 1);
  }
}

ChildResult run_program(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                        const std::function<bool()>& interrupt_when, int signal, const Limits& limits) {
  const TempFolder own;
  const std::string out = own.path() / "out", err = own.path() / "err";
  const pid_t child = fork();
  if (child == 0) become(command, environment, limits, out, err);
  if (interrupt_when) {
    // A program that never catches the signal gets it all the same, and ends by it.
    const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!has_ended(child) && !(catches(child, signal) && interrupt_when()) &&
           std::chrono::steady_clock::now() < latest)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, signal);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(out), read_text(err)};
}

std::string CliTest::write(const std::string& name, const std::string& content) const {
  std::ofstream(folder / name, std::ios::binary) << content;
  return file(name);
}

std::vector<std::string> CliTest::names() const {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    result.push_back(entry.path().filename());
  std::sort(result.begin(), result.end());
  return result;
}

ChildResult CliTest::render(std::vector<std::string> arguments,
                            const std::vector<std::string>& environment) const {
  std::vector<std::string> command = {RENDER,         "--quiet", "--resolution=16x16", "--samples=1",
                                      "--device=cpu", "-o",      file("out.png")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command, environment);
}

ChildResult CliTest::preprocess(std::vector<std::string> arguments) const {
  std::vector<std::string> command = {PREPROCESS, "-o", file("out.soct")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

std::string ascii_ply(const std::vector<std::string>& vertices, bool normals) {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
       << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (normals) text << "property float nx\nproperty float ny\nproperty float nz\n";
  text << "end_header\n";
  for (const std::string& vertex : vertices) text << vertex << '\n';
  return text.str();
}

std::string grid_ply(bool normals, double offset, double step) {
  std::vector<std::string> vertices;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      std::ostringstream vertex;
      vertex.precision(17);
      vertex << offset + step * i << ' ' << offset << ' ' << offset + step * j << (normals ? " 0 1 0" : "");
      vertices.push_back(vertex.str());
    }
  return ascii_ply(vertices, normals);
}

std::string splat_grid_ply(double offset, double step) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
      text.replace(at, what.size(), by);
    return text;
  };
  const std::string discs = replaced(grid_ply(true, offset, step), " 0 1 0\n", " 0 1 0 0.08\n"),
                    low = std::to_string(offset - 0.5);
  const std::string lattice = "comment splatray lattice " + low + ' ' + low + ' ' + low + " 2e-6\n";
  return replaced(discs, "end_header", "property float radius\n" + lattice + "end_header");
}

}  // namespace splatray

#include "reentrance.h"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "examples.h"

namespace sr = splatray::api;

namespace {

const std::vector<sr::Double3> ORIGIN = {{500000.0, 4000000.0, 103.0}}, DOWN = {{0.0, 0.0, -1.0}};

bool hits(const sr::Scene& scene) { return sr::trace(scene, ORIGIN, DOWN).object[0] == 0; }

sr::Image picture(const sr::Scene& scene, const sr::Progress& progress = {}, std::uint32_t samples = 16) {
  return sr::render(scene, {{"resolution", "64x64"}, {"samples", samples}}, progress);
}

/// The kind of Error that a progress function gets which makes `use`, a call of the library.
template <typename Use>
std::optional<sr::ErrorKind> kind_in_progress(const sr::Scene& scene, const Use& use) {
  std::optional<sr::ErrorKind> kind;
  (void)picture(scene, [&](const char*, double) {
    try {
      use();
    } catch (const sr::Error& error) {
      kind = error.kind();
    }
    return true;
  });
  return kind;
}

/// Whether a forked child ends with `expected`, which `body` returns.
template <typename Body>
bool forked(int expected, const Body& body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == expected;
}

int kind_of_render(const sr::Scene& scene) {
  try {
    (void)picture(scene);
    return -1;
  } catch (const sr::Error& error) {
    return static_cast<int>(error.kind());
  }
}

std::string find_defect_in_progress(const sr::Scene& scene) {
  using Kind = sr::ErrorKind;
  const sr::Image expected = picture(scene);
  if (kind_in_progress(scene, [&] { (void)hits(scene); }) != Kind::usage ||
      kind_in_progress(scene, [&] { (void)picture(scene); }) != Kind::usage)
    return "a scene's own progress used it without an Error";
  const sr::Scene other = scene_of_arrays();
  bool found = false;
  const sr::Image around = picture(scene, [&](const char*, double) {
    found = hits(other) && picture(other).pixels == expected.pixels && hits(scene_of_arrays());
    return true;
  });
  if (!found || around.pixels != expected.pixels)
    return "scenes used by another's progress gave something else";
  std::optional<sr::Scene> dropped = scene_of_arrays(), own = scene_of_arrays();
  (void)picture(*dropped);
  (void)picture(scene, [&](const char*, double) {
    dropped.reset();
    return true;
  });
  if (picture(*own, [&](const char*, double) {
        own.reset();
        return true;
      }).pixels != expected.pixels)
    return "a scene that its own progress ended gave something else";
  return "";
}

/// While one thread renders, others drop scenes at once and can give up waiting.
std::string find_defect_in_threads(const sr::Scene& scene) {
  std::optional<sr::Scene> dropped = scene_of_arrays();
  const sr::Scene other = scene_of_arrays();
  (void)picture(*dropped);
  std::atomic<bool> begun = false, end = false;
  std::thread renders([&] {
    try {
      (void)picture(
          scene,
          [&](const char*, double) {
            begun = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            return !end;
          },
          65536);
    } catch (const sr::Error&) {  // as it should
    }
  });
  while (!begun) std::this_thread::yield();
  dropped.reset();
  std::string stage;
  std::optional<sr::ErrorKind> kind;
  try {
    (void)picture(other, [&](const char* name, double) {
      stage = name;
      return false;
    });
  } catch (const sr::Error& error) {
    kind = error.kind();
  }
  end = true;
  renders.join();
  return kind == sr::ErrorKind::cancelled && stage == "waiting for the device" && hits(other)
             ? ""
             : "who waits for the device could not give up: " + stage;
}

std::string find_defect_in_child(const sr::Scene& scene, const sr::Scene& on_host) {
  const auto no_device = static_cast<int>(sr::ErrorKind::no_device);
  if (!forked(no_device, [&] { return kind_of_render(scene); }))
    return "a forked child used its parent's device";
  if (!forked(no_device, [] {
        const sr::Scene own = scene_of_arrays();
        return kind_of_render(own);
      }))
    return "a forked child opened a scene, but used Vulkan";
  const sr::Image expected = picture(on_host);
  const auto same = [&] { return picture(on_host).pixels == expected.pixels ? 1 : 0; };
  if (!forked(1, same)) return "a forked child gave another picture without Vulkan";
  bool in_progress = false;
  (void)picture(on_host, [&](const char*, double) {
    in_progress = in_progress || forked(1, same);
    return true;
  });
  return in_progress && same() == 1 ? "" : "a child forked in a progress function gave another picture";
}

}  // namespace

std::string find_reentrance_defect() {
  const sr::Scene scene = scene_of_arrays();
  const sr::Scene on_host = sr::make_scene({.positions = ORIGIN}, {{"device", "cpu"}});
  for (std::string defect :
       {find_defect_in_progress(scene), find_defect_in_threads(scene), find_defect_in_child(scene, on_host)})
    if (!defect.empty()) return defect;
  return "";
}

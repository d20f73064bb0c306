// The targets that read small files of text: cameras, the viewer's state, a picture's command.
#include <cmath>

#include "app/library/camera_file.h"
#include "app/library/request/command_line.h"
#include "app/view/model/user_files.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets.h"

namespace splatray::testing {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_camera(const Camera& camera) {
  require(is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up),
          "a camera's places are finite");
  require(camera.fov_y_deg > 0.0 || camera.ortho_height > 0.0, "a camera sees something");
}

}  // namespace

void fuzz_camera(FuzzBytes bytes) {
  static const MemoryFolder folder;
  const std::filesystem::path path = folder.write("fuzzed.json", bytes);
  read_or_refuse([&] { check_camera(read_camera(path)); });
  read_or_refuse([&] {
    const CameraPath keys = read_camera_path(path);
    require(!keys.empty(), "a path has keys");
    for (std::size_t i = 0; i < keys.size(); ++i) {
      check_camera(keys[i].camera);
      require(i == 0 || keys[i].frame > keys[i - 1].frame, "frames ascend");
    }
  });
}

void fuzz_user_state(FuzzBytes bytes) {
  static const MemoryFolder folder;
  const UserState state = read_user_state(folder.write("view.json", bytes));
  require(!state.window_size || (state.window_size->x > 0 && state.window_size->y > 0),
          "a window has a size");
  require(state.recent_files.size() <= RECENT_COUNT, "few recent files");
}

void fuzz_command_line(FuzzBytes bytes) {
  const std::string text(bytes.begin(), bytes.end());
  try {
    const Request request = parse_command_line(text);
    const std::string again = command_line(request);
    require(command_line(parse_command_line(again)) == again, "a command is read as it was written");
  } catch (const Error& error) {
    // --camera and --from read a file.
    require(error.code() == ExitCode::usage || error.code() == ExitCode::input_unreadable,
            "a command that is none is a mistake of usage");
    require(std::string(error.what()).find('\n') == std::string::npos, "an error is one line");
  }
}

}  // namespace splatray::testing

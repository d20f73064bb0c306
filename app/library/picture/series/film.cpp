#include "app/library/picture/series/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/one_line.h"

extern char** environ;

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// The program, where PATH has it; else empty.
fs::path film_maker() {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(list, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

/// A program that reads pictures from a socket, in which a write to one that ended is an error and no signal.
class FilmMaker {
 public:
  FilmMaker(const fs::path& film, const fs::path& said) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw Error(ExitCode::failed, film.string() + ": no socket for ffmpeg could be made");
    input_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    const fs::path program = film_maker();
    // Players take films of an even size; what comes in is sRGB, whose primaries are those of BT.709.
    std::vector<std::string> words = {
        program.string(),
        "-loglevel",
        "error",
        "-y",
        "-f",
        "image2pipe",
        "-framerate",
        "25",
        "-c:v",
        "png",
        "-i",
        "-",
        "-vf",
        "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
        "-c:v",
        "libx264",
        "-crf",
        "17",
        "-pix_fmt",
        "yuv420p",
        "-colorspace",
        "bt709",
        "-color_primaries",
        "bt709",
        "-color_trc",
        "iec61966-2-1",
        "-movflags",
        "+faststart",
        "-f",
        "mp4",
        "file:" + film.string()};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int fault = program.empty() ? ENOENT
                                      : posix_spawn(&process_, program.c_str(), &actions, nullptr,
                                                    arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (fault != 0) process_ = -1;
  }
  FilmMaker(const FilmMaker&) = delete;
  FilmMaker& operator=(const FilmMaker&) = delete;
  ~FilmMaker() { static_cast<void>(end()); }

  /// Whether it took all.
  bool add(const std::string& picture) {
    for (std::size_t done = 0; done < picture.size();) {
      const ssize_t sent = send(input_, picture.data() + done, picture.size() - done, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      done += static_cast<std::size_t>(sent);
    }
    return true;
  }

  /// Waits until the film is written; whether it is.
  bool end() {
    if (input_ >= 0) close(std::exchange(input_, -1));
    int status = 1;
    if (process_ > 0) waitpid(std::exchange(process_, -1), &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  int input_ = -1;
  pid_t process_ = -1;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

void require_film_maker(const Request::Output& output) {
  if (!output.film.empty() && film_maker().empty())
    throw Error(ExitCode::usage, "found output '" + output.film.string() +
                                     "' and no ffmpeg, expected Debian's package ffmpeg, or pictures such as "
                                     "out.####.png");
}

FilmFolder::FilmFolder(const Request::Output& output) {
  if (output.film.empty()) return;
  require_film_maker(output);
  folder_ = output.path.parent_path();
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw Error(ExitCode::failed, folder_.string() + ": " + error.message());
}

FilmFolder::~FilmFolder() {
  std::error_code error;
  if (!folder_.empty()) fs::remove(folder_, error);  // an empty one alone
}

void write_film(const Request::Output& output, const std::vector<SequenceFrame>& frames) {
  fs::path partial = output.film, said = output.film;
  partial += ".partial";
  said += ".said.partial";
  FilmMaker maker(partial, said);
  bool is_whole = true;
  for (const SequenceFrame& frame : frames) is_whole = is_whole && maker.add(bytes_of(frame.output));
  is_whole = maker.end() && is_whole;
  const std::string complaint = one_line(bytes_of(said));
  std::error_code error;
  fs::remove(said, error);
  if (is_whole) fs::rename(partial, output.film, error);
  if (!is_whole || error) {
    fs::remove(partial, error);
    throw Error(ExitCode::failed, output.film.string() + ": ffmpeg failed (" + complaint +
                                      "); the pictures are '" + output.path.string() + "'");
  }
  for (const SequenceFrame& frame : frames) fs::remove(frame.output, error);
}

}  // namespace splatray

#include "app/library/picture/reproduce.h"

#include <algorithm>

#include "app/library/image_file.h"
#include "app/library/request/command_line.h"
#include "app/library/shot/environment.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// Only what decides how a picture looks: a picture from elsewhere must not name files to write.
Request looks_only(const Request& request) {
  Request looks{request.source, request.look, request.view, request.settings, {}};
  const Request::Output& from = request.output;
  Request::Output& output = looks.output;
  output.denoise = from.denoise;
  output.despeckle = from.despeckle;
  output.aovs = from.aovs;
  return looks;
}

/// Where a path kept in a picture leads now; itself when nothing is found.
fs::path find_beside(const fs::path& path, const fs::path& picture) {
  std::error_code error;
  if (path.is_absolute() || fs::exists(path, error)) return path;
  const fs::path home = fs::absolute(picture, error).parent_path();
  fs::path folder = picture.parent_path();
  for (auto depth = std::distance(home.begin(), home.end()); depth > 0; --depth) {
    if (fs::exists(folder / path, error)) return folder / path;
    folder /= "..";
  }
  return path;
}

}  // namespace

Request still_request(const Shot& shot, const Camera& camera) {
  Request still = looks_only(shot.request);
  if (shot.sheet() == nullptr) set_camera(still.view, camera);
  return still;
}

Request plain_request(Request request) {
  const auto plain = [](const fs::path& file) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? file : found;
  };
  for (fs::path& input : request.source.inputs) input = plain(input);
  for (fs::path& folder : request.source.data_paths) folder = plain(folder);
  std::string& environment = request.look.environment;
  if (!environment.empty() && !built_in_environment(environment)) environment = plain(environment).string();
  return request;
}

std::string kept_choices(const fs::path& picture) {
  for (const auto& [name, value] : read_metadata(picture))
    if (name == "choices") return value;
  return "";
}

Request read_picture_request(const fs::path& picture) {
  const auto refuse = [&](const std::string& found) {
    throw Error(ExitCode::input_unreadable, "cannot read a request from picture '" + picture.string() +
                                                "': " + found + ", expected a picture of splatray-render");
  };
  const Metadata metadata = read_metadata(picture);
  const auto kept = [&metadata](const std::string& name) {
    return std::find_if(metadata.begin(), metadata.end(),
                        [&](const auto& entry) { return entry.first == name; });
  };
  const auto line = kept("command_line");
  if (line == metadata.end()) refuse("found no splatray.command_line in it");
  Request request;
  try {
    request = looks_only(parse_command_line(line->second));
  } catch (const Error& error) {
    refuse(error.what());
  }
  // Before pictures kept what was chosen, noise was taken out of those alone that say so.
  if (kept("choices") == metadata.end() && !request.output.despeckle)
    request.output.denoise = request.output.denoise.value_or(false);
  for (fs::path& input : request.source.inputs) input = find_beside(input, picture);
  for (fs::path& folder : request.source.data_paths) folder = find_beside(folder, picture);
  std::string& environment = request.look.environment;
  if (!environment.empty() && !built_in_environment(environment))
    environment = find_beside(environment, picture).string();
  return request;
}

}  // namespace splatray

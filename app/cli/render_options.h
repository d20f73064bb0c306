/// The command line of splatray-render.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/request/request.h"

namespace splatray {

/// A request of a command line, and sentences for whoever wrote it.
struct GivenRequest {
  Request request;
  std::vector<std::string> notes;
};

/// The request of splatray-render, output included; that of --from's picture or --request's file where nothing else is given. Nothing
/// when help or version was asked for and printed, or the request was saved. Throws Error (usage), one sentence, and what reading a
/// picture or file throws.
[[nodiscard]] std::optional<GivenRequest> parse_render_options(int argc, char** argv);

}  // namespace splatray

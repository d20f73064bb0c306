/// Requests as JSON: an object of the fields that differ from the defaults, by name. Numbers are numbers, switches true or false, all
/// else is the text of a command line; a repeated field has an array of such texts, the lights one array for all kinds:
///   {"inputs": ["scan.laz"], "samples": 64, "denoise": true, "lights": ["sun=0,-1,1", "light=0,0,3,9,9,9"]}
/// What has parts may be an array of them, a repeated field one value without an array: {"inputs": "scan.laz", "resolution": [640, 480],
/// "sun": [0, -1, 1]}. A name that an object has twice is refused.
#pragma once
#include <filesystem>
#include <string>

#include "app/library/request/request.h"

namespace splatray {

/// The text; `indent` < 0: in one line. read_request_text makes an equal request of it. Throws Error (usage) where a text of the request
/// is no UTF-8, which files may be named in.
[[nodiscard]] std::string request_json(const Request& request, int indent = 2);

/// The request of a text that `source` names in sentences. Throws Error (input_unreadable), one sentence.
[[nodiscard]] Request read_request_text(const std::string& text, const std::string& source);
/// The request of a file. Throws Error (input_unreadable), one sentence.
[[nodiscard]] Request read_request(const std::filesystem::path& path);

}  // namespace splatray

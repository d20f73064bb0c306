/// Requests as the text of a splatray-render command, for a shell, a clipboard and a picture's metadata.
#pragma once
#include <string>
#include <vector>

#include "app/library/request/request.h"

namespace splatray {

/// A splatray-render command with what differs from the defaults, quoted for a POSIX shell. parse_command_line reads an equal
/// request from it.
[[nodiscard]] std::string command_line(const Request& request);

/// The request of a splatray-render command; the program's name may have a folder, and scene and output may be missing. Throws
/// Error (usage) for what is no such command.
[[nodiscard]] Request parse_command_line(const std::string& text);

/// Words as a POSIX shell splits them: blanks, '...', "..." and backslashes; variables and patterns are not expanded.
/// Throws Error (usage) when a quote is not closed.
[[nodiscard]] std::vector<std::string> shell_words(const std::string& text);
/// The word, in quotes where a shell would not take it as it is.
[[nodiscard]] std::string shell_quoted(const std::string& word);

}  // namespace splatray

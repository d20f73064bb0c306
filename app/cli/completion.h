/// Scripts that have a shell complete the command lines of a program.
#pragma once
#include <string>

#include "app/cli/help_page.h"

namespace splatray {

/// A script for bash, zsh or fish: it completes the names of the page's options, values where these are words that are known, and
/// files, of those that are read the ones with extensions that can be. Throws Error (usage) for another shell.
[[nodiscard]] std::string completion_script(const HelpPage& page, const std::string& shell);

}  // namespace splatray

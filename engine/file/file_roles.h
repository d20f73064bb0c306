/// What a run reads and what it writes: no output replaces an input, or another output. Files are the same by device and inode, so
/// that links of both kinds and other spellings of a path are known. A process has one list; any thread.
#pragma once
#include <filesystem>

namespace splatray {

/// Says that a file is read; all that opens files which a user names, or which those name, calls it. A file that does not exist
/// is none. Throws Error (usage), one sentence, where it was claimed.
void note_input(const std::filesystem::path& file);

/// Says that this run will write a file, which need not exist; programs call it before they read. Throws Error (usage), one
/// sentence, where it is an input, or was claimed already.
void claim_output(const std::filesystem::path& file);

/// Throws Error (usage), one sentence, where a file that is going to be written is an input: for processes that write a file as often
/// as they like.
void require_no_input(const std::filesystem::path& file);

}  // namespace splatray

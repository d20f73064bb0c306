/// SIGINT, SIGTERM and SIGHUP as a question that long work asks between its steps, so that it can end cleanly.
#pragma once

namespace splatray {

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a flag; a second one of the same kind ends the program at once. Work that
/// has not ended 2 s after the first ends there with a sentence and ExitCode::interrupted: its files are whole or absent all the same.
/// A SIGHUP that is ignored, as nohup has it, stays ignored.
void catch_interrupts();
/// Whether a signal has come.
[[nodiscard]] bool interrupted();
/// Work that ends after a signal has all the time it needs: what has been made is written.
void take_time_to_end();
/// Throws Error (interrupted) when a signal has come.
void stop_if_interrupted();

}  // namespace splatray

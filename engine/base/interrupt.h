/// SIGINT, SIGTERM and SIGHUP as a question that long work asks between its steps, so that it can end cleanly.
#pragma once

namespace splatray {

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a flag, and a second one ends the program at once. Work that has not
/// ended 2 s after the first ends there, unless take_time_to_end() was called. Both end it with a sentence and
/// ExitCode::interrupted: its files are whole or absent all the same. A SIGHUP that is ignored, as nohup has it, stays ignored.
void catch_interrupts();
/// Whether a signal has come.
[[nodiscard]] bool interrupted();
/// From now on work has all the time it needs after a signal: what has been made is written.
void take_time_to_end();
/// Throws Error (interrupted) when a signal has come.
void stop_if_interrupted();
/// Has a signal that ends the program at once call this before, which may do what signal handlers may.
void at_abrupt_end(void (*clean)());

}  // namespace splatray

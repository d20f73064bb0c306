/// Scenes used by progress functions, by threads at once and in forked processes.
#pragma once
#include <string>

/// What is wrong; empty = nothing. Whoever calls sets an alarm: a failure may be a call that never ends.
std::string find_reentrance_defect();

/// A quantity summed along a parameter over [0, 1], such as the length of a curve, and where a share of it is reached.
#pragma once
#include <functional>
#include <vector>

namespace splatray {

/// Sums from 0 to each of the parameters i / 4096, the last being the whole. `piece` gives the quantity between two
/// parameters; chords of a knot summed so differ from its arcs by less than 1e-6.
[[nodiscard]] std::vector<double> running_sum(const std::function<double(double from, double to)>& piece);

/// Parameter at which the share `fraction`, 0 to 1, of the whole is reached.
[[nodiscard]] double parameter_at(const std::vector<double>& sums, double fraction);

}  // namespace splatray

#include "data/running_sum.h"

#include <algorithm>

namespace splatray {
namespace {

constexpr int STEPS = 4096;

}  // namespace

std::vector<double> running_sum(const std::function<double(double, double)>& piece) {
  std::vector<double> sums{0.0};
  for (int i = 1; i <= STEPS; ++i) sums.push_back(sums.back() + piece((i - 1.0) / STEPS, 1.0 * i / STEPS));
  return sums;
}

double parameter_at(const std::vector<double>& sums, double fraction) {
  const double sum = fraction * sums.back();
  const auto after = std::upper_bound(sums.begin() + 1, sums.end() - 1, sum);
  const double rest = (sum - after[-1]) / (after[0] - after[-1]);
  return (static_cast<double>(after - sums.begin()) - 1.0 + rest) / STEPS;
}

}  // namespace splatray

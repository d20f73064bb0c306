/// Small systems of normal equations.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace splatray {

/// Sums up equations row . x = value of unknowns x, and solves them by least squares.
template <std::size_t N>
class LeastSquares {
 public:
  using Row = std::array<double, N>;

  void add(const Row& row, double value, double weight = 1.0) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) matrix_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * row[i] * value;
    }
  }

  /// The unknowns; nothing where the equations do not determine them.
  [[nodiscard]] std::optional<Row> solve() const { return solve(right_); }

  /// The variance of one unknown where that of each equation's value is 1.
  [[nodiscard]] std::optional<double> variance(std::size_t unknown) const {
    Row unit{};
    unit[unknown] = 1.0;
    const auto column = solve(unit);
    return column ? std::optional((*column)[unknown]) : std::nullopt;
  }

 private:
  /// By Cholesky's factors.
  [[nodiscard]] std::optional<Row> solve(Row b) const {
    constexpr double LEAST = 1e-12;  // of a pivot's own size
    auto l = matrix_;
    for (std::size_t j = 0; j < N; ++j) {
      for (std::size_t k = 0; k < j; ++k) l[j][j] -= l[j][k] * l[j][k];
      if (!(l[j][j] > LEAST * matrix_[j][j])) return {};
      l[j][j] = std::sqrt(l[j][j]);
      for (std::size_t i = j + 1; i < N; ++i) {
        for (std::size_t k = 0; k < j; ++k) l[i][j] -= l[i][k] * l[j][k];
        l[i][j] /= l[j][j];
      }
    }
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
      b[i] /= l[i][i];
    }
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) b[i] -= l[k][i] * b[k];
      b[i] /= l[i][i];
    }
    return b;
  }

  std::array<Row, N> matrix_{};
  Row right_{};
};

}  // namespace splatray

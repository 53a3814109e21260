// SPDX-License-Identifier: Apache-2.0
#include "smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace external_command {

namespace {

constexpr std::size_t kBand = 3;    // off-diagonals of the system of equations
constexpr double kHeld = 1e6;       // weight of the points that stay, beside that of the third differences
constexpr double kSettled = 40.0;   // scales after which the factors no longer change, away from the ends
constexpr double kMaxScale = 30.0;  // beyond, the digits run out
constexpr double kThird[] = {-1.0, 3.0, -3.0, 1.0};

/// One row of the symmetric band matrix, or of its factors L D L^T: the diagonal, then what stands left of it, the
/// nearest first.
struct Row {
  double diagonal = 0.0;
  std::array<double, kBand> left{};
};

class System {
 public:
  System(std::size_t count, std::size_t first, std::size_t last, double scale)
      : count_(count), first_(first), last_(last), lambda_(std::pow(scale, 6.0)) {
    held_ = kHeld * std::max(lambda_, 1.0);
    settled_ = (first == kNone ? 0 : first) + static_cast<std::size_t>(kSettled * std::max(scale, 1.0));
  }

  double held() const { return held_; }

  std::vector<Row> factorize() const {
    std::vector<Row> rows(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const bool is_settled = i > settled_ && i < last_ && i + kBand < count_;
      rows[i] = is_settled ? rows[i - 1] : factor(rows, i);
    }
    return rows;
  }

 private:
  /// Row `i` of W + lambda D^T D, where D takes third differences.
  Row row(std::size_t i) const {
    Row row;
    row.diagonal = i == first_ || i == last_ ? held_ : 1.0;
    for (std::size_t j = i < kBand ? 0 : i - kBand; j <= i && j + kBand < count_; ++j) {
      const double own = lambda_ * kThird[i - j];
      row.diagonal += own * kThird[i - j];
      for (std::size_t k = 1; k <= i - j; ++k) row.left[k - 1] += own * kThird[i - j - k];
    }
    return row;
  }

  Row factor(const std::vector<Row>& rows, std::size_t i) const {
    Row row = this->row(i);
    for (std::size_t k = std::min(i, kBand); k >= 1; --k) {
      const Row& other = rows[i - k];
      for (std::size_t m = k + 1; m <= std::min(i, kBand); ++m) {
        row.left[k - 1] -= row.left[m - 1] * other.left[m - k - 1] * rows[i - m].diagonal;
      }
      row.left[k - 1] /= other.diagonal;
      row.diagonal -= row.left[k - 1] * row.left[k - 1] * other.diagonal;
    }
    return row;
  }

  std::size_t count_, first_, last_, settled_;
  double lambda_, held_;
};

}  // namespace

void smooth(double scale, std::size_t first, std::size_t last, std::vector<Point2d>* points) {
  const std::size_t count = points->size();
  if (count <= kBand) return;
  const System system(count, first, last, std::min(scale, kMaxScale));
  const std::vector<Row> rows = system.factorize();
  std::vector<Point2d>& p = *points;
  const Point2d begin = p[first == kNone ? 0 : first], end = p[last == kNone ? count - 1 : last];
  for (Point2d& point : p) point -= begin;  // map coordinates would eat the digits
  if (last != kNone) p[last] *= system.held();
  // What is known longest is taken off first: each point waits for one step of its neighbour's, not for three.
  const auto forward = [&](std::size_t i, std::size_t band) {
    for (std::size_t k = band; k >= 1; --k) p[i] -= rows[i].left[k - 1] * p[i - k];
  };
  const auto backward = [&](std::size_t i, std::size_t band) {
    for (std::size_t k = band; k >= 1; --k) p[i] -= rows[i + k].left[k - 1] * p[i + k];
  };
  for (std::size_t i = 1; i < kBand; ++i) forward(i, i);
  for (std::size_t i = kBand; i < count; ++i) forward(i, kBand);
  for (std::size_t i = 0; i < count; ++i) p[i] /= rows[i].diagonal;
  for (std::size_t k = 1; k < kBand; ++k) backward(count - 1 - k, k);
  for (std::size_t i = count - kBand; i-- > 0;) backward(i, kBand);
  for (Point2d& point : p) point += begin;
  if (first != kNone) p[first] = begin;
  if (last != kNone) p[last] = end;
}

}  // namespace external_command

// SPDX-License-Identifier: Apache-2.0
#include "surface/quadric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace msq {

namespace {

/// Less of half the trace is the bend of a smooth surface, not an edge: two planes that meet at an
/// angle a have eigenvalues of the ratio tan(a / 2)^2, here 11 degrees.
constexpr double min_ratio = 0.01;

using Matrix = std::array<std::array<double, 3>, 3>;

/// Diagonalises a symmetric matrix by Jacobi's rotations; the columns of `vectors` become its
/// eigenvectors.
void diagonalise(Matrix& m, Matrix& vectors) {
  vectors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int max_sweeps = 16;
  constexpr std::array<std::pair<size_t, size_t>, 3> pairs{{{0, 1}, {0, 2}, {1, 2}}};
  const double size = m[0][0] + m[1][1] + m[2][2];
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    const double off = std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]);
    if (!(off > 0x1p-50 * size)) return;
    for (const auto& [p, q] : pairs) {
      if (m[p][q] == 0) continue;
      const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      const auto rotate = [c, s](double& a, double& b) {
        const double old = a;
        a = c * old - s * b;
        b = s * old + c * b;
      };
      for (size_t k = 0; k < 3; ++k) rotate(m[k][p], m[k][q]);
      for (size_t k = 0; k < 3; ++k) rotate(m[p][k], m[q][k]);
      for (size_t k = 0; k < 3; ++k) rotate(vectors[k][p], vectors[k][q]);
    }
  }
}

/// The sum of squared distances of a point from planes, as a function of the way from their mean.
class Quadric {
 public:
  Quadric(const Vec3* points, const Vec3* normals, size_t count) {
    for (size_t i = 0; i < count; ++i) mean_ = mean_ + points[i];
    mean_ = mean_ * (1 / static_cast<double>(count));
    for (size_t i = 0; i < count; ++i) {
      const Vec3 n = normals[i];
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          m_[static_cast<size_t>(a)][static_cast<size_t>(b)] += n[a] * n[b];
      const double off = dot(n, points[i] - mean_);
      right_ = right_ + n * off;
      constant_ += off * off;
    }
    count_ = static_cast<double>(count);
  }

  /// The least in a box that holds the mean, if the least of all is there, or if the planes meet in
  /// the box. Otherwise their edge or corner is in another cell: then as many directions, the
  /// largest eigenvalue first, as stay in the box.
  Vec3 minimise(const Box3& box) {
    low_ = box.min - mean_;
    high_ = box.max - mean_;
    // Rounding must not lose what lies on the box.
    const double side = max_component(box.extent());
    slack_ = 0x1p-20 * side;
    try_with({}, {false, false, false});
    constexpr double close = 0.15;  // of the side: planes that meet, except for a bend
    if (!is_least_of_all_ && !(least_ + constant_ < count_ * close * close * side * side))
      best_ = along_few();
    return max(box.min, min(box.max, mean_ + best_));
  }

 private:
  /// Tries the least where some coordinates of the way are fixed. Where that is outside of the box,
  /// another one is fixed at the side where it left.
  void try_with(Vec3 way, std::array<bool, 3> is_fixed) {
    Matrix m = m_;
    Vec3 right = right_;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        double& entry = m[static_cast<size_t>(a)][static_cast<size_t>(b)];
        const bool a_fixed = is_fixed[static_cast<size_t>(a)];
        if (is_fixed[static_cast<size_t>(b)] && !a_fixed) right[a] -= entry * way[b];
        if (a_fixed || is_fixed[static_cast<size_t>(b)]) entry = 0;
      }
    Matrix v;
    diagonalise(m, v);
    const double smallest = min_ratio * (m_[0][0] + m_[1][1] + m_[2][2]) / 2;
    Vec3 free;
    for (size_t e = 0; e < 3; ++e) {
      if (!(m[e][e] > smallest)) continue;
      const Vec3 direction{v[0][e], v[1][e], v[2][e]};
      free = free + direction * (dot(direction, right) / m[e][e]);
    }
    bool is_in_box = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (is_fixed[static_cast<size_t>(axis)]) continue;
      way[axis] = free[axis];
      is_in_box =
          is_in_box && way[axis] >= low_[axis] - slack_ && way[axis] <= high_[axis] + slack_;
    }
    if (is_in_box) {
      is_least_of_all_ = !is_fixed[0] && !is_fixed[1] && !is_fixed[2];
      return keep(way);
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (is_fixed[static_cast<size_t>(axis)]) continue;
      const double side = std::clamp(way[axis], low_[axis], high_[axis]);
      if (std::abs(side - way[axis]) <= slack_) continue;
      Vec3 next = way;
      next[axis] = side;
      std::array<bool, 3> fixed = is_fixed;
      fixed[static_cast<size_t>(axis)] = true;
      try_with(next, fixed);
    }
  }

  Vec3 along_few() const {
    Matrix m = m_, v;
    diagonalise(m, v);
    std::array<size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return m[a][a] != m[b][b] ? m[a][a] > m[b][b] : a < b; });
    Vec3 way;
    for (const size_t e : order) {
      if (!(m[e][e] > min_ratio * m[order[0]][order[0]])) break;
      const Vec3 direction{v[0][e], v[1][e], v[2][e]};
      const Vec3 next = way + direction * (dot(direction, right_) / m[e][e]);
      if (!Box3{low_, high_}.grown(slack_).contains(next)) break;
      way = next;
    }
    return way;
  }

  void keep(Vec3 way) {
    double sum = -2 * dot(right_, way);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        sum += m_[static_cast<size_t>(a)][static_cast<size_t>(b)] * way[a] * way[b];
    if (!(sum < least_)) return;
    least_ = sum;
    best_ = way;
  }

  Matrix m_{};
  Vec3 right_, mean_;
  Vec3 low_, high_, best_;
  double constant_ = 0, count_ = 0;
  bool is_least_of_all_ = false;
  double slack_ = 0, least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Vec3 nearest_to_planes(const Vec3* points, const Vec3* normals, size_t count, const Box3& box) {
  return Quadric(points, normals, count).minimise(box);
}

}  // namespace msq

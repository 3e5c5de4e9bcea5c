// SPDX-License-Identifier: Apache-2.0
#include "surface/quadric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace msq {

namespace {

/// Less of the largest eigenvalue is the bend of a smooth surface, not an edge: planes that meet at
/// an angle a have the ratio tan(a / 2)^2, here 11 degrees.
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

}  // namespace

Vec3 nearest_to_planes(const Vec3* points, const Vec3* normals, size_t count, const Box3& box) {
  Vec3 mean;
  for (size_t i = 0; i < count; ++i) mean = mean + points[i];
  mean = mean * (1 / static_cast<double>(count));
  Matrix m{};
  Vec3 right;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 n = normals[i];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) m[static_cast<size_t>(a)][static_cast<size_t>(b)] += n[a] * n[b];
    right = right + n * dot(n, points[i] - mean);
  }
  Matrix v;
  diagonalise(m, v);
  std::array<size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return m[a][a] != m[b][b] ? m[a][a] > m[b][b] : a < b; });
  const double largest = m[order[0]][order[0]];
  std::array<Vec3, 4> at{mean, mean, mean, mean};
  size_t rank = 0;
  while (rank < 3) {
    const size_t e = order[rank];
    if (!(m[e][e] > min_ratio * largest)) break;
    const Vec3 direction{v[0][e], v[1][e], v[2][e]};
    at[rank + 1] = at[rank] + direction * (dot(direction, right) / m[e][e]);
    ++rank;
  }
  // Rounding must not lose what lies on the box.
  const double slack = 0x1p-20 * max_component(box.extent());
  while (rank > 0 && !box.grown(slack).contains(at[rank])) --rank;
  return max(box.min, min(box.max, at[rank]));
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "shape/placement.h"

#include <cmath>

#include "base/status.h"

namespace msq {

namespace {

using Matrix = std::array<double, 9>;

/// a b - c d within 1.5 units of the last place. Source: Jeannerod, Louvet and Muller, "Further
/// analysis of Kahan's algorithm for the accurate computation of 2 x 2 determinants", 2013.
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

Matrix scaled(const Matrix& m, double by) {
  Matrix result;
  for (size_t i = 0; i < 9; ++i) result[i] = m[i] * by;
  return result;
}

double largest(const Matrix& m) {
  double most = 0;
  for (double v : m) most = std::max(most, std::abs(v));
  return most;
}

/// m transposed times m.
Matrix gram(const Matrix& m) {
  Matrix g;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      g[3 * i + j] = m[i] * m[j] + m[3 + i] * m[3 + j] + m[6 + i] * m[6 + j];
  return g;
}

/// At least the norm of a matrix, the most that a length grows by, and at most 2^-44 of itself
/// more. By Jacobi's rotations of m' m, each of which loses some 2^-50 of its norm; what they leave
/// beside the diagonal is added by Gershgorin's theorem.
double norm_bound(const Matrix& m) {
  const double power = std::ldexp(1.0, -std::ilogb(largest(m)));
  Matrix g = gram(scaled(m, power));
  constexpr int sweeps = 8;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const auto& [p, q] : {std::pair<size_t, size_t>{0, 1}, {0, 2}, {1, 2}}) {
      const double off = g[3 * p + q];
      if (off == 0) continue;
      const double theta = (g[4 * q] - g[4 * p]) / (2 * off);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (size_t k = 0; k < 3; ++k) {
        const double a = g[3 * k + p], b = g[3 * k + q];
        g[3 * k + p] = c * a - s * b;
        g[3 * k + q] = s * a + c * b;
      }
      for (size_t k = 0; k < 3; ++k) {
        const double a = g[3 * p + k], b = g[3 * q + k];
        g[3 * p + k] = c * a - s * b;
        g[3 * q + k] = s * a + c * b;
      }
    }
  double most = 0;
  for (size_t i = 0; i < 3; ++i)
    most = std::max(most, std::abs(g[3 * i]) + std::abs(g[3 * i + 1]) + std::abs(g[3 * i + 2]));
  return std::sqrt(most * (1 + 0x1p-44)) / power;
}

}  // namespace

Placement::Placement(const std::array<double, 12>& matrix) {
  for (size_t i = 0; i < matrix.size(); ++i)
    if (!std::isfinite(matrix[i]))
      fail(Status::argument, "matrix[%zu] is %g; it must be finite", i, matrix[i]);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) linear_[3 * i + j] = matrix[4 * i + j];
    offset_[static_cast<int>(i)] = matrix[4 * i + 3];
  }
  invert();
  measure();
}

void Placement::invert() {
  const double size = largest(linear_);
  if (!(size > 0)) fail(Status::argument, "the matrix is singular: its determinant is 0");
  // Beyond, powers of two have no inverse. Lengths grow by the size at least, by 3 times it at
  // most.
  if (!(size >= 0x1p-900 && size <= 0x1p900))
    fail(Status::argument,
         "the numbers of the matrix are up to %g; lengths may grow by factors from %g to %g", size,
         1 / max_scale, max_scale);
  // By a power of two, which changes nothing but the range of numbers.
  const double power = std::ldexp(1.0, -std::ilogb(size));
  const Matrix a = scaled(linear_, power);
  Matrix cofactors;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      const size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactors[3 * i + j] =
          difference_of_products(a[3 * i1 + j1], a[3 * i2 + j2], a[3 * i1 + j2], a[3 * i2 + j1]);
    }
  const double determinant = a[0] * cofactors[0] + a[1] * cofactors[1] + a[2] * cofactors[2];
  determinant_ = determinant / power / power / power;
  double condition = std::numeric_limits<double>::infinity();
  if (determinant != 0) {
    condition = 0;
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) inverse_[3 * i + j] = cofactors[3 * j + i] / determinant;
    for (size_t i = 0; i < 3; ++i) {
      double sum = 0;
      for (size_t j = 0; j < 3; ++j)
        for (size_t k = 0; k < 3; ++k)
          sum += std::abs(a[3 * i + k]) * std::abs(inverse_[3 * k + j]);
      condition = std::max(condition, sum);
    }
  }
  if (!(condition <= max_condition))
    fail(Status::argument,
         "the matrix is singular or nearly so: its determinant is %g and its condition %g; the "
         "limit is %g",
         determinant_, condition, max_condition);
  for (double& v : inverse_) {
    v *= power;
    if (v == 0) v = 0;  // not -0
  }
  rounding_ = 0x1p-47 * condition;
}

void Placement::measure() {
  min_growth_ = (1 - 0x1p-50) / norm_bound(inverse_);
  max_growth_ = norm_bound(linear_);
  if (!(min_growth_ >= 1 / max_scale && max_growth_ <= max_scale))
    fail(Status::argument, "lengths would grow by factors from %g to %g; the limits are %g and %g",
         min_growth_, max_growth_, 1 / max_scale, max_scale);
  const double power = std::ldexp(1.0, -std::ilogb(largest(linear_)));
  const Matrix g = gram(scaled(linear_, power));
  const double square = (g[0] + g[4] + g[8]) / 3;
  double sum = 0;
  for (size_t i = 0; i < 9; ++i) {
    const double off = g[i] / square - (i % 4 == 0);
    sum += off * off;
  }
  scale_ = std::sqrt(square) / power;
  deviation_ = std::sqrt(sum) + 0x1p-48;
}

Ray Placement::to_original(const Ray& ray, double& factor) const {
  const Vec3 along = apply(inverse_, ray.direction);
  factor = std::hypot(along.x, along.y, along.z);
  return {to_original(ray.origin), along * (1 / factor)};
}

Vec3 Placement::normal_to_placed(Vec3 n) const {
  const Matrix& b = inverse_;
  const double power = std::ldexp(1.0, -std::ilogb(largest(b)));
  const Vec3 turned =
      Vec3{b[0] * n.x + b[3] * n.y + b[6] * n.z, b[1] * n.x + b[4] * n.y + b[7] * n.z,
           b[2] * n.x + b[5] * n.y + b[8] * n.z} *
      power;
  return turned * (1 / std::hypot(turned.x, turned.y, turned.z));
}

Box3 Placement::to_placed(const Box3& box) const {
  const Vec3 centre = to_placed((box.min + box.max) * 0.5), half = box.extent() * 0.5;
  Vec3 reach;
  for (int i = 0; i < 3; ++i) {
    const size_t row = 3 * static_cast<size_t>(i);
    reach[i] = std::abs(linear_[row]) * half.x + std::abs(linear_[row + 1]) * half.y +
               std::abs(linear_[row + 2]) * half.z;
  }
  const Box3 placed{centre - reach, centre + reach};
  // What the sums here lose is some 2^-50 of their terms: those of A q are no larger than K times
  // |p - b| beside the box.
  return placed.grown(2 * rounding(placed) +
                      0x1p-49 * (max_magnitude(placed.min) + max_magnitude(placed.max)));
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/exact_seeds.h"

#include <cmath>

namespace msq {

namespace {

/// Bounds the rounding of determinants, relative to the sum of the magnitudes of their products: at
/// most 40 roundings of 2^-53 each.
constexpr double rounding = 1e-14;

struct Step {
  WideInt<2> x, y, z;
};
Step step(const ExactSeeds::Seed& a, const ExactSeeds::Seed& b) {
  return {WideInt<2>(b.m[0] - a.m[0]), WideInt<2>(b.m[1] - a.m[1]), WideInt<2>(b.m[2] - a.m[2])};
}
struct Normal {
  WideInt<4> x, y, z;
};
Normal cross(const Step& u, const Step& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
WideInt<6> dot(const Step& u, const Normal& n) {
  return u.x * n.x + u.y * n.y + u.z * n.z;
}

/// A number in units of 2^exponent, of which there are fewer than 2^255. The fraction of a unit is
/// left out.
WideInt<8> integer(double number, int exponent) {
  int power;
  const double mantissa = std::frexp(number, &power);  // below 1
  const auto bits = static_cast<int64_t>(std::ldexp(mantissa, 53));
  int shift = power - 53 - exponent;
  if (shift <= -63) return WideInt<8>(int64_t{0});
  if (shift <= 0) return WideInt<8>(bits >> -shift);
  WideInt<8> result(int64_t{0});
  const auto word = static_cast<size_t>(shift) / 32;
  const int within = shift % 32;
  const auto magnitude = static_cast<uint64_t>(bits < 0 ? -bits : bits);
  const uint64_t low = (magnitude & 0xffffffff) << within, high = (magnitude >> 32) << within;
  const uint64_t middle = (low >> 32) + (high & 0xffffffff);  // no carry: they share no bits
  const uint32_t words[3] = {static_cast<uint32_t>(low), static_cast<uint32_t>(middle),
                             static_cast<uint32_t>(high >> 32)};
  for (size_t i = 0; i < 3 && word + i < 8; ++i) result.part[word + i] = words[i];
  return bits < 0 ? -result : result;
}

double magnitude_of(Vec3 u, Vec3 v, Vec3 w) {
  const auto a = [](double x) { return std::abs(x); };
  return a(u.x) * (a(v.y * w.z) + a(v.z * w.y)) + a(u.y) * (a(v.z * w.x) + a(v.x * w.z)) +
         a(u.z) * (a(v.x * w.y) + a(v.y * w.x));
}

}  // namespace

ExactSeeds::Seed ExactSeeds::from(CellIndex home, const NamedSeed& seed) {
  const auto along = [](int32_t cell, double in_cell) {
    return (int64_t{cell} << 40) + static_cast<int64_t>(in_cell * 0x1p40);
  };
  return {{along(seed.cell.x - home.x, seed.in_cell.x), along(seed.cell.y - home.y, seed.in_cell.y),
           along(seed.cell.z - home.z, seed.in_cell.z)},
          seed.lift};
}

ExactSeeds::ExactSeeds(Vec3 scale) : scale_(scale) {
  for (int axis = 0; axis < 3; ++axis) {
    const WideInt<2> side(static_cast<int64_t>(std::ldexp(scale[axis], 57)));
    scale_squared_[axis] = side * side;
  }
}

int ExactSeeds::side(const Seed& a, const Seed& b, const Seed& c, const Seed& d) const {
  const Vec3 u = apart(a, b), v = apart(a, c), w = apart(a, d);
  const double volume = msq::dot(u, msq::cross(v, w));
  if (std::abs(volume) > rounding * magnitude_of(u, v, w)) return volume > 0 ? 1 : -1;
  return dot(step(a, b), cross(step(a, c), step(a, d))).sign();
}

ExactSeeds::Square ExactSeeds::square(const Seed& a, const Seed& b) const {
  const Step s = step(a, b);
  Square sum = (s.x * s.x) * scale_squared_[0] + (s.y * s.y) * scale_squared_[1] +
               (s.z * s.z) * scale_squared_[2];
  if (a.lift != b.lift) sum = sum + (integer(b.lift, -194) - integer(a.lift, -194));
  return sum;
}

// From a, let c be half the solution of n c = w for the rows n of three others and their squares w.
// Then a fourth, e, is nearer to c than a is if w_e - 2 e c < 0, and that is the quotient of the
// determinants of the four rows (n, w) and of the three rows n.
int ExactSeeds::nearer(const Seed& a, const Seed& b, const Seed& c, const Seed& d,
                       const Seed& e) const {
  const Seed* const others[4] = {&b, &c, &d, &e};
  Vec3 n[4];
  double w[4], w_magnitude[4];
  for (int i = 0; i < 4; ++i) {
    n[i] = apart(a, *others[i]);
    const double squared = msq::dot(n[i], n[i]);
    w[i] = squared + (others[i]->lift - a.lift);
    w_magnitude[i] = squared + others[i]->lift + a.lift;
  }
  double minor[4], minor_magnitude[4], all = 0, magnitude = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 u = n[i == 0 ? 1 : 0], v = n[i <= 1 ? 2 : 1], x = n[i == 3 ? 2 : 3];
    minor[i] = msq::dot(u, msq::cross(v, x));
    minor_magnitude[i] = magnitude_of(u, v, x);
    all += (i % 2 ? w[i] : -w[i]) * minor[i];
    magnitude += w_magnitude[i] * minor_magnitude[i];
  }
  if (std::abs(all) > rounding * magnitude && std::abs(minor[3]) > rounding * minor_magnitude[3])
    return (all > 0) == (minor[3] > 0) ? -1 : 1;
  return exact_nearer(a, others);
}

int ExactSeeds::exact_nearer(const Seed& a, const Seed* const (&others)[4]) const {
  Step n[4];
  for (int i = 0; i < 4; ++i) n[i] = step(a, *others[i]);
  WideInt<14> all(int64_t{0});
  int orientation = 0;
  for (int i = 0; i < 4; ++i) {
    const WideInt<6> minor = dot(n[i == 0 ? 1 : 0], cross(n[i <= 1 ? 2 : 1], n[i == 3 ? 2 : 3]));
    const WideInt<14> product = square(a, *others[i]) * minor;
    all = i % 2 ? all + product : all - product;
    orientation = minor.sign();
  }
  return -all.sign() * orientation;
}

Vec3 ExactSeeds::centre(const Seed& a, const Seed& b, const Seed& c, const Seed& d) const {
  const Step u = step(a, b), v = step(a, c), w = step(a, d);
  const Normal vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const Square to_u = square(a, b), to_v = square(a, c), to_w = square(a, d);
  const double unit = std::ldexp(0.5 / dot(u, vw).value(), -194 - 80 + 120);
  const auto solve = [&](const WideInt<4>& x, const WideInt<4>& y, const WideInt<4>& z) {
    return (to_u * x + to_v * y + to_w * z).value() * unit;
  };
  return {solve(vw.x, wu.x, uv.x) / scale_.x, solve(vw.y, wu.y, uv.y) / scale_.y,
          solve(vw.z, wu.z, uv.z) / scale_.z};
}

}  // namespace msq

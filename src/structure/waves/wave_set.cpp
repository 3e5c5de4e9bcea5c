// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_set.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "base/pi.h"
#include "base/random.h"
#include "expression/tape.h"

namespace msq {

namespace {

constexpr uint64_t stream_of_waves = 0x7761766573;  // "waves"

/// The n-th number in [0, 1) of a wave's stream.
double number(uint64_t key, uint64_t n) {
  return random_fraction(splitmix_output(key, n));
}

/// A direction, uniform in the union of the cones: uniform in a cone that is chosen by its area,
/// then accepted with the inverse of the number of cones that hold it. Directions and their
/// opposites are one, as phases are random.
bool draw(const Vec3& cosines, const Vec3& half_angles, uint64_t key, uint64_t attempt, Vec3& n) {
  const auto part = [&](int axis) { return half_angles[axis] > 0 ? 1 - cosines[axis] : 0.0; };
  const double chosen = number(key, 4 * attempt + 1) * (part(0) + part(1) + part(2));
  int axis = chosen < part(0) ? 0 : chosen < part(0) + part(1) ? 1 : 2;
  while (!(half_angles[axis] > 0)) --axis;  // the sum was rounded
  const double along = cosines[axis] + part(axis) * number(key, 4 * attempt + 2);
  const double across = std::sqrt(std::max(0.0, (1 - along) * (1 + along)));
  const double turn = two_pi * number(key, 4 * attempt + 3);
  n[axis] = along;
  n[(axis + 1) % 3] = across * apply(Op::cosine, turn, 0);
  n[(axis + 2) % 3] = across * apply(Op::sine, turn, 0);
  int cones = 0;
  for (int other = 0; other < 3; ++other)
    cones += other == axis || (half_angles[other] > 0 && std::abs(n[other]) >= cosines[other]);
  return number(key, 4 * attempt + 4) * cones < 1;
}

}  // namespace

WaveSet::WaveSet(const WaveDirections& directions) : count_(directions.count) {
  const uint64_t seed = splitmix_output(directions.seed, stream_of_waves);
  const double amplitude = std::sqrt(2.0 / directions.count);
  Vec3 cosines;
  for (int axis = 0; axis < 3; ++axis)
    cosines[axis] = std::max(0.0, apply(Op::cosine, directions.half_angles[axis], 0));
  for (uint32_t i = 0; i < directions.count; ++i) {
    const uint64_t key = splitmix_output(seed, i);
    Vec3 n;
    for (uint64_t attempt = 0;; ++attempt) {
      if (attempt % 64 == 63) check_cancelled();
      if (!draw(cosines, directions.half_angles, key, attempt, n)) continue;
      for (int axis = 0; axis < 3; ++axis)
        if (const double tile = directions.tile[axis]; tile > 0)
          n[axis] = std::floor(n[axis] * tile + 0.5) / tile;
      if (dot(n, n) > 0) break;
    }
    x_.push_back(n.x);
    y_.push_back(n.y);
    z_.push_back(n.z);
    phases_.push_back(number(key, 0));
    amplitudes_.push_back(amplitude);
  }
  const size_t padded = (count_ + sums - 1) / sums * sums;
  for (std::vector<double>* of : {&x_, &y_, &z_, &phases_, &amplitudes_}) of->resize(padded);
}

namespace {

double rational(const double (&over)[8], const double (&under)[7], double r) {
  double p = over[7], q = under[6];
  for (int i = 7; i-- > 0;) p = p * r + over[i];
  for (int i = 6; i-- > 0;) q = q * r + under[i];
  return p / (q * r + 1);
}

/// The quantile of the normal distribution for p from 0 to 1/2.
double lower_quantile(double p) {
  static constexpr double a[] = {
      3.3871328727963666080, 133.14166789178437745, 1971.5909503065514427, 13731.693765509461125,
      45921.953931549871457, 67265.770927008700853, 33430.575583588128105, 2509.0809287301226727};
  static constexpr double b[] = {
      42.313330701600911252, 687.18700749205790830, 5394.1960214247511077, 21213.794301586595867,
      39307.895800092710610, 28729.085735721942674, 5226.4952788528545610};
  static constexpr double c[] = {1.42343711074968357734,   4.63033784615654529590,
                                 5.76949722146069140550,   3.64784832476320460504,
                                 1.27045825245236838258,   0.241780725177450611770,
                                 0.0227238449892691845833, 7.74545014278341407640e-4};
  static constexpr double d[] = {2.05319162663775882187,   1.67638483018380384940,
                                 0.689767334985100004550,  0.148103976427480074590,
                                 0.0151986665636164571966, 5.47593808499534494600e-4,
                                 1.05075007164441684324e-9};
  static constexpr double e[] = {6.65790464350110377720,    5.46378491116411436990,
                                 1.78482653991729133580,    0.296560571828504891230,
                                 0.0265321895265761230930,  0.00124266094738807843860,
                                 2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr double f[] = {0.599832206555887937690,   0.136929880922735805310,
                                 0.0148753612908506148525,  7.86869131145613259100e-4,
                                 1.84631831751005468180e-5, 1.42151175831644588870e-7,
                                 2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (q >= -0.425) return q * rational(a, b, 0.180625 - q * q);
  const double r = std::sqrt(-apply(Op::logarithm, p, 0));
  return r <= 5 ? -rational(c, d, r - 1.6) : -rational(e, f, r - 5);
}

}  // namespace

double gaussian_level(double volume_fraction, bool is_sheet) {
  if (is_sheet) return -lower_quantile(0.5 * (1 - volume_fraction));
  return volume_fraction <= 0.5 ? lower_quantile(volume_fraction)
                                : -lower_quantile(1 - volume_fraction);
}

}  // namespace msq

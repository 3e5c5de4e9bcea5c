// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/waves.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/pi.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/wave_lines.h"
#include "structure/waves/wave_rays.h"
#include "structure/waves/wave_rows.h"

namespace msq {

Waves::Waves(const Neighbourhood& grid, const WaveDirections& directions, WavesKind kind,
             Parameter level)
    : Structure(grid),
      directions_(directions),
      kind_(kind),
      level_(std::move(level)),
      waves_(directions) {
  for (size_t i = 0; i < waves_.count(); ++i) {
    const Vec3 n = waves_.wave(i);
    const Vec3 w{n.x / grid.cell_size.x, n.y / grid.cell_size.y, n.z / grid.cell_size.z};
    const double square = dot(w, w);
    steepest_ += std::sqrt(square);
    bend_ += square;
    cycles_ = std::max(cycles_, std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  }
  constexpr double more = 1 + 0x1p-30;
  steepest_ *= more * two_pi * waves_.amplitude();
  bend_ *= more * two_pi * two_pi * waves_.amplitude();
}

double Waves::onset(Vec3 p) const {
  const double g = wave_sum(waves_, position(p));
  return is_sheet() ? std::abs(g) : g;
}

// A position is the difference of two points, turned by sums of three products, and divided: each
// component is within 2^-50 of three times the largest magnitude. The cycles of a wave are a sum of
// three products and a phase. The cosine adds 2^-50, sums of up to 2^12 terms less than 2^-40.
double Waves::error(double magnitude) const {
  const double cycles = 0x1p-46 * cycles_ * (magnitude + max_magnitude(neighbourhood().origin));
  return waves_.most() * (two_pi * cycles + 0x1p-38);
}

double Waves::distance_bound(Vec3 p) const {
  const Neighbourhood& grid = neighbourhood();
  Vec3 along;
  const double g = wave_gradient(waves_, position(p), along);
  const double found = is_sheet() ? std::abs(g) : g;
  const Interval level = level_.range(Box3{p, p});
  const Vec3 steep{along.x / grid.cell_size.x, along.y / grid.cell_size.y,
                   along.z / grid.cell_size.z};
  const double reach = 2 * std::abs(found - level.high) / steepest_;
  const double error_there = error(max_magnitude(p) + std::min(reach, 4 * cell_length()));
  const double gap = std::max(found - level.high, level.low - found) -
                     2 * (level.high - level.low) - 4 * error_there;
  if (!(gap > 0)) return 0;
  const double lipschitz = level_.lipschitz();
  double bound;
  if (lipschitz < infinity) {
    // Where the slope is 0 near the surface, rounding of the gap would count without a limit.
    const double slope = std::clamp(length(steep) * (1 + 0x1p-40) + steepest_ * 0x1p-36,
                                    steepest_ * 0x1p-12, steepest_) +
                         lipschitz;
    bound = 2 * gap / (slope + std::sqrt(slope * slope + 2 * bend_ * gap));
  } else {
    bound = steady_distance(gap, steepest_, 1, level_, p);
  }
  bound = std::min(bound * (1 - 0x1p-40), 2 * cell_length());
  return std::max(0.0, bound - 2 * locating_slack(p - grid.origin, bound));
}

void Waves::enter(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = WaveRay(*this, s.ray).find(true, s.from, s.to, s.t, job);
  }
}

double Waves::leave(const Ray& ray, double from, double to, const Job* job) const {
  double t;
  return WaveRay(*this, ray).find(false, from, to, t, job) ? t : to;
}

Vec3 Waves::normal(const Ray& ray, double t) const {
  const Neighbourhood& grid = neighbourhood();
  const Vec3 p = ray.at(t);
  Vec3 along;
  const double g = wave_gradient(waves_, position(p), along);
  const Vec3 steep{along.x / grid.cell_size.x, along.y / grid.cell_size.y,
                   along.z / grid.cell_size.z};
  const double sign = is_sheet() && g < 0 ? -1 : 1;
  const Vec3 away = grid.rotation.apply(steep) * sign -
                    level_.gradient(p, 0x1p-16 * min_component(grid.cell_size));
  const double size = length(away);
  return size > 0 && size < infinity ? away * (1 / size) : ray.direction * -1.0;
}

void Waves::keep_rows(const RowBlock& block, const Job* job) const {
  WaveRows(*this, block, job).keep();
}

LineGraph Waves::wall_lines(const WallSection& section) const {
  return find_wave_lines(*this, section);
}

void Waves::describe(HashInput& input) const {
  input.kind("structure: waves");
  neighbourhood().describe(input);
  input.integer(static_cast<uint64_t>(kind_));
  input.integer(directions_.seed);
  input.integer(directions_.count);
  for (const uint32_t tile : directions_.tile) input.integer(tile);
  input.point(directions_.half_angles);
  level_.describe(input);
}

}  // namespace msq

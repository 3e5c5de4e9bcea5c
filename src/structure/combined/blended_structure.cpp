// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/blended_structure.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hash_input.h"

namespace msq {

namespace {

/// Boxes of samples whose fractions are enclosed together: one word of so many rows and layers.
constexpr uint64_t box_rows = 8, box_layers = 8;

}  // namespace

bool BlendedStructure::inside(Vec3 p) const {
  const double f = fraction_.at(p);
  if (f <= 0) return a().inside(p);
  if (f >= 1) return b().inside(p);
  const Answer of_a = ask_member(0, p), of_b = ask_member(1, p);
  if (of_a.is_inside == of_b.is_inside) return of_a.is_inside;
  return distances(p, of_a, of_b).blended(f) <= 0;
}

// If one of the two took its distance, the other one does, too.
CombinedStructure::Answer BlendedStructure::ask(Vec3 p) const {
  const double f = fraction_.at(p);
  std::optional<Answer> of_a, of_b;
  if (f < 1) of_a = ask_member(0, p);
  if (f > 0) of_b = ask_member(1, p);
  const bool is_decided = !of_a || !of_b || of_a->is_inside == of_b->is_inside;
  if (is_decided && !has_distance(of_a) && !has_distance(of_b))
    return {(of_a ? of_a : of_b)->is_inside};
  const Pair pair = distances(p, of_a, of_b);
  const bool is_inside = holds(pair, f);
  return {is_inside, signed_distance(is_inside, bound_of(pair, f, p))};
}

double BlendedStructure::steady_distance_of(double gap, double apart, Vec3 p) const {
  const auto root = [&](double slope) {
    const double k = 1 + slope * apart, found = k + std::sqrt(k * k + 8 * slope * gap);
    return std::isfinite(found) ? (1 - 0x1p-40) * 2 * gap / found : 0.0;
  };
  const double everywhere = fraction_.lipschitz();
  if (std::isfinite(everywhere)) return root(everywhere);
  // As steady_distance() in common/strut_distance_bound.h.
  gap -= 0x1p-41 * (apart + 2 * gap);
  if (!(gap > 0)) return 0;
  constexpr int max_boxes = 12;
  double reach = gap, best = 0;
  for (int n = 0; n < max_boxes; ++n) {
    const double slope = fraction_.lipschitz(Box3{p, p}.grown(reach * (1 + 0x1p-40)));
    best = std::max(best, std::min(reach, root(slope)));
    if (best >= 0.5 * reach) break;
    reach = std::max(0.25 * reach, best);
  }
  return best;
}

double BlendedStructure::bound_of(const Pair& pair, double f, Vec3 p) const {
  const double apart = std::abs(pair.b - pair.a), sum = std::abs(pair.a) + std::abs(pair.b);
  const double agreed =
      (pair.a <= 0) == (pair.b <= 0) ? std::min(std::abs(pair.a), std::abs(pair.b)) : 0;
  const Interval range = fraction_.range(Box3{p, p});
  const double value = std::abs(pair.blended(f));
  const double gap = value - (slack(p, sum) + 2 * (range.high - range.low) * (apart + 2 * value));
  return gap > 0 ? std::max(agreed, steady_distance_of(gap, apart, p)) : agreed;
}

double BlendedStructure::distance_bound(Vec3 p) const {
  return bound_of(distances(p), fraction_.at(p), p);
}

double BlendedStructure::distance_at_once(Vec3 p) const {
  const Pair pair = distances(p);
  const double f = fraction_.at(p);
  return signed_distance(holds(pair, f), bound_of(pair, f, p));
}

// The points that are alive are gathered: the field may be the host's.
void BlendedStructure::values_at_living(const Vec3* points, const uint8_t* alive, size_t count,
                                        double* values) const {
  std::vector<Vec3> living;
  living.reserve(count);
  for (size_t i = 0; i < count; ++i)
    if (alive[i]) living.push_back(points[i]);
  fraction_.values(living.data(), living.size(), values);
  // From the last, so that none is overwritten before it is moved.
  for (size_t i = count, n = living.size(); n-- > 0;) {
    while (!alive[--i]) {
    }
    values[i] = values[n];
  }
}

void BlendedStructure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  std::vector<double> f(count);
  values_at_living(points, alive, count, f.data());
  std::vector<uint8_t> in_b(count);
  std::vector<uint8_t> in_a(alive, alive + count);
  for (size_t i = 0; i < count; ++i) {
    in_b[i] = static_cast<uint8_t>(alive[i] && f[i] > 0);
    if (f[i] >= 1) in_a[i] = 0;
  }
  keep_points_of(a(), points, in_a.data(), count);
  keep_points_of(b(), points, in_b.data(), count);
  for (size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) check_cancelled();
    if (!alive[i]) continue;
    if (f[i] <= 0 || f[i] >= 1 || in_a[i] == in_b[i])
      alive[i] = f[i] <= 0 ? in_a[i] : in_b[i];
    else
      alive[i] =
          distances(points[i], Answer{in_a[i] != 0}, Answer{in_b[i] != 0}).blended(f[i]) <= 0;
  }
}

BoxClass BlendedStructure::classify(const Box3& box) const {
  const Interval f = fraction_.range(box);
  if (f.high <= 0) return a().classify(box);
  if (f.low >= 1) return b().classify(box);
  const BoxClass of_a = a().classify(box);
  return of_a != BoxClass::mixed && of_a == b().classify(box) ? of_a : BoxClass::mixed;
}

uint64_t BlendedStructure::decide(const SampleGrid& grid, uint64_t w, uint64_t j, uint64_t k,
                                  uint64_t in_a, uint64_t in_b, const Job* job) const {
  uint64_t held = 0;
  for (uint64_t open = in_a ^ in_b; open;) {
    check_cancelled(job);
    const auto bit = static_cast<unsigned>(std::countr_zero(open));
    const Vec3 p = grid.at(w * bits_per_word + bit, j, k);
    const double f = fraction_.at(p);
    const Pair pair = distances(p, Answer{(in_a >> bit & 1) != 0}, Answer{(in_b >> bit & 1) != 0});
    // All samples of the row within the bound have the same result.
    const double reach = (bound_of(pair, f, p) - grid.rounding()) / grid.spacing.x;
    uint64_t same = ~uint64_t{0} << bit;
    if (!(reach >= static_cast<double>(bits_per_word - bit)))
      same &= ~uint64_t{0} >> (bits_per_word - 1 - bit - (reach >= 1 ? unsigned(reach) : 0));
    if (pair.blended(f) <= 0) held |= open & same;
    open &= ~same;
  }
  return held;
}

void BlendedStructure::keep_rows(const RowBlock& block, const Job* job) const {
  const RowCopy copy(block);
  const RowBlock& of_b = copy.block();
  const SampleGrid& grid = *block.grid;
  const size_t words = block.row_words();
  // Calls visit(range, w, y, y_end, z, z_end) for each box, with the range of its fractions.
  const auto for_each_box = [&](auto&& visit) {
    for (uint64_t z = block.z0; z < block.z1; z += box_layers)
      for (uint64_t y = block.y0; y < block.y1; y += box_rows) {
        check_cancelled(job);
        const uint64_t z_end = std::min(z + box_layers, block.z1),
                       y_end = std::min(y + box_rows, block.y1);
        for (uint64_t w = 0; w < words; ++w) {
          const uint64_t last = std::min((w + 1) * bits_per_word, grid.nx) - 1;
          const Box3 box{grid.at(w * bits_per_word, y, z), grid.at(last, y_end - 1, z_end - 1)};
          visit(fraction_.range(box), w, y, y_end, z, z_end);
        }
      }
  };
  // Each structure evaluates only the samples to which it matters.
  for_each_box([&](Interval f, uint64_t w, uint64_t y, uint64_t y_end, uint64_t z, uint64_t z_end) {
    if (f.low < 1 && f.high > 0) return;
    const RowBlock& other = f.low >= 1 ? block : of_b;
    for (uint64_t k = z; k < z_end; ++k)
      for (uint64_t j = y; j < y_end; ++j) other.row(j, k)[w] = 0;
  });
  a().keep_rows(block, job);
  b().keep_rows(of_b, job);
  for_each_box([&](Interval f, uint64_t w, uint64_t y, uint64_t y_end, uint64_t z, uint64_t z_end) {
    const bool is_pure = f.low >= 1 || f.high <= 0;
    for (uint64_t k = z; k < z_end; ++k)
      for (uint64_t j = y; j < y_end; ++j) {
        uint64_t& in_a = block.row(j, k)[w];
        const uint64_t in_b = of_b.row(j, k)[w];
        in_a = is_pure ? in_a | in_b : (in_a & in_b) | decide(grid, w, j, k, in_a, in_b, job);
      }
  });
}

// What neither structure holds, the blend does not hold: the march begins where one is entered.
void BlendedStructure::enter(RaySearch* searches, size_t count, const Job* job) const {
  enter_any(members(), searches, count, job);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.normal = {};
    if (s.found) s.found = march_finely(true, s.ray, std::min(s.t, s.to), s.to, s.t, job);
  }
}

Vec3 BlendedStructure::normal(const Ray& ray, double t) const {
  const double f = fraction_.at(ray.at(t));
  if (f <= 0) return a().normal(ray, t);
  if (f >= 1) return b().normal(ray, t);
  return normal_by_value([this](Vec3 q) { return distances(q).blended(fraction_.at(q)); }, ray, t);
}

void BlendedStructure::describe(HashInput& input) const {
  input.kind("structure: blend");
  input.object(a());
  input.object(b());
  fraction_.describe(input);
}

}  // namespace msq

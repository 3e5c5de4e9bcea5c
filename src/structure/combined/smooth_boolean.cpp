// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/smooth_boolean.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/ball.h"
#include "base/hash_input.h"
#include "structure/combined/member_lines.h"
#include "structure/common/strut_distance_bound.h"

namespace msq {

SmoothBoolean::SmoothBoolean(Operation operation, const Ref<const Structure>& a,
                             const Ref<const Structure>& b, Parameter radius)
    : SteadyPair(a, b),
      operation_(operation),
      radius_(std::move(radius)),
      plain_(make_ref<BooleanStructure>(operation, StructureList{a, b})) {}

double SmoothBoolean::Pair::smooth(double k) const {
  const double h = k - std::abs(u - v);
  return h > 0 ? least() - 0.25 * (h * (h / k)) : least();
}

// There u and v are at least 0. If one of them is at least k, h is at most the other one, and so is
// h (h / k): s is more than 0 where both are, and 0 if one is 0.
bool SmoothBoolean::is_in_fillet(Vec3 p, const Answer& of_a, const Answer& of_b) const {
  const double k = radius_.at(p);
  const double u = oriented(0, distance_of_member(0, of_a, p));
  if (u >= k) return false;
  const double v = oriented(1, distance_of_member(1, of_b, p));
  return v < k && is_fillet(Pair{u, v}.smooth(k));
}

bool SmoothBoolean::inside(Vec3 p) const {
  const Answer of_a = ask_member(0, p);
  if (of_a.is_inside != is_turned(0)) return is_union();
  const Answer of_b = ask_member(1, p);
  if (of_b.is_inside != is_turned(1)) return is_union();
  return is_in_fillet(p, of_a, of_b) == is_union();
}

bool SmoothBoolean::holds(const Pair& pair, double k) const {
  const bool is_open =
      (is_turned(0) ? pair.u >= 0 : pair.u > 0) && (is_turned(1) ? pair.v >= 0 : pair.v > 0);
  if (!is_open) return is_union();
  return (pair.u < k && pair.v < k && is_fillet(pair.smooth(k))) == is_union();
}

// If one of the two took its distance, the other one does, too.
CombinedStructure::Answer SmoothBoolean::ask(Vec3 p) const {
  const std::optional<Answer> of_a = ask_member(0, p);
  std::optional<Answer> of_b;
  bool is_decided = of_a->is_inside != is_turned(0);
  if (!is_decided) {
    of_b = ask_member(1, p);
    is_decided = of_b->is_inside != is_turned(1);
  }
  if (is_decided && !has_distance(of_a) && !has_distance(of_b)) return {is_union()};
  const Pair at = pair(p, of_a, of_b);
  const bool is_inside = holds(at, radius_.at(p));
  return {is_inside, signed_distance(is_inside, bound_of(at, p))};
}

double SmoothBoolean::distance_at_once(Vec3 p) const {
  const Pair at = pair(p);
  return signed_distance(holds(at, radius_.at(p)), bound_of(at, p));
}

double SmoothBoolean::bound_of(const Pair& pair, Vec3 p) const {
  const double decided = std::max(0.0, -pair.least());
  const Interval k = radius_.range(Box3{p, p});
  const double sum = std::abs(pair.u) + std::abs(pair.v) + k.high;
  const double gap = std::abs(pair.smooth(radius_.at(p))) - slack(p, sum) - (k.high - k.low);
  return gap > 0 ? std::max(decided, steady_distance(gap, 1, 0.25, radius_, p)) : decided;
}

double SmoothBoolean::distance_bound(Vec3 p) const {
  return bound_of(pair(p), p);
}

SmoothBoolean::Fillets SmoothBoolean::fillets_of(const Box3& box, Vec3 middle, double reach) const {
  const Pair at = pair(middle);
  const double high = radius_.range(box).high;
  const double sum = std::abs(at.u) + std::abs(at.v) + high;
  if (std::max(at.u, at.v) - slack(middle, sum) - reach >= high) return Fillets::none;
  if (bound_of(at, middle) <= reach) return Fillets::unknown;
  return is_fillet(at.smooth(radius_.at(middle))) ? Fillets::all : Fillets::none;
}

void SmoothBoolean::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  std::vector<uint8_t> open(alive, alive + count);
  plain_->keep_points(points, alive, count);
  for (size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) check_cancelled();
    if (open[i] && (alive[i] != 0) != is_union() && is_in_fillet(points[i]))
      alive[i] = static_cast<uint8_t>(is_union());
  }
}

BoxClass SmoothBoolean::classify(const Box3& box) const {
  const BoxClass plain = plain_->classify(box);
  if (plain == BoxClass::mixed || (plain == BoxClass::inside) == is_union()) return plain;
  const Ball ball = ball_about(box);
  switch (fillets_of(box, ball.centre, ball.radius)) {
    case Fillets::none:
      return plain;
    case Fillets::all:
      return is_union() ? BoxClass::inside : BoxClass::outside;
    default:
      return BoxClass::mixed;
  }
}

// Boxes of samples that the plain boolean leaves open are halved until distances at their middles
// decide them or few samples are left.
class SmoothBoolean::Rows {
 public:
  /// change(word, bits): takes the bits of a word of `open` that are in fillets.
  template <class Change>
  static void divide(const SmoothBoolean& structure, const RowBlock& open, const Job* job,
                     const Change& change) {
    const Part all{{0, open.y0, open.z0}, {open.grid->nx, open.y1, open.z1}};
    if (open.grid->nx && open.rows() && open.layers())
      Work<Change>{structure, open, *open.grid, job, change}.divide(all);
  }

 private:
  static constexpr uint64_t few = 16;

  struct Part {
    uint64_t low[3], high[3];  // samples, high excluded
    uint64_t count(int axis) const { return high[axis] - low[axis]; }
  };

  template <class Change>
  struct Work {
    const SmoothBoolean& structure;
    const RowBlock& open;
    const SampleGrid& grid;
    const Job* job;
    const Change& change;

    /// Calls visit(j, k, word, bits) for the words of a part with open samples.
    template <class Visit>
    void for_each_word(const Part& part, Visit&& visit) const {
      const uint64_t first = part.low[0], last = part.high[0] - 1;
      for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
        for (uint64_t j = part.low[1]; j < part.high[1]; ++j)
          for (uint64_t w = first / bits_per_word; w <= last / bits_per_word; ++w) {
            uint64_t bits = open.row(j, k)[w];
            if (w == first / bits_per_word) bits &= ~uint64_t{0} << first % bits_per_word;
            if (w == last / bits_per_word)
              bits &= ~uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
            if (bits) visit(j, k, w, bits);
          }
    }

    void divide(const Part& part) const {
      check_cancelled(job);
      uint64_t samples = 0;
      for_each_word(part, [&](uint64_t, uint64_t, uint64_t, uint64_t bits) {
        samples += static_cast<uint64_t>(std::popcount(bits));
      });
      if (samples == 0) return;
      if (samples <= few) return look_at_each(part);
      const Box3 box{grid.at(part.low[0], part.low[1], part.low[2]),
                     grid.at(part.high[0] - 1, part.high[1] - 1, part.high[2] - 1)};
      const Ball ball = ball_about(box);
      const Fillets found = structure.fillets_of(box, ball.centre, ball.radius);
      if (found == Fillets::none) return;
      if (found == Fillets::all)
        return for_each_word(part, [&](uint64_t j, uint64_t k, uint64_t w, uint64_t bits) {
          change(j, k, w, bits);
        });
      const Vec3 extent = box.max - box.min;
      int longest = -1;
      for (int axis = 0; axis < 3; ++axis)
        if (part.count(axis) > 1 && (longest < 0 || extent[axis] > extent[longest])) longest = axis;
      Part lower = part, upper = part;
      lower.high[longest] = upper.low[longest] = part.low[longest] + part.count(longest) / 2;
      divide(lower);
      divide(upper);
    }

    void look_at_each(const Part& part) const {
      for_each_word(part, [&](uint64_t j, uint64_t k, uint64_t w, uint64_t bits) {
        uint64_t found = 0;
        for (uint64_t rest = bits; rest; rest &= rest - 1) {
          const auto bit = static_cast<unsigned>(std::countr_zero(rest));
          if (structure.is_in_fillet(grid.at(w * bits_per_word + bit, j, k)))
            found |= uint64_t{1} << bit;
        }
        if (found) change(j, k, w, found);
      });
    }
  };
};

void SmoothBoolean::keep_rows(const RowBlock& block, const Job* job) const {
  if (!is_union()) {
    plain_->keep_rows(block, job);
    return Rows::divide(*this, block, job, [&](uint64_t j, uint64_t k, uint64_t w, uint64_t bits) {
      block.row(j, k)[w] &= ~bits;
    });
  }
  const RowCopy open(block);
  plain_->keep_rows(block, job);
  for_each_word(block, open.block(), [](uint64_t inside, uint64_t& left) { left &= ~inside; });
  Rows::divide(*this, open.block(), job, [&](uint64_t j, uint64_t k, uint64_t w, uint64_t bits) {
    block.row(j, k)[w] |= bits;
  });
}

// Nothing is inside an intersection or difference before the first structure is.
void SmoothBoolean::enter(RaySearch* searches, size_t count, const Job* job) const {
  if (!is_union()) a().enter(searches, count, job);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    if (!is_union() && !s.found) continue;
    s.normal = {};
    s.found = march_finely(true, s.ray, is_union() ? s.from : std::min(s.t, s.to), s.to, s.t, job);
  }
}

Vec3 SmoothBoolean::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const Pair at = pair(p);
  if (std::abs(at.u - at.v) >= radius_.at(p)) return plain_->normal(ray, t);
  const double sign = is_union() ? 1 : -1;
  return normal_by_value([&](Vec3 q) { return sign * pair(q).smooth(radius_.at(q)); }, ray, t);
}

ThinWalls SmoothBoolean::thin_walls() const {
  return walls_of_members(operation_, members());
}

LineGraph SmoothBoolean::wall_lines(const WallSection& section) const {
  return lines_of_members(operation_, members(), section);
}

void SmoothBoolean::describe(HashInput& input) const {
  input.kind("structure: smooth boolean");
  input.integer(static_cast<uint64_t>(operation_));
  input.object(a());
  input.object(b());
  radius_.describe(input);
}

}  // namespace msq

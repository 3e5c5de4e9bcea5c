// SPDX-License-Identifier: Apache-2.0
// Structures made of structures within each other: how often they evaluate those within, that all
// ways to ask a point agree, the precision of their distances, cancellation, and working memory.
#include <cmath>
#include <functional>

#include "base/job.h"
#include "field/gradient.h"
#include "msq_test.h"
#include "query/membership.h"
#include "random.h"
#include "shape/primitive.h"
#include "structure/combined/blended_structure.h"
#include "structure/combined/smooth_boolean.h"
#include "structure/common/walled_struts.h"
#include "structure/waves/waves.h"

using namespace msq;
using namespace msq::test;

namespace {

using Operation = BooleanStructure::Operation;
using StructureRef = Ref<const Structure>;

/// The points at most `radius` from a middle. Counts what is asked of all balls.
class Ball final : public Structure {
 public:
  static inline uint64_t asked = 0, distances = 0;
  /// Is cancelled with the tenth distance.
  static inline Job* job = nullptr;

  Ball(Vec3 middle, double radius)
      : Structure(middle, 1.0, 1.0), middle_(middle), radius_(radius) {}

  bool inside(Vec3 p) const override {
    ++asked;
    return length(p - middle_) <= radius_;
  }
  double distance_bound(Vec3 p) const override {
    ++asked;
    if (++distances == 10 && job) job->cancel();
    return std::max(0.0, std::abs(length(p - middle_) - radius_) - 1e-12);
  }
  bool has_steady_distance() const override { return true; }

 private:
  void describe(HashInput&) const override {}
  Vec3 middle_;
  double radius_;
};

StructureRef united(const StructureRef& a, const StructureRef& b) {
  return make_ref<BooleanStructure>(Operation::united, StructureList{a, b});
}

StructureRef blended(const StructureRef& a, const StructureRef& b, double fraction) {
  return make_ref<BlendedStructure>(a, b, Parameter(fraction));
}

StructureRef smoothed(Operation operation, const StructureRef& a, const StructureRef& b,
                      double radius) {
  return make_ref<SmoothBoolean>(operation, a, b, Parameter(radius));
}

const CombinedStructure& combined(const StructureRef& structure) {
  return dynamic_cast<const CombinedStructure&>(*structure);
}

enum class Way { blends, smooth, all };

/// `made` and another ball, so that the signed distances of both matter at p.
StructureRef with_one_more(const StructureRef& made, Vec3 p, Way way, int level) {
  const bool in = made->inside(p);
  const StructureRef held = make_ref<Ball>(p + Vec3{1, 0, 0}, 1.3),  // p is 0.3 inside
      beside = make_ref<Ball>(p + Vec3{1, 0, 0}, 0.7);               // p is 0.3 outside
  if (way == Way::blends || (way == Way::all && level % 3 == 0))
    return blended(made, in ? beside : held, 0.5);
  if (way == Way::all && level % 3 == 1)
    return make_ref<BooleanStructure>(in ? Operation::intersected : Operation::united,
                                      StructureList{made, in ? held : beside});
  if (level % 2 == 0) return smoothed(Operation::subtracted, made, beside, 0.5);
  return smoothed(in ? Operation::intersected : Operation::united, made, in ? held : beside, 0.5);
}

void each_member_is_evaluated_a_few_times(void**) {
  const Vec3 p{0.1, 0.2, 0.3};
  for (const Way way : {Way::blends, Way::smooth, Way::all}) {
    StructureRef made = make_ref<Ball>(p, 0.5);
    for (int level = 1; level <= 60; ++level) {
      Ball::asked = 0;
      made = with_one_more(made, p, way, level);
      const uint64_t balls = static_cast<uint64_t>(level) + 1;
      const auto check = [&](uint64_t most, auto&& ask) {
        Ball::asked = 0;
        ask();
        if (Ball::asked > most * balls)
          fail_msg("%d within each other: %llu evaluations", level,
                   static_cast<unsigned long long>(Ball::asked));
      };
      check(3, [&] { (void)made->inside(p); });
      check(2, [&] { (void)made->distance_bound(p); });
      check(5, [&] { (void)made->distance(p); });
      check(3, [&] { (void)combined(made).ask(p); });
      check(2, [&] { (void)combined(made).distance_at_once(p); });
    }
  }
}

/// As the headers define it, by inside() and distance_bound() of the members alone.
struct Written {
  StructureRef made;
  std::function<bool(Vec3)> inside;
};

double distance_of(const StructureRef& structure, Vec3 p) {
  return signed_distance(structure->inside(p), structure->distance_bound(p));
}

Written random_pair(Random& random, const StructureRef& a, const StructureRef& b) {
  const auto operation = static_cast<Operation>(1 + random.below(3));
  const double f = random.between(-0.2, 1.2), fraction = std::min(1.0, std::max(0.0, f));
  const double k = random.below(4) ? random.between(0.1, 1) : 0;
  const auto plain = [=](Vec3 p) {
    const bool in_a = a->inside(p), in_b = b->inside(p);
    return operation == Operation::united        ? in_a || in_b
           : operation == Operation::intersected ? in_a && in_b
                                                 : in_a && !in_b;
  };
  switch (random.below(3)) {
    case 0:
      return {blended(a, b, fraction), [=](Vec3 p) {
                if (fraction <= 0) return a->inside(p);
                if (fraction >= 1 || a->inside(p) == b->inside(p)) return b->inside(p);
                return (1 - fraction) * distance_of(a, p) + fraction * distance_of(b, p) <= 0;
              }};
    case 1:
      return {smoothed(operation, a, b, k), [=](Vec3 p) {
                const bool is_union = operation == Operation::united;
                if (plain(p) == is_union) return is_union;
                const double u = distance_of(a, p) * (is_union ? 1 : -1);
                const double v = distance_of(b, p) * (operation == Operation::intersected ? -1 : 1);
                const double h = k - std::abs(u - v);
                const double s = h > 0 ? std::min(u, v) - 0.25 * (h * (h / k)) : std::min(u, v);
                return is_union ? s <= 0 : s >= 0;
              }};
    default:
      return {make_ref<BooleanStructure>(operation, StructureList{a, b}), plain};
  }
}

/// Balls within 0.5 of the middle of space, in pairs within each other, in any order.
void all_ways_to_ask_a_point_agree(void**) {
  Random random(4);
  size_t held = 0, with_distance = 0, points = 0;
  for (size_t round = test_count(400) + 20; round > 0; --round) {
    std::vector<StructureRef> parts;
    std::vector<Vec3> on_surfaces;  // where distances are 0, on either side
    for (int i = 0; i < 6; ++i) {
      const Vec3 middle = random.in_box({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
      const double radius = random.between(0.4, 1);
      parts.push_back(make_ref<Ball>(middle, radius));
      const Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
      on_surfaces.push_back(middle + way * (radius / length(way)));
    }
    while (parts.size() > 1) {
      const size_t i = random.below(parts.size() - 1);
      const Written written = random_pair(random, parts[i], parts[i + 1]);
      parts[i] = written.made;
      parts.erase(parts.begin() + static_cast<ptrdiff_t>(i) + 1);
      for (int n = 0; n < 20; ++n) {
        const Vec3 p = n % 2 ? random.in_box({{-1, -1, -1}, {1, 1, 1}})
                             : on_surfaces[random.below(on_surfaces.size())];
        const bool in = written.made->inside(p);
        assert_int_equal(in, written.inside(p));
        const double distance = signed_distance(in, written.made->distance_bound(p));
        assert_true(combined(written.made).distance_at_once(p) == distance);
        const CombinedStructure::Answer answer = combined(written.made).ask(p);
        assert_int_equal(answer.is_inside, in);
        if (answer.distance) assert_true(*answer.distance == distance);
        uint8_t alive = 1;
        written.made->keep_points(&p, &alive, 1);
        assert_int_equal(alive, in);
        held += in;
        with_distance += answer.distance.has_value();
        ++points;
      }
    }
  }
  assert_in_range(held, points / 20, points - points / 20);
  assert_in_range(with_distance, points / 100, points / 2);
}

/// From ball to ball, in the order opposite to that in which they are listed; one lies apart.
void unions_are_left_where_the_last_part_ends(void**) {
  StructureList balls;
  for (int i = 4; i >= 0; --i) balls.push_back(make_ref<Ball>(Vec3{0.8 * i, 0, 0}, 0.5));
  balls.push_back(make_ref<Ball>(Vec3{5, 0, 0}, 0.5));
  const BooleanStructure made(Operation::united, balls);
  const Ray ray{{-2, 0, 0}, {1, 0, 0}};
  const double out = made.leave(ray, 1.75, 10, nullptr);
  if (!(std::abs(out - 5.7) <= 2 * made.ray_tolerance(ray, 10))) fail_msg("left at %.17g", out);
  assert_true(made.leave(ray, 1.75, 4, nullptr) == 4);
  assert_true(made.leave(ray, 1, 10, nullptr) == 1);
}

/// Not to be evaluated at x > 0.
class PickyField final : public Field {
 public:
  double at(Vec3 p) const override {
    assert_true(p.x <= 0);
    return 0.5 + 0.4 * p.x;
  }
  Interval range() const override { return {0.1, 0.9}; }
  Interval range(const Box3&) const override { return range(); }

 private:
  void describe(HashInput&) const override {}
};

void dropped_points_are_not_evaluated(void**) {
  const StructureRef a = make_ref<Ball>(Vec3{-0.3, 0, 0}, 0.5), b = make_ref<Ball>(Vec3{}, 0.6);
  const Parameter picky(Ref<const Field>(make_ref<PickyField>()));
  const StructureRef made[2] = {make_ref<BlendedStructure>(a, b, picky),
                                make_ref<SmoothBoolean>(Operation::united, a, b, picky)};
  Random random(5);
  for (const StructureRef& structure : made) {
    std::vector<Vec3> points;
    std::vector<uint8_t> alive;
    for (int i = 0; i < 500; ++i) {
      points.push_back(random.in_box({{-1, -1, -1}, {1, 1, 1}}));
      alive.push_back(points.back().x <= 0);
    }
    structure->keep_points(points.data(), alive.data(), points.size());
    size_t held = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      assert_int_equal(alive[i], points[i].x <= 0 && structure->inside(points[i]));
      held += alive[i];
    }
    assert_in_range(held, 20, 240);
  }
}

/// Booleans around a member of a blend change no bit of its distance.
void booleans_lose_no_precision(void**) {
  const StructureRef a = make_ref<Ball>(Vec3{-0.3, 0, 0}, 0.5), b = make_ref<Ball>(Vec3{}, 0.6);
  StructureRef deep = a;
  for (int i = 0; i < 20; ++i)
    deep = make_ref<BooleanStructure>(Operation::united, StructureList{deep});
  const StructureRef plain = blended(a, b, 0.5), around = blended(deep, b, 0.5);
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    assert_true(plain->distance(p) == around->distance(p));
  }
}

void blends_of_waves_have_steady_distances(void**) {
  const Neighbourhood grid{{0.1, 0, 0}, {1, 1.5, 0.8}, {}};
  for (const WavesKind kind : {WavesKind::network, WavesKind::sheet}) {
    WaveDirections directions;
    directions.count = 15;
    directions.half_angles = {1.5, 0, 0};
    const StructureRef waves =
        make_ref<Waves>(grid, directions, kind, Parameter(kind == WavesKind::sheet ? 0.3 : 0.1));
    const StructureRef ball = make_ref<Ball>(Vec3{}, 1.0);
    for (const StructureRef& made :
         {waves, blended(waves, ball, 0.4), smoothed(Operation::united, waves, ball, 0.3)}) {
      assert_true(made->has_steady_distance());
      Random random(7);
      size_t far = 0, count = test_count(20000) + 500;
      for (size_t i = 0; i < count; ++i) {
        const Vec3 p = random.in_box({{-2, -2, -2}, {2, 2, 2}});
        const double way = std::pow(10, random.between(-6, 0));
        const Vec3 q = p + random.in_box({{-1, -1, -1}, {1, 1, 1}}) * way;
        const double of_p = made->distance(p), of_q = made->distance(q);
        assert_true(std::abs(of_p - of_q) <= length(q - p) * (1 + 1e-12) + 1e-9);
        far += std::abs(of_p) > 0.01;
      }
      assert_true(far > count / 2);
    }
  }
}

/// Rows of a blend stop within a sample of the cancellation.
void rows_stop_when_cancelled(void**) {
  const StructureRef made = blended(make_ref<Ball>(Vec3{}, 0.2), make_ref<Ball>(Vec3{}, 1.0), 0.5);
  const SampleGrid grid{{-1, -1, -1}, {0.03, 0.3, 0.3}, 64, 7, 7};
  std::vector<uint64_t> words(grid.ny * grid.nz);
  RowBlock block;
  block.grid = &grid;
  block.y1 = grid.ny;
  block.z1 = grid.nz;
  block.words = words.data();
  block.row_stride = 1;
  block.layer_stride = grid.ny;
  for (const bool is_cancelled : {false, true}) {
    const Ref<Job> job = make_ref<Job>();
    Ball::job = is_cancelled ? job.get() : nullptr;
    Ball::distances = 0;
    words.assign(words.size(), ~uint64_t{0});
    bool has_thrown = false;
    try {
      made->keep_rows(block, job.get());
    } catch (const Error& error) {
      has_thrown = error.status == Status::cancelled;
    }
    Ball::job = nullptr;
    assert_int_equal(has_thrown, is_cancelled);
    if (is_cancelled)
      assert_in_range(Ball::distances, 10, 11);
    else
      assert_true(Ball::distances > 100);
  }
}

// Two balls at nearly the same place: the fillet is a layer about both, as thick as a quarter of
// the radius. Its surface lies near an end of the samples, on one side of what the middle tells.
void long_boxes_of_samples_are_divided(void**) {
  constexpr double k = 0.4, step = 0.005;
  for (const Operation operation : {Operation::united, Operation::intersected}) {
    const bool is_union = operation == Operation::united;
    const StructureRef made = smoothed(operation, make_ref<Ball>(Vec3{-0.02, 0, 0}, 1.0),
                                       make_ref<Ball>(Vec3{0.02, 0, 0}, 1.0), k);
    const double surface = is_union ? 1 + 0.25 * k : 1 - 0.25 * k;
    size_t changes = 0;
    for (int shift = 0; shift < 40; ++shift) {
      const SampleGrid grid{{0, surface - (shift + 0.3) * step, 0}, {step, step, step}, 1, 40, 1};
      std::vector<uint64_t> words(grid.ny, 1);
      RowBlock block;
      block.grid = &grid;
      block.y1 = grid.ny;
      block.z1 = 1;
      block.words = words.data();
      block.row_stride = 1;
      block.layer_stride = grid.ny;
      made->keep_rows(block, nullptr);
      for (uint64_t j = 0; j < grid.ny; ++j) {
        assert_int_equal(words[j], made->inside(grid.at(0, j, 0)));
        changes += j > 0 && words[j] != words[j - 1];
      }
    }
    assert_true(changes > 30);
  }
}

// A ball united with itself grows by a quarter of the radius k, which falls by 2 along y: 1.5 times
// the way along y is what the value changes by.
/// Rows of the samples have what points have.
void check_rows(const Structure& structure, const SampleGrid& grid) {
  std::vector<uint64_t> words(grid.ny, (uint64_t{1} << grid.nx) - 1);
  RowBlock block;
  block.grid = &grid;
  block.y1 = grid.ny;
  block.z1 = 1;
  block.words = words.data();
  block.row_stride = 1;
  block.layer_stride = grid.ny;
  structure.keep_rows(block, nullptr);
  for (uint64_t j = 0; j < grid.ny; ++j)
    for (uint64_t i = 0; i < grid.nx; ++i)
      assert_int_equal(words[j] >> i & 1, structure.inside(grid.at(i, j, 0)));
}

// A box of one sample cannot be divided, even where the surface of the fillet is nearer to it than
// rounding.
void single_samples_next_to_fillets_are_decided(void**) {
  const Vec3 middle{0.3, 0.2, 0.1};
  const StructureRef made =
      smoothed(Operation::united, make_ref<Ball>(middle, 1.0), make_ref<Ball>(middle, 1.0), 0.4);
  double low = middle.x + 1, high = middle.x + 1.5;
  for (double x; x = 0.5 * (low + high), low < x && x < high;)
    (made->inside({x, middle.y, middle.z}) ? low : high) = x;
  assert_true(made->inside({low, middle.y, middle.z}) && !made->inside({high, middle.y, middle.z}));
  for (const double x : {low, high})
    check_rows(*made, {{x, middle.y, middle.z}, {high - low, 1, 1}, 1, 1, 1});
}

// Samples far away, two columns of which are next to each other among all numbers. The middle of
// their box is rounded to the first, which is in a ball. The second is outside of it and, as the
// other ball is nearly as far as the radius, of the fillet.
void boxes_of_samples_far_away_hold_their_samples(void**) {
  constexpr double x = 0x1p33, next = 0x1p-19, k = 0.4;
  const StructureRef made =
      smoothed(Operation::united, make_ref<Ball>(Vec3{x - 1, 0, 0}, 1 + 0.75 * next),
               make_ref<Ball>(Vec3{x + 3, 0, 0}, 3 - k + 1e-4), k);
  assert_true(made->inside({x, 0, 0}) && !made->inside({x + next, 0, 0}));
  check_rows(*made, {{x, 0, 0}, {next, 0x1p-30, 1}, 2, 32, 1});
}

void distances_heed_slopes_of_radii(void**) {
  const StructureRef ball = make_ref<Ball>(Vec3{}, 1.0);
  const Ref<const Field> radius =
      make_ref<GradientField>(Vec3{0, 0.8, 0}, 0.9, Vec3{0, 1.2, 0}, 0.1);
  const StructureRef made =
      make_ref<SmoothBoolean>(Operation::united, ball, ball, Parameter(radius));
  constexpr double surface = 1 + 1.0 / 12;
  for (const double y : {1.02, 1.05, 1.08, 1.09, 1.1, 1.12}) {
    assert_int_equal(made->inside({0, y, 0}), y < surface);
    const double distance = std::abs(y - surface), bound = made->distance_bound({0, y, 0});
    if (!(bound <= distance && bound > 0.5 * distance))
      fail_msg("at %g the bound is %g, the distance %g", y, bound, distance);
  }
}

/// Struts and walls, as foams and lattices have them.
class Both final : public WalledStruts {
 public:
  Both(StructureRef struts, StructureRef walls)
      : WalledStruts(std::move(struts), std::move(walls)) {}

 private:
  void describe(HashInput&) const override {}
};

void copies_of_rows_are_counted(void**) {
  const StructureRef ball = make_ref<Ball>(Vec3{}, 1.0);
  const auto make = [&](Operation operation, size_t count, const StructureRef& member) {
    StructureList members(count, ball);
    members[0] = member;
    return StructureRef(make_ref<BooleanStructure>(operation, members));
  };
  assert_int_equal(ball->row_copies(), 0);
  assert_int_equal(make(Operation::intersected, 3, ball)->row_copies(), 0);
  assert_int_equal(make(Operation::subtracted, 3, ball)->row_copies(), 1);
  assert_int_equal(make(Operation::united, 2, ball)->row_copies(), 1);
  assert_int_equal(make(Operation::united, 3, ball)->row_copies(), 2);
  assert_int_equal(smoothed(Operation::united, ball, ball, 1)->row_copies(), 2);
  assert_int_equal(smoothed(Operation::intersected, ball, ball, 1)->row_copies(), 0);
  const StructureRef nested = make(Operation::united, 3, blended(ball, united(ball, ball), 0.5));
  assert_int_equal(nested->row_copies(), 4);
  const StructureRef both = make_ref<Both>(ball, ball);
  assert_int_equal(both->row_copies(), 1);
  assert_int_equal(Both(ball, nested).row_copies(), 5);
  assert_int_equal(make(Operation::united, 3, both)->row_copies(), 3);

  const SampleGrid grid{{0, 0, 0}, {0.01, 0.01, 0.01}, 100, 100, 8};
  const auto words = [&](const StructureRef& structure) {
    const Model model(make_ref<Context>(1u, uint64_t{1} << 20, uint64_t{0}),
                      make_ref<SphereShape>(Vec3{0.5, 0.5, 0.5}, 0.5),
                      std::vector<StructureRef>{structure});
    return fill_slab_scratch_words(model, model.all_scales(), grid, 8);
  };
  assert_int_equal(words(nested), 5 * words(ball));
  // Both gain by layers, and share the rows of a tile.
  assert_int_equal(words(make(Operation::united, 3, both)), 2 * words(both));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(each_member_is_evaluated_a_few_times),
      cmocka_unit_test(all_ways_to_ask_a_point_agree),
      cmocka_unit_test(unions_are_left_where_the_last_part_ends),
      cmocka_unit_test(dropped_points_are_not_evaluated),
      cmocka_unit_test(booleans_lose_no_precision),
      cmocka_unit_test(blends_of_waves_have_steady_distances),
      cmocka_unit_test(rows_stop_when_cancelled),
      cmocka_unit_test(long_boxes_of_samples_are_divided),
      cmocka_unit_test(single_samples_next_to_fillets_are_decided),
      cmocka_unit_test(boxes_of_samples_far_away_hold_their_samples),
      cmocka_unit_test(distances_heed_slopes_of_radii),
      cmocka_unit_test(copies_of_rows_are_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beams.h"

#include "base/hash_input.h"
#include "base/run_parts.h"
#include "structure/beams/beam_distance.h"
#include "structure/beams/beam_order.h"
#include "structure/beams/beam_rays.h"
#include "structure/beams/beam_rows.h"
#include "structure/beams/beam_samples.h"
#include "structure/beams/beam_struts.h"

namespace msq {

namespace {

constexpr uint64_t at_once = 4096;

/// The caps of all beams of an order, if they are equal.
bool share_caps(const BeamSource& source, const BeamOrder& order, const Executor& executor,
                Job* job, BeamCap (&caps)[2]) {
  Beam first;
  source.get(order.numbers[0], first);
  caps[0] = first.cap_a;
  caps[1] = first.cap_b;
  std::atomic<bool> is_shared{true};
  executor.for_each((order.numbers.size() + at_once - 1) / at_once, [&](uint64_t n) {
    check_cancelled(job);
    if (!is_shared.load(std::memory_order_relaxed)) return;
    const size_t end = std::min<size_t>(order.numbers.size(), (n + 1) * at_once);
    for (size_t i = n * at_once; i < end; ++i) {
      Beam beam;
      source.get(order.numbers[i], beam);
      if (beam.cap_a != caps[0] || beam.cap_b != caps[1]) is_shared = false;
    }
  });
  return is_shared;
}

/// Adds numbers of 128 bits, little-endian.
void add(Hash& sum, const Hash& hash) {
  unsigned carry = 0;
  for (size_t i = 0; i < sum.size(); ++i) {
    carry += static_cast<unsigned>(sum[i]) + hash[i];
    sum[i] = static_cast<uint8_t>(carry);
    carry >>= 8;
  }
}

}  // namespace

struct Beams::Parts {
  Reservation reservation;
  std::vector<uint32_t> numbers;
  std::vector<BeamRepeat> repeats;
  BeamList beams;
  BeamTree tree;
  double longest;
};

Ref<Beams> Beams::make(const BeamSource& source, double length_scale, const Executor& executor,
                       const std::shared_ptr<MemoryBudget>& budget, Job* job) {
  Reservation working(budget, BeamOrder::bytes(source.count), "the ordering of beams");
  BeamOrder order = order_beams(source, executor, job, {0.1, 0.6});
  const size_t count = order.numbers.size();
  if (count == 0)
    fail(Status::argument,
         "none of %llu beams and balls is left: each is shorter than min_length, or has no length "
         "and flat caps",
         static_cast<unsigned long long>(source.count));
  BeamCap caps[2];
  const bool has_caps = !share_caps(source, order, executor, job, caps);
  Reservation kept(budget,
                   BeamList::bytes(count, has_caps) + BeamTree::bytes(count) +
                       order.numbers.capacity() * sizeof(uint32_t) +
                       order.repeats.capacity() * sizeof(BeamRepeat),
                   "beams");
  BeamList beams(count, has_caps ? nullptr : caps);
  run_parts(executor, (count + at_once - 1) / at_once, job, {0.6, 0.8}, [&](uint64_t n) {
    for (size_t i = n * at_once, end = std::min<size_t>(count, i + at_once); i < end; ++i) {
      Beam beam;
      source.get(order.numbers[i], beam);
      beams.set(i, beam);
    }
  });
  BeamTree tree(beams, order.box, executor, job, {0.8, 1});
  return Ref<Beams>::adopt(
      new Beams({std::move(kept), std::move(order.numbers), std::move(order.repeats),
                 std::move(beams), std::move(tree), order.longest},
                length_scale));
}

Beams::Beams(Parts&& parts, double length_scale)
    : Structure(parts.tree.box().min, parts.longest,
                length_scale > 0 ? length_scale : parts.longest),
      reservation_(std::move(parts.reservation)),
      numbers_(std::move(parts.numbers)),
      repeats_(std::move(parts.repeats)),
      beams_(std::move(parts.beams)),
      tree_(std::move(parts.tree)) {}

bool Beams::inside(Vec3 p) const {
  return !tree_.find_overlapping({p, p}, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      if (beams_.at(i).holds(p)) return false;
    return true;
  });
}

double Beams::distance_bound(Vec3 p) const {
  bool is_inside = false;
  double depth = 0;
  tree_.find_overlapping({p, p}, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Beam beam = beams_.at(i);
      if (!beam.holds(p)) continue;
      is_inside = true;
      depth = std::max(depth, depth_in_beam(beam, p));
    }
    return true;
  });
  if (is_inside) return depth;
  double least = std::numeric_limits<double>::infinity();
  tree_.find_near(p, least, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) least = std::min(least, distance_to_beam(beams_.at(i), p));
    return least;
  });
  return std::min(least, std::numeric_limits<double>::max());
}

void Beams::keep_rows(const RowBlock& block, const Job* job) const {
  BeamRows rows(*this, block, job);
  if (rows.empty()) return;
  if (rows.find())
    rows.keep();
  else
    BeamSamples(*this, block, job).keep();
}

void Beams::enter(RaySearch* searches, size_t count, const Job* job) const {
  const BeamRays rays(*this);
  JobPoll poll(job);
  for (size_t i = 0; i < count; ++i) {
    rays.enter(searches[i]);
    poll();
  }
}

double Beams::leave(const Ray& ray, double from, double to, const Job* job) const {
  return BeamRays(*this).leave(ray, from, to, job);
}

std::unique_ptr<StrutParts> Beams::struts(const StrutSelection& selection) const {
  return beam_struts(*this, selection);
}

Vec3 Beams::normal(const Ray& ray, double t) const {
  return BeamRays(*this).normal(ray, t);
}

// Beams are kept in the order of the tree. Their hashes, which include their numbers in the source,
// are added, so that this order does not count. Source: Bellare and Micciancio, "A new paradigm for
// collision-free hashing: incrementality at reduced cost", 1997 (AdHash).
void Beams::describe(HashInput& input) const {
  input.kind("structure: beams");
  input.number(characteristic_length());
  input.integer(beams_.size() + repeats_.size());
  Hash sum{};
  const auto add_beam = [&](const Beam& beam, uint32_t number) {
    HashInput one;
    one.integer(number);
    one.point(beam.a);
    one.point(beam.b);
    one.number(beam.radius_a);
    one.number(beam.radius_b);
    one.integer(static_cast<uint64_t>(beam.cap_a));
    one.integer(static_cast<uint64_t>(beam.cap_b));
    add(sum, one.finish());
  };
  for (size_t i = 0; i < beams_.size(); ++i) add_beam(beams_.at(i), numbers_[i]);
  for (const BeamRepeat& repeat : repeats_) add_beam(beams_.at(repeat.place), repeat.number);
  input.hash(sum);
}

}  // namespace msq

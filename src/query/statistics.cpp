// SPDX-License-Identifier: Apache-2.0
#include "query/statistics.h"

#include <algorithm>
#include <mutex>

#include "base/run_parts.h"
#include "query/membership.h"

namespace msq {

namespace {

/// A unit vector for each number, uniform over the sphere: Marsaglia, "Choosing a point from the
/// surface of a sphere", 1972. It uses only roots and products, so it is the same on every machine.
Vec3 random_direction(uint64_t key, uint64_t number) {
  const uint64_t stream = splitmix_finalise(key ^ splitmix_finalise(number));
  for (uint64_t n = 0;; n += 2) {
    const auto draw = [&](uint64_t i) {
      return static_cast<double>(splitmix_output(stream, i) >> 11) * 0x1p-52 - 1;
    };
    const double a = draw(n), b = draw(n + 1), square = a * a + b * b;
    if (square >= 1) continue;
    const double root = 2 * std::sqrt(1 - square);
    return {a * root, b * root, 1 - 2 * square};
  }
}

/// Differs from the stream of the points.
uint64_t direction_key(uint64_t seed) {
  return splitmix_finalise(splitmix_finalise(seed + 1) ^ 0x646972656374ULL);
}

Vec3 direction_of(const Segments& segments, uint64_t key, uint64_t number) {
  const bool is_fixed = dot(segments.direction, segments.direction) > 0;
  return is_fixed ? segments.direction : random_direction(key, number);
}

/// A part of the sample, and which of its points are in the phase.
struct AskedPart : PointSet::Part {
  std::vector<uint8_t> in_phase;
};

/// Sets 1 for the points that are in the phase.
void ask_phase(const StatisticsOf& of, const std::vector<Vec3>& points,
               std::vector<uint8_t>& in_phase, Job* job) {
  in_phase.resize(points.size());
  ask_points(of.model, of.resolved, of.plan, points.data(), in_phase.data(), points.size(), job);
  if (of.of_void)
    for (uint8_t& answer : in_phase) answer ^= 1;
}

/// Adds the strata of a part to a tally; hits[i] is 1 for hits.
void tally_strata(const std::vector<uint8_t>& hits, uint64_t per_cell, StrataTally& tally) {
  for (size_t first = 0; first < hits.size(); first += per_cell) {
    uint64_t count = 0;
    for (uint64_t s = 0; s < per_cell; ++s) count += hits[first + s];
    tally.add(count, per_cell);
  }
}

/// Calls tally_part(part, tallies) for all parts, in parallel, and sums their tallies.
template <class TallyPart>
std::vector<Estimate> estimate(const StatisticsOf& of, size_t count, Job* job,
                               TallyPart&& tally_part) {
  of.model.prepare_skins(of.resolved, job);
  std::vector<StrataTally> total(count);
  std::mutex mutex;
  run_parts(of.model.executor(), of.sample.parts(), job, {0, 1}, [&](uint64_t index) {
    AskedPart part;
    of.sample.read_part(index, part);
    ask_phase(of, part.positions, part.in_phase, job);
    std::vector<StrataTally> tallies(count);
    tally_part(part, tallies);
    const std::lock_guard lock(mutex);
    for (size_t i = 0; i < count; ++i) total[i].add(tallies[i]);
  });
  std::vector<Estimate> estimates;
  estimates.reserve(total.size());
  const Strata& strata = of.sample.strata();
  for (const StrataTally& tally : total)
    estimates.push_back(tally.estimate(strata.cells(), strata.per_cell));
  return estimates;
}

}  // namespace

Estimate volume_fraction(const StatisticsOf& of, Job* job) {
  return estimate(of, 1, job, [&](const AskedPart& part, std::vector<StrataTally>& tallies) {
    tally_strata(part.in_phase, of.sample.strata().per_cell, tallies[0]);
  })[0];
}

std::vector<Estimate> two_point_correlation(const StatisticsOf& of, const Segments& segments,
                                            Job* job) {
  const uint64_t key = direction_key(of.sample.strata().seed);
  return estimate(of, segments.lengths.size(), job,
                  [&](const AskedPart& part, std::vector<StrataTally>& tallies) {
                    // For segments that begin outside the phase, the other end does not matter.
                    std::vector<size_t> begun;
                    std::vector<Vec3> directions;
                    for (size_t i = 0; i < part.numbers.size(); ++i) {
                      if (!part.in_phase[i]) continue;
                      begun.push_back(i);
                      directions.push_back(direction_of(segments, key, part.numbers[i]));
                    }
                    std::vector<Vec3> ends(begun.size());
                    std::vector<uint8_t> in_phase, hits;
                    for (size_t l = 0; l < tallies.size(); ++l) {
                      check_cancelled(job);
                      for (size_t b = 0; b < begun.size(); ++b)
                        ends[b] = part.positions[begun[b]] + directions[b] * segments.lengths[l];
                      ask_phase(of, ends, in_phase, job);
                      hits.assign(part.numbers.size(), 0);
                      for (size_t b = 0; b < begun.size(); ++b) hits[begun[b]] = in_phase[b];
                      tally_strata(hits, of.sample.strata().per_cell, tallies[l]);
                    }
                  });
}

namespace {

/// The length over which a segment that begins in the phase stays in it, up to `most`; infinity if
/// it does not leave. The error of the end is at most 2^-10 of a step.
double path_length(const StatisticsOf& of, Vec3 from, Vec3 direction, double most, double step,
                   const Job* job) {
  const auto is_in = [&](double distance) { return (distance <= 0) != of.of_void; };
  double within = 0;
  JobPoll poll(job);
  // At most as many rounds as steps, which callers limit.
  for (double at = 0; within < most;) {
    poll();
    const double distance = of.model.distance(from + direction * at, of.resolved);
    if (!is_in(distance)) {
      for (int i = 0; i < 10; ++i) {
        const double middle = (within + at) / 2;
        const bool inside = of.model.inside(from + direction * middle, of.resolved);
        (inside != of.of_void ? within : at) = middle;
      }
      return at;
    }
    within = at;
    at = std::min(most, at + std::max(std::abs(distance), step));
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Estimate> lineal_path(const StatisticsOf& of, const Segments& segments, double step,
                                  Job* job) {
  const uint64_t key = direction_key(of.sample.strata().seed);
  of.model.shape().prepare_distance(job);
  const double most = *std::max_element(segments.lengths.begin(), segments.lengths.end());
  return estimate(of, segments.lengths.size(), job,
                  [&](const AskedPart& part, std::vector<StrataTally>& tallies) {
                    std::vector<double> paths(part.numbers.size(), -1);  // none
                    for (size_t i = 0; i < paths.size(); ++i) {
                      if (i % 64 == 0) check_cancelled(job);
                      if (!part.in_phase[i]) continue;
                      const Vec3 direction = direction_of(segments, key, part.numbers[i]);
                      paths[i] = path_length(of, part.positions[i], direction, most, step, job);
                    }
                    std::vector<uint8_t> hits(paths.size());
                    for (size_t l = 0; l < tallies.size(); ++l) {
                      for (size_t i = 0; i < paths.size(); ++i)
                        hits[i] = paths[i] > segments.lengths[l];
                      tally_strata(hits, of.sample.strata().per_cell, tallies[l]);
                    }
                  });
}

}  // namespace msq

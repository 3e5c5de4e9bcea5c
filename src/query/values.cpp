// SPDX-License-Identifier: Apache-2.0
#include "query/values.h"

#include <cmath>

#include "base/infinity.h"
#include "base/run_parts.h"

namespace msq {

namespace {

void count_points(Job* job, uint64_t count) {
  if (!job) return;
  job->counts().points += count;
  job->counts().by_point += count;
}

}  // namespace

// Of a function whose third derivative is about (2 pi)^3 of a cell, this leaves out 4e-9, and
// rounding adds 2e-11.
double gradient_step(const Structure& structure) {
  double smallest = infinity;
  structure.for_each_grid([&](const Neighbourhood& grid) {
    smallest = std::min(smallest, min_component(grid.cell_size));
  });
  return 0x1p-17 * smallest;
}

void set_onset(const Structure& structure, const PointSet& points, const OnsetPlan& plan,
               const Executor& executor, Job* job) {
  const double step = gradient_step(structure);
  const auto value = [&](Vec3 p) {
    const double onset = structure.onset(p);
    return plan.is_signed ? onset - structure.parameter(p) : onset;
  };
  run_parts(executor, points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    for (size_t i = 0; i < part.numbers.size(); ++i) {
      if (i % 16 == 0) check_cancelled(job);
      const Vec3 p = part.positions[i];
      plan.onsets[part.numbers[i]] = value(p);
      for (int axis = 0; plan.gradients && axis < 3; ++axis) {
        Vec3 before = p, beyond = p;
        before[axis] -= step;
        beyond[axis] += step;
        const double rise = value(beyond) - value(before);
        // No number where one of them is infinite or rounding leaves no step.
        const double slope = rise / (beyond[axis] - before[axis]);
        plan.gradients[3 * part.numbers[i] + static_cast<uint64_t>(axis)] =
            std::isfinite(slope) ? slope : 0;
      }
    }
    count_points(job, part.numbers.size());
  });
}

void set_field(const Field& field, const PointSet& points, double* values, const Executor& executor,
               Job* job) {
  run_parts(executor, points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    std::vector<double> found(part.positions.size());
    constexpr size_t at_once = 256;
    for (size_t i = 0; i < found.size(); i += at_once) {
      check_cancelled(job);
      field.values(part.positions.data() + i, std::min(at_once, found.size() - i),
                   found.data() + i);
    }
    for (size_t i = 0; i < found.size(); ++i) values[part.numbers[i]] = found[i];
    count_points(job, part.numbers.size());
  });
}

}  // namespace msq

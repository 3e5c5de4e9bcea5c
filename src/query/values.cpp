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
  // Points one after the other, each with those before and beyond it along each axis.
  const size_t per_point = plan.gradients ? 7 : 1;
  constexpr size_t at_once = 256;
  run_parts(executor, points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    std::vector<Vec3> queried;
    std::vector<double> found;
    for (size_t begin = 0; begin < part.numbers.size(); begin += at_once) {
      const size_t end = std::min(begin + at_once, part.numbers.size());
      queried.clear();
      for (size_t i = begin; i < end; ++i) {
        const Vec3 p = part.positions[i];
        queried.push_back(p);
        for (int axis = 0; plan.gradients && axis < 3; ++axis) {
          queried.insert(queried.end(), 2, p);
          queried.end()[-2][axis] -= step;
          queried.end()[-1][axis] += step;
        }
      }
      found.resize(queried.size());
      structure.onsets(queried.data(), queried.size(), found.data());
      for (size_t i = 0; plan.is_signed && i < queried.size(); ++i) {
        if (i % 16 == 0) check_cancelled(job);
        found[i] -= structure.parameter(queried[i]);
      }
      for (size_t i = begin; i < end; ++i) {
        const size_t first = (i - begin) * per_point;
        plan.onsets[part.numbers[i]] = found[first];
        for (size_t axis = 0; plan.gradients && axis < 3; ++axis) {
          const size_t before = first + 1 + 2 * axis, beyond = before + 1;
          const double rise = found[beyond] - found[before];
          const int along = static_cast<int>(axis);
          // No number where one of them is infinite or rounding leaves no step.
          const double slope = rise / (queried[beyond][along] - queried[before][along]);
          plan.gradients[3 * part.numbers[i] + axis] = std::isfinite(slope) ? slope : 0;
        }
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

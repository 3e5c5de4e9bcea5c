// SPDX-License-Identifier: Apache-2.0
#include "api/points.h"

#include "api/neighbourhood.h"
#include "api/window.h"
#include "query/array_points.h"
#include "query/first_point.h"
#include "query/grid_points.h"

namespace msq::api {

namespace {

void check_side(uint64_t count, int axis) {
  if (count < 1 || count > INT32_MAX)
    fail(Status::argument, "counts[%d] is %llu; it must be from 1 to %d", axis,
         static_cast<unsigned long long>(count), INT32_MAX);
}

SampleGrid read_grid(const msq_points_def& def) {
  SampleGrid grid;
  grid.origin = require_vector(def.origin, "origin");
  for (int axis = 0; axis < 3; ++axis) {
    grid.spacing[axis] = require_positive(def.spacing[axis], "spacing");
    check_side(def.counts[axis], axis);
    const double last = static_cast<double>(def.counts[axis] - 1);
    require_finite(grid.origin[axis] + last * grid.spacing[axis], "the last point's coordinate");
    const double step = grid.spacing[axis], origin = grid.origin[axis];
    if (last > 0 && (origin + step == origin || origin + last * step == origin + (last - 1) * step))
      fail(Status::argument, "spacing[%d] is %g; points %g away from 0 would coincide", axis, step,
           std::max(std::abs(origin), std::abs(origin + last * step)));
  }
  grid.nx = def.counts[0];
  grid.ny = def.counts[1];
  grid.nz = def.counts[2];
  grid = window_of(grid, read_window(def.window));
  checked_product(checked_product(grid.nx, grid.ny, "points"), grid.nz, "points");
  return grid;
}

void refuse_window(const msq_points_def& def, const char* kind) {
  if (!read_window(def.window).is_whole())
    fail(Status::argument, "a window is given; %s have none", kind);
}

}  // namespace

msq_points_def points_defaults() {
  msq_points_def def{};
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinate_type = MSQ_FLOAT64;
  def.per_cell = 1;
  for (int i = 0; i < 3; ++i) def.rotation[4 * i] = 1;
  return def;
}

msq_query_def query_defaults() {
  return {};
}

Strata read_strata(const msq_points_def& known) {
  Strata strata;
  refuse_window(known, "stratified samples");
  strata.origin = require_vector(known.origin, "origin");
  double far = max_magnitude(strata.origin);
  uint64_t points = known.per_cell;
  if (points < 1) fail(Status::argument, "per_cell is 0; it must be at least 1");
  for (int axis = 0; axis < 3; ++axis) {
    strata.cell_size[axis] = require_positive(known.spacing[axis], "spacing");
    check_side(known.counts[axis], axis);
    strata.counts[static_cast<size_t>(axis)] = known.counts[axis];
    points = checked_product(points, known.counts[axis], "points");
    far += static_cast<double>(known.counts[axis]) * strata.cell_size[axis];
  }
  require_finite(far, "the last cell's coordinate");
  strata.rotation = read_rotation(known.rotation, "rotation");
  strata.per_cell = known.per_cell;
  strata.seed = known.seed;
  return strata;
}

std::unique_ptr<PointSet> read_points(const msq_points_def* points) {
  const msq_points_def known = read_def(points, points_defaults(), "points");
  require_reserved(known.reserved, "reserved");
  require_reserved(known.reserved2, "reserved2");
  switch (require_range(known.kind, MSQ_POINTS_ARRAY, MSQ_POINTS_STRATIFIED, "kind")) {
    case MSQ_POINTS_GRID:
      return std::make_unique<GridPoints>(read_grid(known));
    case MSQ_POINTS_STRATIFIED:
      return std::make_unique<StratifiedPoints>(read_strata(known));
    default:
      refuse_window(known, "arrays of points");
      return std::make_unique<ArrayPoints>(point_array(known.coordinates, known.count, known.stride,
                                                       known.coordinate_type, "coordinates"));
  }
}

void require_apart(const msq_points_def* points, const void* output, uint64_t bytes,
                   const char* name) {
  const msq_points_def known = read_def(points, points_defaults(), "points");
  if (known.kind != MSQ_POINTS_ARRAY) return;
  require_apart(point_array(known.coordinates, known.count, known.stride, known.coordinate_type,
                            "coordinates"),
                "coordinates", output, bytes, name);
}

void require_finite_points(const PointSet& points, const Executor& executor) {
  if (!points.is_given()) return;
  const uint64_t first = find_first_point(points, executor, [](Vec3 p) { return !is_finite(p); });
  if (first == points.count()) return;
  Vec3 p;
  points.read(first, 1, &p);
  fail(Status::argument, "point %llu is (%g, %g, %g); it must be finite",
       static_cast<unsigned long long>(first), p.x, p.y, p.z);
}

Query read_query(const msq_query_def* query) {
  const msq_query_def known = query ? read_def(query, query_defaults(), "query") : query_defaults();
  Query read;
  read.length_scale = require_zero_or_more(known.length_scale, "length_scale");
  read.plan.method = static_cast<QueryMethod>(
      require_range(known.method, MSQ_QUERY_AUTO, MSQ_QUERY_SET, "method"));
  read.plan.critical_count = known.critical_count;
  constexpr uint32_t max_parts = 64;
  if (known.group_parts > max_parts)
    fail(Status::argument, "group_parts is %u; it must be at most %u", known.group_parts,
         max_parts);
  read.plan.group_parts = known.group_parts;
  require_reserved(known.reserved, "reserved");
  return read;
}

void require_count(uint64_t count, const char* name, uint64_t wanted) {
  if (count != wanted)
    fail(Status::argument, "%s is %llu; there are %llu points", name,
         static_cast<unsigned long long>(count), static_cast<unsigned long long>(wanted));
}

}  // namespace msq::api

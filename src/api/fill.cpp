// SPDX-License-Identifier: Apache-2.0
// Fill lines.
#include "fill/fill.h"

#include <cstring>

#include "api/guard.h"
#include "base/int128.h"
#include "base/working_memory.h"
#include "fill/line_density.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t max_points = uint64_t{1} << 31;  // of a polygon
/// What an error of the memory limit names.
constexpr char what_of_rings[] = "a polygon", what_of_lines[] = "the lines of walls in a plane";

msq_fill_def fill_defaults() {
  msq_fill_def def{};
  def.coordinate_type = MSQ_INT64;
  return def;
}

template <class Integer>
IntPoint read_point(const unsigned char* data) {
  Integer xy[2];
  std::memcpy(xy, data, sizeof xy);
  return {xy[0], xy[1]};
}

void require_coordinate(int64_t value, uint64_t ring, uint64_t point) {
  constexpr int64_t most = FillPolygon::max_coordinate;
  if (value < -most || value > most)
    fail(Status::limit, "point %llu of ring %llu has the coordinate %lld; the limit is 2^53, %lld",
         static_cast<unsigned long long>(point), static_cast<unsigned long long>(ring),
         static_cast<long long>(value), static_cast<long long>(most));
}

/// Whether all points are on one line. Coordinates are at most 2^53, so products have 109 bits.
bool is_flat(const CountedVector<IntPoint>& ring) {
  const IntPoint a = ring[0];
  IntPoint b = a;
  for (const IntPoint p : ring) {
    if (b == a) {
      b = p;
      continue;
    }
    if (static_cast<Int128>(b.x - a.x) * (p.y - a.y) !=
        static_cast<Int128>(b.y - a.y) * (p.x - a.x))
      return false;
  }
  return true;
}

FillPolygon::Rings read_rings(const msq_fill_def& def, bool is_int32) {
  if (def.ring_count == 0) fail(Status::argument, "ring_count is 0; it must be at least 1");
  require(def.rings, "rings");
  const uint64_t packed = is_int32 ? 8 : 16, stride = def.point_stride ? def.point_stride : packed;
  if (stride < packed)
    fail(Status::argument, "point_stride is %llu bytes; a point has %llu",
         static_cast<unsigned long long>(stride), static_cast<unsigned long long>(packed));
  FillPolygon::Rings rings;
  uint64_t total = 0;
  for (uint64_t r = 0; r < def.ring_count; ++r) {
    const msq_ring& given = def.rings[r];
    const auto index = static_cast<unsigned long long>(r);
    if (given.count < 3)
      fail(Status::argument, "ring %llu has %llu points; it must have at least 3", index,
           static_cast<unsigned long long>(given.count));
    if (!given.points) fail(Status::argument, "the points of ring %llu are NULL", index);
    if (given.count > max_points - total)
      fail(Status::limit, "the rings up to ring %llu have more than %llu points", index,
           static_cast<unsigned long long>(max_points));
    total += given.count;
    checked_product(given.count, stride, "the points of a ring");
    CountedVector<IntPoint> ring;
    ring.reserve(given.count);
    const auto* data = static_cast<const unsigned char*>(given.points);
    for (uint64_t i = 0; i < given.count; ++i, data += stride) {
      const IntPoint p = is_int32 ? read_point<int32_t>(data) : read_point<int64_t>(data);
      require_coordinate(p.x, r, i);
      require_coordinate(p.y, r, i);
      ring.push_back(p);
    }
    if (is_flat(ring)) fail(Status::argument, "the points of ring %llu are on one line", index);
    rings.push_back(std::move(ring));
  }
  return rings;
}

double smallest_cell_size(const Structure& structure) {
  double size = min_component(structure.neighbourhood().cell_size);
  structure.for_each_grid(
      [&](const Neighbourhood& grid) { size = std::min(size, min_component(grid.cell_size)); });
  return size;
}

/// A distance between lines or points, at most as wide as polygons are.
double read_distance(double distance, double scale, const char* name) {
  constexpr double most = 0x1p54;
  if (!(require_not_negative(distance, name) / scale <= most))
    fail(Status::argument, "%s is %g, %g units of the coordinates; the limit is %g", name, distance,
         distance / scale, most);
  return distance;
}

FillPlan read_plan(const msq_fill_def& def, const Structure& structure) {
  FillPlan plan;
  const int32_t type = require_range(def.coordinate_type, MSQ_INT32, MSQ_INT64, "coordinate_type");
  plan.is_int32 = type == MSQ_INT32;
  plan.rings = read_rings(def, plan.is_int32);
  plan.scale = require_positive(def.scale, "scale");
  if (!(plan.scale >= 1e-100 && plan.scale <= 1e75))
    fail(Status::argument, "scale is %g; it must be from 1e-100 to 1e75", plan.scale);
  plan.origin = {require_finite(def.origin[0], "origin"), require_finite(def.origin[1], "origin")};
  plan.z = require_finite(def.z, "z");
  plan.tolerance = require_not_negative(def.tolerance, "tolerance");
  if (plan.tolerance == 0) plan.tolerance = smallest_cell_size(structure) / 200;
  // Lines are rounded to the coordinates.
  plan.tolerance = std::max(plan.tolerance, 0.5 * plan.scale);
  plan.min_length = require_not_negative(def.min_length, "min_length");
  plan.pair_distance = read_distance(def.pair_distance, plan.scale, "pair_distance");
  plan.corner_distance = read_distance(def.corner_distance, plan.scale, "corner_distance");
  return plan;
}

}  // namespace

msq_status msq_fill_def_init(msq_fill_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, fill_defaults(), "msq_fill_def"); });
}

msq_status msq_fill_lines(msq_context* context, const msq_structure* structure,
                          const msq_fill_def* def, msq_fill** fill, msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Structure& known = object(structure, "structure");
    const Ref<const Structure> keep(&known);
    const Ref<Context> keep_owner(&owner);
    require(fill, "fill");
    WorkingMemory working(*owner.budget, what_of_rings);
    const FillPlan plan = read_plan(read_def(def, fill_defaults(), "def"), known);
    working.call_it(what_of_lines);
    JobScope scope(job ? &object(job, "job") : nullptr);
    Ref<Fill> made = make_ref<Fill>(owner, known, plan);
    scope.done();
    *fill = new_handle<msq_fill>(std::move(made));
  });
}

void msq_fill_retain(msq_fill* fill) {
  retain(fill);
}
void msq_fill_release(msq_fill* fill) {
  release(fill);
}

msq_status msq_fill_info(const msq_fill* fill, msq_fill_report* report) {
  return guard([&] {
    const Fill& known = object(fill, "fill");
    msq_fill_report found{};
    found.coordinate_type = known.is_int32() ? MSQ_INT32 : MSQ_INT64;
    found.points = known.points();
    found.point_count = known.point_count();
    found.path_starts = known.starts().data();
    found.closed = known.closed().data();
    found.path_count = known.closed().size();
    found.length = known.length();
    found.travel = known.travel();
    write_report(report, found, "report");
  });
}

msq_status msq_fill_calibrate(msq_context* context, const msq_structure* structure,
                              double line_width, double density, double cell_size[3],
                              msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Structure& known = object(structure, "structure");
    const Ref<const Structure> keep(&known);
    const Ref<Context> keep_owner(&owner);
    require_positive(line_width, "line_width");
    if (!(density > 0 && density <= 1))
      fail(Status::argument, "density is %g; it must be above 0 and at most 1", density);
    require(cell_size, "cell_size");
    JobScope scope(job ? &object(job, "job") : nullptr);
    WorkingMemory working(*owner.budget, what_of_lines);
    const double factor = mean_line_density(known) * line_width / density;
    const Vec3 sizes = known.neighbourhood().cell_size * factor;
    if (!(min_component(sizes) >= 1e-75 && max_component(sizes) <= 1e75))
      fail(Status::limit, "cells would be from %g to %g wide; they must be from 1e-75 to 1e75",
           min_component(sizes), max_component(sizes));
    scope.done();
    for (int axis = 0; axis < 3; ++axis) cell_size[axis] = sizes[axis];
  });
}

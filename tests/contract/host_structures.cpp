// SPDX-License-Identifier: Apache-2.0
#include "host_structures.h"

#include "msq_test.h"
#include "structure/host/host_function.h"
#include "structure/host/host_structure.h"
#include "structure/lattice/lattice.h"

namespace msq::test {

namespace {

HostStructureCalls copying_calls(Ref<const Structure> copied, bool by_cell) {
  const Neighbourhood grid = copied->neighbourhood();
  const auto ask = [=](const HostPoints& points, uint8_t* inside) {
    assert_in_range(points.count, 1, host_batch);
    for (size_t i = 0; i < points.count; ++i) {
      const Neighbourhood::Located located = grid.locate(points.points[i]);
      assert_true(located.cell == points.cells[i]);
      assert_true(located.fraction * grid.cell_size == points.positions[i]);
      inside[i] = copied->inside(points.points[i]) ? static_cast<uint8_t>(1 + i % 255) : 0;
    }
  };
  HostStructureCalls calls;
  calls.distance = [=](const HostPoints& points, double* bounds) {
    for (size_t i = 0; i < points.count; ++i)
      bounds[i] = copied->distance_bound(points.points[i]) * (i % 2 ? 1 : -1);
  };
  if (!by_cell) {
    calls.inside = ask;
    return calls;
  }
  calls.build_cell = [](CellIndex cell, uint64_t& bytes) -> void* {
    bytes = sizeof cell;
    return new CellIndex(cell);
  };
  calls.evaluate_cell = [=](const void* data, const HostPoints& points, uint8_t* inside) {
    for (size_t i = 0; i < points.count; ++i)
      assert_true(*static_cast<const CellIndex*>(data) == points.cells[i]);
    ask(points, inside);
  };
  calls.free_cell = [](void* data) { delete static_cast<CellIndex*>(data); };
  calls.classify = [=](const Box3& box) {
    const Vec3 middle = (box.min + box.max) * 0.5;
    if (!(copied->distance_bound(middle) > 0.5 * length(box.extent()) * (1 + 1e-9)))
      return BoxClass::mixed;
    return copied->inside(middle) ? BoxClass::inside : BoxClass::outside;
  };
  return calls;
}

}  // namespace

Ref<const Structure> make_copy(Ref<Context> context, const UnitCell& cell,
                               const Neighbourhood& grid, Parameter radius, bool by_cell) {
  return make_ref<HostStructure>(
      std::move(context), grid,
      copying_calls(make_ref<Lattice>(grid, cell, std::move(radius)), by_cell), true);
}

Ref<const Structure> make_host_gyroid(const Neighbourhood& grid, Parameter level, bool is_sheet,
                                      bool has_range, double lipschitz) {
  const auto gyroid = [](Vec3 a) {
    return std::sin(a.x) * std::cos(a.y) + std::sin(a.y) * std::cos(a.z) +
           std::sin(a.z) * std::cos(a.x);
  };
  HostFunctionCalls calls;
  calls.evaluate = [=](const Vec3* angles, size_t count, double* values) {
    assert_in_range(count, 1, host_batch);
    for (size_t i = 0; i < count; ++i) {
      assert_true(max_magnitude(angles[i] - Vec3{3.15, 3.15, 3.15}) < 3.16);
      values[i] = gyroid(angles[i]);
    }
  };
  if (has_range)
    calls.range = [=](const Box3& box) {
      const Vec3 size = box.extent();
      const double middle = gyroid((box.min + box.max) * 0.5), off = size.x + size.y + size.z;
      return Interval{middle - off, middle + off};
    };
  return make_ref<HostFunction>(grid, calls, is_sheet, std::move(level), has_range ? 12 : 0,
                                lipschitz, true);
}

}  // namespace msq::test

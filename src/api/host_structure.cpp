// SPDX-License-Identifier: Apache-2.0
#include "structure/host/host_structure.h"

#include "api/host.h"
#include "api/level.h"
#include "api/neighbourhood.h"
#include "structure/host/host_function.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_host_structure_def host_structure_defaults() {
  msq_host_structure_def def{};
  def.grid = neighbourhood_defaults();
  return def;
}

msq_host_function_def host_function_defaults() {
  msq_host_function_def def{};
  def.kind = MSQ_FUNCTIONAL_NETWORK;
  def.grid = neighbourhood_defaults();
  def.lipschitz = std::numeric_limits<double>::infinity();
  return def;
}

msq_host_points view_of(const HostPoints& points) {
  msq_host_points view{};
  view.struct_size = sizeof view;
  view.count = points.count;
  view.points = coordinates(points.points);
  view.positions = coordinates(points.positions);
  view.cells = &points.cells->x;
  return view;
}

BoxClass classify_box(int32_t answer) {
  switch (answer) {
    case MSQ_BOX_MIXED:
      return BoxClass::mixed;
    case MSQ_BOX_OUTSIDE:
      return BoxClass::outside;
    case MSQ_BOX_INSIDE:
      return BoxClass::inside;
    default:
      fail(Status::host, "the callback box answered %d; it must be from %d to %d", answer,
           MSQ_BOX_MIXED, MSQ_BOX_INSIDE);
  }
}

HostStructureCalls calls_of(const msq_host_structure_def& def) {
  HostStructureCalls calls;
  void* const user = def.user;
  if (def.inside)
    calls.inside = [user, fn = def.inside](const HostPoints& points, uint8_t* inside) {
      const msq_host_points view = view_of(points);
      std::fill_n(inside, points.count, uint8_t{0});
      check_code(call_host(fn, user, &view, inside), "inside");
    };
  if (def.build_cell) {
    calls.build_cell = [user, fn = def.build_cell](CellIndex cell, uint64_t& bytes) {
      void* data = nullptr;
      check_code(call_host(fn, user, &cell.x, &data, &bytes), "build_cell");
      return data;
    };
    calls.evaluate_cell = [user, fn = def.evaluate_cell](const void* data, const HostPoints& points,
                                                         uint8_t* inside) {
      const msq_host_points view = view_of(points);
      std::fill_n(inside, points.count, uint8_t{0});
      check_code(call_host(fn, user, data, &view, inside), "evaluate_cell");
    };
  }
  if (def.free_cell)
    calls.free_cell = [user, fn = def.free_cell](void* data) { call_host(fn, user, data); };
  if (def.box)
    calls.classify = [user, fn = def.box](const Box3& box) {
      int32_t answer = MSQ_BOX_MIXED;
      check_code(call_host(fn, user, &box.min.x, &box.max.x, &answer), "box");
      return classify_box(answer);
    };
  if (def.distance)
    calls.distance = [user, fn = def.distance](const HostPoints& points, double* bounds) {
      const msq_host_points view = view_of(points);
      std::fill_n(bounds, points.count, std::numeric_limits<double>::quiet_NaN());
      check_code(call_host(fn, user, &view, bounds), "distance");
    };
  return calls;
}

}  // namespace

msq_status msq_host_structure_def_init(msq_host_structure_def* def, size_t size) {
  return guard(
      [&] { set_defaults(def, size, host_structure_defaults(), "msq_host_structure_def"); });
}

msq_status msq_structure_host(msq_context* context, const msq_host_structure_def* def,
                              msq_structure** structure) {
  return guard([&] {
    Context& owner = object(context, "context");
    require(structure, "structure");
    const msq_host_structure_def known = read_def(def, host_structure_defaults(), "def");
    const bool is_concurrent = require_range(known.concurrent, 0, 1, "concurrent") != 0;
    const Neighbourhood grid = read_neighbourhood(known.grid);
    if (!known.build_cell != !known.evaluate_cell)
      fail(Status::argument, "%s is NULL; build_cell and evaluate_cell belong together",
           known.build_cell ? "evaluate_cell" : "build_cell");
    if (known.free_cell && !known.build_cell)
      fail(Status::argument, "free_cell is given, but build_cell is NULL");
    if (!known.inside && !known.build_cell)
      fail(Status::argument, "inside and build_cell are NULL; one must be there");
    Ref<HostStructure> made =
        make_ref<HostStructure>(Ref<Context>(&owner), grid, calls_of(known), is_concurrent);
    made->user().set_key(known.hash_key);
    made->user().own(known.user, known.release);
    *structure = new_handle<msq_structure>(Ref<Structure>(std::move(made)));
  });
}

msq_status msq_host_function_def_init(msq_host_function_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, host_function_defaults(), "msq_host_function_def"); });
}

msq_status msq_structure_host_function(msq_context* context, const msq_host_function_def* def,
                                       msq_structure** structure) {
  return guard([&] {
    object(context, "context");
    require(structure, "structure");
    const msq_host_function_def known = read_def(def, host_function_defaults(), "def");
    const bool is_concurrent = require_range(known.concurrent, 0, 1, "concurrent") != 0;
    const Neighbourhood grid = read_neighbourhood(known.grid);
    require_range(known.kind, MSQ_FUNCTIONAL_NETWORK, MSQ_FUNCTIONAL_SHEET, "kind");
    if (known.clusters > uint32_t{max_clusters})
      fail(Status::argument, "clusters is %u; it must be from 0 to %d", known.clusters,
           max_clusters);
    if (!known.evaluate) fail(Status::argument, "evaluate is NULL");
    Ref<HostFunction> made = make_ref<HostFunction>(
        grid,
        HostFunctionCalls{values_call(known.evaluate, known.user, "evaluate"),
                          range_call(known.range, known.user, "range")},
        known.kind == MSQ_FUNCTIONAL_SHEET, read_level(known.level, known.kind),
        static_cast<int>(known.clusters), require_zero_or_more(known.lipschitz, "lipschitz"),
        is_concurrent);
    made->user().set_key(known.hash_key);
    made->user().own(known.user, known.release);
    *structure = new_handle<msq_structure>(Ref<Structure>(std::move(made)));
  });
}

// SPDX-License-Identifier: Apache-2.0
// All methods of a foam give the same bits at the same samples: POINT (one by one), METHOD_2 where
// there is CGAL, DIRECT. Above a jitter of 0.01 no sample may differ; below, where seeds lie so
// nearly on spheres that rounding decides, none farther than 1e-9 from the boundary. The number is
// printed.
#include "bit_rows.h"
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct FoamRow {
  std::string name;
  double jitter, radius;
  Vec3 cell_size;
};

std::vector<FoamRow> foam_rows() {
  std::vector<FoamRow> rows;
  for (double jitter : {1.0, 0.5, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 0.0})
    for (double radius : {0.05, 0.26, 0.5})
      for (Vec3 size : {Vec3{1, 1, 1}, Vec3{1, 1, 0.5}}) {
        char name[64];
        std::snprintf(name, sizeof name, "jitter %g r %g%s", jitter, radius,
                      size.z == 1 ? "" : ", uneven cells");
        rows.push_back({name, jitter, radius, size});
      }
  return rows;
}

Ref<const Structure> make_foam(const FoamRow& row, double radius, FoamMethod method) {
  Neighbourhood grid;
  grid.cell_size = row.cell_size;
  return make_ref<Foam>(shared_context(), grid, Parameter(radius), row.jitter, uint64_t{99},
                        method);
}

void test_row(void** state) {
  const FoamRow& row = *static_cast<const FoamRow*>(*state);
  std::vector<Ref<const Structure>> methods = {make_foam(row, row.radius, FoamMethod::direct)};
  if (can_triangulate()) methods.push_back(make_foam(row, row.radius, FoamMethod::method_2));
  const Ref<const Structure> point = make_foam(row, row.radius, FoamMethod::point);
  const Ref<const Structure> thinner = make_foam(row, row.radius - 1e-9, FoamMethod::point);
  const Ref<const Structure> thicker = make_foam(row, row.radius + 1e-9, FoamMethod::point);
  Random random(5);
  size_t count = 0, near = 0, differ = 0;
  for (bool on_borders : {true, false}) {
    // Two cells each way, from a corner of cells.
    const double across = std::max(3.0, std::floor(std::cbrt(6000 * std::min(1.0, test_scale()))));
    SampleGrid grid;
    grid.spacing = row.cell_size * (2 / (on_borders ? across - 1 : across));
    grid.origin = row.cell_size * Vec3{-1, 0, -1};
    if (!on_borders) grid.origin = grid.origin + grid.spacing * random.in_box({{}, {1, 1, 1}});
    grid.nx = grid.ny = grid.nz = static_cast<uint64_t>(across);
    for (const auto& method : methods) {
      BitRows rows(grid);
      for (uint64_t k = 0; k < grid.nz; ++k)
        for (uint64_t j = 0; j < grid.ny; ++j) set_bits(rows.block().row(j, k), 0, grid.nx - 1);
      method->keep_rows(rows.block(), nullptr);
      for (uint64_t k = 0; k < grid.nz; ++k)
        for (uint64_t j = 0; j < grid.ny; ++j)
          for (uint64_t i = 0; i < grid.nx; ++i) {
            const Vec3 p = grid.at(i, j, k);
            ++count;
            const bool is_inside = point->inside(p);
            if (rows.get(i, j, k) == is_inside) continue;
            if (row.jitter < 0.01 && !thinner->inside(p) && thicker->inside(p)) {
              ++near;
              continue;
            }
            if (!differ++)
              print_error("(%.17g, %.17g, %.17g): POINT %d, %s %d\n", p.x, p.y, p.z, is_inside,
                          method.get() == methods[0].get() ? "DIRECT" : "METHOD_2", !is_inside);
          }
    }
  }
  print_message("%zu samples, %zu differ within 1e-9 of the boundary, %zu elsewhere\n", count, near,
                differ);
  if (differ) fail_msg("%zu of %zu samples differ", differ, count);
}

}  // namespace

int main() {
  std::vector<FoamRow> rows = foam_rows();
  return run_for_each("foam methods", rows, test_row);
}

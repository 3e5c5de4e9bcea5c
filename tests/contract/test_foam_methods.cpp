// SPDX-License-Identifier: Apache-2.0
// All methods of a foam give the bits of the definition at the same samples. METHOD_2, where there
// is CGAL, may differ below a jitter of 0.01, where seeds lie so nearly on spheres that rounding
// decides, but not farther than 1e-9 from the boundary. The number is printed.
#include "bit_rows.h"
#include "random.h"
#include "structure/foam/paper/delaunay.h"
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
    for (double radius : {0.05, 0.26, 0.5, 0.9})
      for (Vec3 size : {Vec3{1, 1, 1}, Vec3{1, 1, 0.5}}) {
        if (radius > 0.5 && (size.z < 1 || jitter != 1)) continue;
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

struct Method {
  const char* name;
  FoamMethod method;
  uint64_t step;  // samples, of which one is asked: points may be dear
  bool may_differ;
  size_t near, differ;
};

std::vector<Method> foam_methods(const FoamRow& row) {
  const uint64_t dear = row.radius < 0.3 ? 211 : row.radius < 0.6 ? 2003 : 6007;
  std::vector<Method> methods = {
      {"DIRECT", FoamMethod::direct, 1, false, 0, 0},
      {"METHOD_1", FoamMethod::method_1, row.radius < 0.5 ? 1u : 11u, false, 0, 0},
      {"POINT", FoamMethod::point, dear, false, 0, 0}};
  if (can_triangulate())
    methods.push_back({"METHOD_2", FoamMethod::method_2, 1, row.jitter < 0.01, 0, 0});
  return methods;
}

void test_row(void** state) {
  const FoamRow& row = *static_cast<const FoamRow*>(*state);
  const Ref<const Structure> defined = make_foam(row, row.radius, FoamMethod::direct);
  const Ref<const Structure> thinner = make_foam(row, row.radius - 1e-9, FoamMethod::direct);
  const Ref<const Structure> thicker = make_foam(row, row.radius + 1e-9, FoamMethod::direct);
  std::vector<Method> methods = foam_methods(row);
  Random random(5);
  size_t count = 0;
  for (bool on_borders : {true, false}) {
    // Two cells each way, from a corner of cells.
    const double most = row.radius > 0.5 ? 300 : 6000;
    const double across = std::max(3.0, std::floor(std::cbrt(most * std::min(1.0, test_scale()))));
    SampleGrid grid;
    grid.spacing = row.cell_size * (2 / (on_borders ? across - 1 : across));
    grid.origin = row.cell_size * Vec3{-1, 0, -1};
    if (!on_borders) grid.origin = grid.origin + grid.spacing * random.in_box({{}, {1, 1, 1}});
    grid.nx = grid.ny = grid.nz = static_cast<uint64_t>(across);
    for (Method& method : methods) {
      const auto foam = make_foam(row, row.radius, method.method);
      BitRows rows(grid);
      const auto for_each_asked = [&](auto&& visit) {
        for (uint64_t n = 0; n < grid.nx * grid.ny * grid.nz; n += method.step)
          visit(n % grid.nx, n / grid.nx % grid.ny, n / grid.nx / grid.ny);
      };
      for_each_asked([&](uint64_t i, uint64_t j, uint64_t k) { rows.set(i, j, k); });
      foam->keep_rows(rows.block(), nullptr);
      for_each_asked([&](uint64_t i, uint64_t j, uint64_t k) {
        const Vec3 p = grid.at(i, j, k);
        ++count;
        const bool is_inside = defined->inside(p);
        if (rows.get(i, j, k) == is_inside) return;
        if (method.may_differ && !thinner->inside(p) && thicker->inside(p)) {
          ++method.near;
          return;
        }
        if (!method.differ++)
          print_error("(%.17g, %.17g, %.17g): by definition %d, %s %d\n", p.x, p.y, p.z, is_inside,
                      method.name, !is_inside);
      });
    }
  }
  size_t differ = 0;
  for (const Method& method : methods) {
    differ += method.differ;
    if (method.near || method.differ)
      print_message("%s: %zu samples differ within 1e-9 of the boundary, %zu elsewhere\n",
                    method.name, method.near, method.differ);
  }
  if (differ) fail_msg("%zu of %zu samples differ", differ, count);
}

}  // namespace

int main() {
  std::vector<FoamRow> rows = foam_rows();
  return run_for_each("foam methods", rows, test_row);
}

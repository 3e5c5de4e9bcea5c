// SPDX-License-Identifier: Apache-2.0
#include "api/neighbourhood.h"

#include "api/guard.h"
#include "shape/placement.h"

namespace msq::api {

namespace {

/// The rotation next to a matrix that is one within 1e-9: two Newton steps R (3 I - R^T R) / 2
/// towards the orthogonal polar factor (Higham 1986), after which R^T is its inverse to the last
/// bits. Exact rotations stay as they are.
Rotation nearest_rotation(Rotation r) {
  for (int step = 0; step < 2; ++step) {
    Rotation next;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
          double product = 0;  // (R^T R) at k, j
          for (int l = 0; l < 3; ++l) product += r.m[3 * l + k] * r.m[3 * l + j];
          sum += r.m[3 * i + k] * ((k == j ? 3.0 : 0.0) - product);
        }
        next.m[3 * i + j] = 0.5 * sum;
      }
    r = next;
  }
  return r;
}

}  // namespace

msq_neighbourhood neighbourhood_defaults() {
  msq_neighbourhood grid{};
  for (int i = 0; i < 3; ++i) {
    grid.cell_size[i] = 1;
    grid.rotation[4 * i] = 1;
  }
  return grid;
}

Rotation read_rotation(const double (&matrix)[9], const char* name) {
  Rotation read;
  for (size_t i = 0; i < 9; ++i) read.m[i] = require_finite(matrix[i], name);
  const auto& m = read.m;
  const Vec3 rows[3] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double product = dot(rows[i], rows[j]), wanted = i == j;
      if (!(std::abs(product - wanted) <= 1e-9))
        fail(Status::argument,
             "rows %d and %d of %s have product %.17g; a rotation has %g within 1e-9", i, j, name,
             product, wanted);
    }
  if (dot(rows[0], cross(rows[1], rows[2])) < 0)
    fail(Status::argument, "%s mirrors; its determinant must be +1", name);
  return nearest_rotation(read);
}

Neighbourhood read_neighbourhood(const msq_neighbourhood& grid) {
  Neighbourhood read;
  read.origin = require_vector(grid.origin, "grid.origin");
  for (int i = 0; i < 3; ++i) {
    require_positive(grid.cell_size[i], "grid.cell_size");
    // Fourth powers of lengths neither overflow nor vanish.
    if (grid.cell_size[i] < 1e-75 || grid.cell_size[i] > 1e75)
      fail(Status::argument, "grid.cell_size[%d] is %g; it must be from 1e-75 to 1e75", i,
           grid.cell_size[i]);
  }
  read.cell_size = {grid.cell_size[0], grid.cell_size[1], grid.cell_size[2]};
  read.rotation = read_rotation(grid.rotation, "grid.rotation");
  return read;
}

void require_proportions(const Neighbourhood& grid) {
  constexpr double most = 1 << 20;
  const double ratio = max_component(grid.cell_size) / min_component(grid.cell_size);
  if (ratio > most)
    fail(Status::limit, "cell sizes of a lattice differ by %g times; the limit is %.0f", ratio,
         most);
}

}  // namespace msq::api

using namespace msq;
using namespace msq::api;

msq_status msq_neighbourhood_placed(const msq_neighbourhood* grid, const double matrix[12],
                                    msq_neighbourhood* placed) {
  return guard([&] {
    const Neighbourhood known = read_neighbourhood(require(grid, "grid"));
    if (!matrix) fail(Status::argument, "matrix is NULL");
    require(placed, "placed");
    std::array<double, 12> numbers;
    std::copy_n(matrix, numbers.size(), numbers.begin());
    const Placement placement(numbers);
    constexpr double max_deviation = 1e-9;
    if (!(placement.deviation() <= max_deviation))
      fail(Status::argument,
           "the matrix stretches lengths in some directions more than in others, by %g; the limit "
           "for a grid is %g",
           placement.deviation(), max_deviation);
    if (placement.determinant() < 0)
      fail(Status::argument,
           "the matrix mirrors: its determinant is %g; that of a grid's must be positive",
           placement.determinant());
    msq_neighbourhood result;
    const Vec3 origin = placement.to_placed(known.origin);
    double rotation[9];
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) {
        double sum = 0;
        for (size_t k = 0; k < 3; ++k) sum += matrix[4 * i + k] * known.rotation.m[3 * k + j];
        rotation[3 * i + j] = sum / placement.scale();
      }
    const Rotation turned = read_rotation(rotation, "matrix");
    for (int axis = 0; axis < 3; ++axis) {
      result.origin[axis] = origin[axis];
      result.cell_size[axis] = known.cell_size[axis] * placement.scale();
    }
    std::copy(turned.m.begin(), turned.m.end(), result.rotation);
    read_neighbourhood(result);
    *placed = result;
  });
}

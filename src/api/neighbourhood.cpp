// SPDX-License-Identifier: Apache-2.0
#include "api/neighbourhood.h"

#include "api/guard.h"

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
    if (grid.cell_size[i] < 1e-100 || grid.cell_size[i] > 1e100)
      fail(Status::argument, "grid.cell_size[%d] is %g; it must be from 1e-100 to 1e100", i,
           grid.cell_size[i]);
  }
  read.cell_size = {grid.cell_size[0], grid.cell_size[1], grid.cell_size[2]};
  read.rotation = read_rotation(grid.rotation, "grid.rotation");
  return read;
}

}  // namespace msq::api

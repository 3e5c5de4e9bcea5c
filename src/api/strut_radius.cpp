// SPDX-License-Identifier: Apache-2.0
#include "api/strut_radius.h"

#include "api/guard.h"

namespace msq::api {

Parameter read_radius(const msq_param& radius, const Neighbourhood& grid, double max_cells,
                      double max_factor) {
  Parameter read;
  if (radius.field) {
    read = Parameter(Ref<const Field>(&object(radius.field, "radius.field")));
    const Interval range = read.range();
    if (!(range.low >= 0) || !(range.high > 0))
      fail(Status::argument,
           "the field of radius runs from %g to %g; it must not be negative, nor 0 everywhere",
           range.low, range.high);
  } else {
    read = Parameter(require_positive(radius.value, "radius"));
  }
  const double most = max_cells * min_component(grid.cell_size);
  const double reached = max_factor * read.range().high;
  if (reached > most)
    fail(Status::limit, "radius%s reaches %g; the limit is %g (%g times the smallest cell size)",
         max_factor == 1 ? "" : " times the greatest strut factor", reached, most, max_cells);
  return read;
}

}  // namespace msq::api

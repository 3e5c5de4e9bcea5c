// SPDX-License-Identifier: Apache-2.0
#include "base/sample_grid.h"

#include "base/status.h"

namespace msq {

SampleGrid window_of(const SampleGrid& whole, const SampleWindow& window) {
  if (window.is_whole()) return whole;
  const uint64_t counts[3] = {whole.nx, whole.ny, whole.nz};
  for (size_t axis = 0; axis < 3; ++axis) {
    const uint64_t first = window.first[axis], count = window.count[axis];
    const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
    if (count == 0) fail(Status::argument, "window.count[%zu] is 0; it must be at least 1", axis);
    if (first >= counts[axis] || count > counts[axis] - first)
      fail(Status::argument,
           "the window has %llu samples from %llu on along axis %zu; the grid has %llu",
           number(count), number(first), axis, number(counts[axis]));
  }
  SampleGrid part = whole;
  part.first = window.first;
  part.nx = window.count[0];
  part.ny = window.count[1];
  part.nz = window.count[2];
  return part;
}

}  // namespace msq

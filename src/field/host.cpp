// SPDX-License-Identifier: Apache-2.0
#include "field/host.h"

namespace msq {

HostField::HostField(HostFieldCalls calls, Interval range, double lipschitz, bool is_concurrent)
    : calls_(std::move(calls)),
      range_(range),
      lipschitz_(lipschitz),
      is_concurrent_(is_concurrent) {}

double HostField::at(Vec3 p) const {
  double value;
  values(&p, 1, &value);
  return value;
}

void HostField::values(const Vec3* points, size_t count, double* values) const {
  for (size_t first = 0; first < count; first += host_batch)
    calls_.evaluate(points + first, std::min(host_batch, count - first), values + first);
  for (size_t i = 0; i < count; ++i)
    if (!(values[i] >= range_.low && values[i] <= range_.high))
      fail(Status::host,
           "the host's field has the value %.17g at (%g, %g, %g); its range is %g to %g", values[i],
           points[i].x, points[i].y, points[i].z, range_.low, range_.high);
}

Interval HostField::range(const Box3& box) const {
  Interval range = range_;
  if (calls_.range) {
    const Interval own = calls_.range(box);
    if (!(own.low <= own.high && own.low <= range_.high && own.high >= range_.low))
      fail(Status::host,
           "the host's field has the range %.17g to %.17g from (%g, %g, %g) to (%g, %g, %g); "
           "everywhere it is %g to %g",
           own.low, own.high, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z,
           range_.low, range_.high);
    range = {std::max(range.low, own.low), std::min(range.high, own.high)};
  }
  if (std::isfinite(lipschitz_)) {
    const double middle = at((box.min + box.max) * 0.5);
    // The products and the middle have a far smaller rounding error.
    const double reach = lipschitz_ * (0.5 * length(box.extent()) * (1 + 0x1p-40) +
                                       0x1p-40 * (max_magnitude(box.min) + max_magnitude(box.max)));
    const double slack = reach + 0x1p-40 * std::abs(middle);
    range = {std::max(range.low, middle - slack), std::min(range.high, middle + slack)};
    // The two contradict each other if the host's claims are wrong.
    if (range.low > range.high) std::swap(range.low, range.high);
  }
  return range;
}

void HostField::describe(HashInput& input) const {
  input.kind("field: host");
  user_.describe(input, "field");
  input.number(range_.low);
  input.number(range_.high);
  input.number(lipschitz_);
}

}  // namespace msq

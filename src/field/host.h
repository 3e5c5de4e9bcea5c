// SPDX-License-Identifier: Apache-2.0
// A field that the host computes. The host gives its range, and values beyond the range are errors:
// a structure with the field has room only for that range.
#pragma once

#include <functional>

#include "base/host.h"
#include "field/field.h"

namespace msq {

struct HostFieldCalls {
  /// The values of points. The value of a point does not depend on the other points.
  std::function<void(const Vec3* points, size_t count, double* values)> evaluate;
  /// Encloses the values of a box; may be empty.
  std::function<Interval(const Box3& box)> range;
};

class HostField final : public Field {
 public:
  /// `lipschitz`: infinite if unknown.
  HostField(HostFieldCalls calls, Interval range, double lipschitz, bool is_concurrent);

  double at(Vec3 p) const override;
  void values(const Vec3* points, size_t count, double* values) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  Interval range() const override { return range_; }
  /// By the host's own enclosure, and by its Lipschitz constant about the middle.
  Interval range(const Box3& box) const override;
  double lipschitz() const override { return lipschitz_; }

  HostUser& user() { return user_; }

 private:
  void describe(HashInput& input) const override;
  HostUser user_;
  HostFieldCalls calls_;
  Interval range_;
  double lipschitz_;
  bool is_concurrent_;
};

}  // namespace msq

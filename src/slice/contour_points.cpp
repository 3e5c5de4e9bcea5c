// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_points.h"

#include "query/array_points.h"
#include "query/membership.h"

namespace msq {

const std::vector<uint8_t>& ContourPoints::find_inside() {
  check_cancelled(job_);
  inside_.resize(points_.size());
  if (!struts_) {
    asked_.clear();
    for (const Vec2 p : points_) asked_.push_back(plane_.at(p.x, p.y));
    ask(resolved_, inside_);
    return inside_;
  }
  held_.clear();
  doubtful_.clear();
  CancelPoll poll(job_);
  for (size_t i = 0; i < points_.size(); ++i) {
    poll();
    const PlaneStruts::Found found = struts_->find(points_[i]);
    inside_[i] = 0;
    if (found == PlaneStruts::Found::inside) held_.push_back(static_cast<uint32_t>(i));
    if (found == PlaneStruts::Found::doubtful) doubtful_.push_back(static_cast<uint32_t>(i));
  }
  ask_some(held_, {});  // the shape
  ask_some(doubtful_, resolved_);
  return inside_;
}

void ContourPoints::ask_some(const std::vector<uint32_t>& some, const Scales& scales) {
  asked_.clear();
  for (const uint32_t i : some) asked_.push_back(plane_.at(points_[i].x, points_[i].y));
  answers_.resize(some.size());
  ask(scales, answers_);
  for (size_t n = 0; n < some.size(); ++n) inside_[some[n]] = answers_[n];
}

void ContourPoints::ask(const Scales& scales, std::vector<uint8_t>& inside) {
  /// Fewer are not worth sorting by cell.
  constexpr size_t few = 256;
  if (asked_.empty()) return;
  // Neither the progress nor the counts of the call are those of one such question.
  Job part(job_);
  if (asked_.size() < few) {
    ask_points(model_, scales, {}, asked_.data(), inside.data(), asked_.size(), &part);
    return;
  }
  PointArray array;
  array.data = reinterpret_cast<const unsigned char*>(asked_.data());
  array.count = asked_.size();
  array.stride = sizeof(Vec3);
  set_membership(model_, scales, ArrayPoints(array), {}, inside.data(), &part);
}

}  // namespace msq

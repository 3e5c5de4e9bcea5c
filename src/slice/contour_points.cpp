// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_points.h"

#include "query/inside_points.h"

namespace msq {

const std::vector<uint8_t>& ContourPoints::find_inside() {
  check_cancelled(job_);
  inside_.resize(points_.size());
  if (!struts_) {
    asked_.clear();
    for (const Vec2 p : points_) asked_.push_back(plane_.at(p.x, p.y));
    msq::find_inside(model_, resolved_, asked_, inside_, job_);
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
  msq::find_inside(model_, scales, asked_, answers_, job_);
  for (size_t n = 0; n < some.size(); ++n) inside_[some[n]] = answers_[n];
}

}  // namespace msq

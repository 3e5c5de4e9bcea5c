// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_points.h"

#include <algorithm>

#include "query/inside_points.h"

namespace msq {

const std::vector<uint8_t>& ContourPoints::find_inside() {
  check_cancelled(job_);
  auto& [points, asked, inside, answers, held, doubtful] = *memory_;
  inside.resize(points.size());
  if (!struts_) {
    asked.clear();
    for (const Vec2 p : points) asked.push_back(plane_.at(p.x, p.y));
    msq::find_inside(model_, resolved_, asked, inside, job_);
    return inside;
  }
  held.clear();
  doubtful.clear();
  constexpr size_t at_once = 1024;
  PlaneStruts::Found found[at_once];
  for (size_t first = 0; first < points.size(); first += at_once) {
    check_cancelled(job_);
    const size_t count = std::min(at_once, points.size() - first);
    struts_->find(points.data() + first, count, found);
    for (size_t i = 0; i < count; ++i) {
      inside[first + i] = 0;
      const uint32_t n = static_cast<uint32_t>(first + i);
      if (found[i] == PlaneStruts::Found::inside) held.push_back(n);
      if (found[i] == PlaneStruts::Found::doubtful) doubtful.push_back(n);
    }
  }
  ask_some(held, {});  // the shape
  ask_some(doubtful, resolved_);
  return inside;
}

void ContourPoints::ask_some(const std::vector<uint32_t>& some, const Scales& scales) {
  auto& [points, asked, inside, answers, held, doubtful] = *memory_;
  asked.clear();
  for (const uint32_t i : some) asked.push_back(plane_.at(points[i].x, points[i].y));
  msq::find_inside(model_, scales, asked, answers, job_);
  for (size_t n = 0; n < some.size(); ++n) inside[some[n]] = answers[n];
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_points.h"

#include <algorithm>

#include "query/inside_points.h"

namespace msq {

const std::vector<uint8_t>& ContourPoints::find_inside() {
  check_cancelled(job_);
  auto& [points, queried, inside, answers, held, doubtful] = *memory_;
  inside.resize(points.size());
  if (!struts_) {
    queried.resize(points.size());
    for (size_t n = 0; n < points.size(); ++n) queried[n] = plane_.at(points[n].x, points[n].y);
    msq::find_inside(model_, resolved_, queried, inside, job_);
    return inside;
  }
  // By counts: a branch on each point would be predicted wrongly half the time.
  if (held.size() < points.size()) held.resize(points.size());
  if (doubtful.size() < points.size()) doubtful.resize(points.size());
  size_t held_count = 0, doubtful_count = 0;
  constexpr size_t at_once = 1024;
  PlaneStruts::Found found[at_once];
  for (size_t first = 0; first < points.size(); first += at_once) {
    check_cancelled(job_);
    const size_t count = std::min(at_once, points.size() - first);
    struts_->find(points.data() + first, count, found);
    for (size_t i = 0; i < count; ++i) {
      inside[first + i] = 0;
      const uint32_t n = static_cast<uint32_t>(first + i);
      held[held_count] = n;
      held_count += found[i] == PlaneStruts::Found::inside;
      doubtful[doubtful_count] = n;
      doubtful_count += found[i] == PlaneStruts::Found::doubtful;
    }
  }
  ask_some({held.data(), held_count}, {});  // the shape
  ask_some({doubtful.data(), doubtful_count}, resolved_);
  return inside;
}

void ContourPoints::ask_some(std::span<const uint32_t> some, const Scales& scales) {
  auto& [points, queried, inside, answers, held, doubtful] = *memory_;
  queried.resize(some.size());
  for (size_t n = 0; n < some.size(); ++n)
    queried[n] = plane_.at(points[some[n]].x, points[some[n]].y);
  msq::find_inside(model_, scales, queried, answers, job_);
  for (size_t n = 0; n < some.size(); ++n) inside[some[n]] = answers[n];
}

}  // namespace msq

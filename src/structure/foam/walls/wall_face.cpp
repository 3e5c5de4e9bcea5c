// SPDX-License-Identifier: Apache-2.0
// Cutting: Sutherland and Hodgman, "Reentrant polygon clipping", 1974.
#include "structure/foam/walls/wall_face.h"

#include <algorithm>
#include <cmath>

namespace msq {

void FacePolygon::start(Vec3 a, Vec3 b, double half) {
  a_ = a;
  b_ = b;
  centre_ = (a + b) * 0.5;
  const Vec3 n = (b - a) * (1 / length(b - a));
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(n[axis]) < std::abs(n[least])) least = axis;
  Vec3 e{};
  e[least] = 1;
  u_ = cross(n, e);
  u_ = u_ * (1 / length(u_));
  w_ = cross(n, u_);
  corners_ = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

// A point centre + x is nearer to c than to a where x . (c - a) > (c - a) . (c - b) / 2.
void FacePolygon::cut(Vec3 other) {
  const Vec3 apart = other - a_;
  const double u = dot(apart, u_), w = dot(apart, w_), limit = 0.5 * dot(apart, other - b_);
  const size_t count = corners_.size();
  over_.resize(count);
  bool cuts = false;
  for (size_t i = 0; i < count; ++i) {
    over_[i] = corners_[i].u * u + corners_[i].w * w - limit;
    cuts = cuts || over_[i] > 0;
  }
  if (!cuts) return;
  kept_.clear();
  for (size_t i = 0; i < count; ++i) {
    const size_t next = i + 1 == count ? 0 : i + 1;
    const Corner from = corners_[i], to = corners_[next];
    if (over_[i] <= 0) kept_.push_back(from);
    if ((over_[i] <= 0) != (over_[next] <= 0)) {
      const double part = over_[i] / (over_[i] - over_[next]);
      kept_.push_back({from.u + part * (to.u - from.u), from.w + part * (to.w - from.w)});
    }
  }
  corners_.swap(kept_);
}

WallFace FacePolygon::face() const {
  if (is_empty()) return {};
  const Corner first = corners_[0];
  double area = 0, u = 0, w = 0;
  for (size_t i = 2; i < corners_.size(); ++i) {
    const double bu = corners_[i - 1].u - first.u, bw = corners_[i - 1].w - first.w,
                 cu = corners_[i].u - first.u, cw = corners_[i].w - first.w;
    const double part = 0.5 * (bu * cw - bw * cu);
    area += part;
    u += part * (bu + cu);
    w += part * (bw + cw);
  }
  if (!(area > 0)) return {};
  return {area, place({first.u + u / (3 * area), first.w + w / (3 * area)})};
}

}  // namespace msq

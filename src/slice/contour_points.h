// SPDX-License-Identifier: Apache-2.0
// Membership of any points of a layer's plane, many at once. Points are along u and v of the plane.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/vec2.h"
#include "model/model.h"
#include "slice/contour_grid.h"

namespace msq {

class ContourPoints {
 public:
  ContourPoints(const Model& model, const Scales& resolved, LayerPlane plane, const Job* job)
      : model_(model), resolved_(resolved), plane_(plane), job_(job) {}

  const Model& model() const { return model_; }
  const Scales& resolved() const { return resolved_; }
  const LayerPlane& plane() const { return plane_; }
  const Job* job() const { return job_; }

  void clear() { points_.clear(); }
  void add(Vec2 p) { points_.push_back(plane_.at(p.x, p.y)); }
  size_t count() const { return points_.size(); }
  /// Of the points added since clear().
  const std::vector<uint8_t>& find_inside();

 private:
  const Model& model_;
  const Scales& resolved_;
  LayerPlane plane_;
  const Job* job_;
  std::vector<Vec3> points_;
  std::vector<uint8_t> inside_;
};

}  // namespace msq

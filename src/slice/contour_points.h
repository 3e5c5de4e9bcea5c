// SPDX-License-Identifier: Apache-2.0
// Membership of any points of a layer's plane, many at once. Points are along u and v of the plane.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/vec2.h"
#include "model/model.h"
#include "slice/contour_grid.h"
#include "slice/contour_struts.h"

namespace msq {

class ContourPoints {
 public:
  ContourPoints(const Model& model, const Scales& resolved, LayerPlane plane, const Job* job)
      : model_(model), resolved_(resolved), plane_(plane), job_(job) {}

  const Model& model() const { return model_; }
  const Scales& resolved() const { return resolved_; }
  const LayerPlane& plane() const { return plane_; }
  const Job* job() const { return job_; }

  /// From now on, struts tell first where points are. They are those of the only structure, and
  /// outlive this.
  void use_struts(const PlaneStruts& struts) { struts_ = &struts; }

  void clear() { points_.clear(); }
  void add(Vec2 p) { points_.push_back(p); }
  size_t count() const { return points_.size(); }
  /// Of the points added since clear().
  const std::vector<uint8_t>& find_inside();

 private:
  void ask_some(const std::vector<uint32_t>& some, const Scales& scales);

  const Model& model_;
  const Scales& resolved_;
  LayerPlane plane_;
  const Job* job_;
  const PlaneStruts* struts_ = nullptr;
  std::vector<Vec2> points_;
  std::vector<Vec3> asked_;
  std::vector<uint8_t> inside_, answers_;
  std::vector<uint32_t> held_, doubtful_;
};

}  // namespace msq

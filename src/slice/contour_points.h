// SPDX-License-Identifier: Apache-2.0
// Membership of any points of a layer's plane, many at once. Points are along u and v of the plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/borrowed.h"
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

  /// Bytes of working memory for a point.
  static constexpr uint64_t bytes_of_point =
      2 * sizeof(Vec2) + sizeof(Vec3) + 2 + 2 * sizeof(uint32_t);

  void clear() { memory_->points.clear(); }
  void add(Vec2 p) { memory_->points.push_back(p); }
  /// So many points, to be set.
  Vec2* add_some(size_t count) {
    memory_->points.resize(memory_->points.size() + count);
    return memory_->points.data() + (memory_->points.size() - count);
  }
  size_t count() const { return memory_->points.size(); }
  Vec2 at(size_t n) const { return memory_->points[n]; }
  /// Of the points added since clear().
  const std::vector<uint8_t>& find_inside();

 private:
  void ask_some(std::span<const uint32_t> some, const Scales& scales);

  const Model& model_;
  const Scales& resolved_;
  LayerPlane plane_;
  const Job* job_;
  const PlaneStruts* struts_ = nullptr;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<Vec2> points;
    std::vector<Vec3> queried;
    std::vector<uint8_t> inside, answers;
    std::vector<uint32_t> held, doubtful;
    size_t bytes() const {
      return points.capacity() * sizeof(Vec2) + queried.capacity() * sizeof(Vec3) +
             inside.capacity() + answers.capacity() +
             (held.capacity() + doubtful.capacity()) * sizeof(uint32_t);
    }
  };
  const Borrowed<Memory> memory_;
};

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// Membership of any points of a layer's plane, many at once.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "slice/contour_grid.h"

namespace msq {

struct LayerPoint {
  double u = 0, v = 0;

  double operator[](int i) const { return i == 0 ? u : v; }
  friend LayerPoint operator+(LayerPoint a, LayerPoint b) { return {a.u + b.u, a.v + b.v}; }
  friend LayerPoint operator-(LayerPoint a, LayerPoint b) { return {a.u - b.u, a.v - b.v}; }
  friend LayerPoint operator*(LayerPoint a, double s) { return {a.u * s, a.v * s}; }
  friend bool operator==(LayerPoint a, LayerPoint b) { return a.u == b.u && a.v == b.v; }
};
inline double dot(LayerPoint a, LayerPoint b) {
  return a.u * b.u + a.v * b.v;
}
/// Positive where b lies to the left of a.
inline double cross(LayerPoint a, LayerPoint b) {
  return a.u * b.v - a.v * b.u;
}
inline double length(LayerPoint a) {
  return std::sqrt(dot(a, a));
}

class ContourPoints {
 public:
  ContourPoints(const Model& model, const Scales& resolved, LayerPlane plane, const Job* job)
      : model_(model), resolved_(resolved), plane_(plane), job_(job) {}

  const Model& model() const { return model_; }
  const Scales& resolved() const { return resolved_; }
  const LayerPlane& plane() const { return plane_; }
  const Job* job() const { return job_; }

  void clear() { points_.clear(); }
  void add(LayerPoint p) { points_.push_back(plane_.at(p.u, p.v)); }
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

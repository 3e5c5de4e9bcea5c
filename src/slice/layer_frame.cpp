// SPDX-License-Identifier: Apache-2.0
#include "slice/layer_frame.h"

namespace msq {

namespace {

/// Encloses the products of a number and an interval, 0 times infinity being 0.
void add_product(double factor, double low, double high, double& sum_low, double& sum_high) {
  if (factor == 0) return;
  sum_low += factor > 0 ? factor * low : factor * high;
  sum_high += factor > 0 ? factor * high : factor * low;
}

}  // namespace

Box3 LayerFrame::to_model(const Box3& box) const {
  Box3 out;
  for (int axis = 0; axis < 3; ++axis) {
    double low = origin[axis], high = origin[axis];
    for (size_t i = 0; i < 3; ++i)
      add_product(axes[i][axis], box.min[static_cast<int>(i)], box.max[static_cast<int>(i)], low,
                  high);
    out.min[axis] = low;
    out.max[axis] = high;
  }
  if (model_axes()[0] >= 0) return out;
  return out.grown(4 * (rounding(box.min) + rounding(box.max)));
}

Box3 LayerFrame::from_model(const Box3& box) const {
  Box3 out;
  for (int i = 0; i < 3; ++i) {
    double low = 0, high = 0;
    for (int axis = 0; axis < 3; ++axis)
      add_product(axes[static_cast<size_t>(i)][axis], box.min[axis] - origin[axis],
                  box.max[axis] - origin[axis], low, high);
    out.min[i] = low;
    out.max[i] = high;
  }
  if (model_axes()[0] >= 0) return out;
  return out.grown(4 * (rounding(box.min) + rounding(box.max)));
}

}  // namespace msq

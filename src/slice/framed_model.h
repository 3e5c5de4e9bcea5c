// SPDX-License-Identifier: Apache-2.0
// A model in the coordinates of a frame, for the membership of samples: a point is inside where the
// model holds LayerFrame::to_model() of it. Where the frame's axes are those of the model in
// another order, rows go over to the model's own; otherwise its shape is queried for boxes and
// points, and its structures about points.
#pragma once

#include "model/model.h"
#include "slice/layer_frame.h"

namespace msq {

/// Not for materials, distances and rays, of which it knows only what membership needs.
Ref<const Model> make_framed_model(const Model& model, const LayerFrame& frame);

}  // namespace msq

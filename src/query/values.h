// SPDX-License-Identifier: Apache-2.0
// Sets of values: onsets of a structure, and fields.
#pragma once

#include "base/job.h"
#include "base/parallel.h"
#include "field/field.h"
#include "query/point_set.h"
#include "structure/structure.h"

namespace msq {

struct OnsetPlan {
  bool is_signed = false;       ///< the onset less the parameter at the point
  double* onsets = nullptr;     ///< by number of the point
  double* gradients = nullptr;  ///< three for each point; null: none
};

/// The length that gradients are differences over, to either side.
double gradient_step(const Structure& structure);

/// Of a structure that has onsets; all points must be finite and within reach.
void set_onset(const Structure& structure, const PointSet& points, const OnsetPlan& plan,
               const Executor& executor, Job* job);

/// values[i] becomes the field's at point i.
void set_field(const Field& field, const PointSet& points, double* values, const Executor& executor,
               Job* job);

}  // namespace msq

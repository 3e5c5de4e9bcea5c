// SPDX-License-Identifier: Apache-2.0
// Statistics of a model's microstructure by stratified samples.
// Source: Torquato, "Random Heterogeneous Materials", 2002, sections 2.2 (volume fraction,
// two-point correlation) and 2.4 (lineal-path function).
#pragma once

#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "query/ask_group.h"
#include "query/estimate.h"
#include "query/stratified_points.h"

namespace msq {

/// The phase to measure and the points to use. A cell of the sample has 2 to max_in_part points.
struct StatisticsOf {
  const Model& model;
  const Scales& resolved;
  QueryPlan plan;
  const StratifiedPoints& sample;
  bool of_void = false;  ///< phase: outside of the model
};

/// Segments that begin at the sample's points.
struct Segments {
  Vec3 direction;  ///< a unit vector; 0: each point has its own, uniform over the sphere
  std::vector<double> lengths;
};

/// The share of points that are in the phase.
Estimate volume_fraction(const StatisticsOf& of, Job* job);

/// For each length, the share of segments whose two ends are in the phase.
std::vector<Estimate> two_point_correlation(const StatisticsOf& of, const Segments& segments,
                                            Job* job);

/// For each length, the share of segments that are wholly in the phase. A segment is followed in
/// safe steps of the lower bound on the distance, or of `step` if that bound is smaller. So it can
/// only miss gaps shorter than `step`.
std::vector<Estimate> lineal_path(const StatisticsOf& of, const Segments& segments, double step,
                                  Job* job);

}  // namespace msq

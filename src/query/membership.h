// SPDX-License-Identifier: Apache-2.0
// Set queries of membership. Source: paper, section "Set-based queries": scale by scale from the
// coarsest; what a scale answers is not asked of finer ones.
#pragma once

#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "query/ask_group.h"
#include "query/point_set.h"

namespace msq {

/// Bits of layers [z0, z1) of a grid, rows tightly packed in words_for(nx) words; `words` is
/// overwritten. The whole of a layer at a time, in parallel.
void fill_slab(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
               uint64_t z1, uint64_t* words, const Job* job, QueryCounts* counts = nullptr);

/// Words of working memory that fill_slab takes beyond its output, for slabs of so many layers.
uint64_t fill_slab_scratch_words(const Model& model, const Scales& resolved, const SampleGrid& grid,
                                 uint64_t layers);

/// inside[i] becomes 0 or 1. All points must be finite.
void set_membership(const Model& model, const Scales& resolved, const PointSet& points,
                    const QueryPlan& plan, uint8_t* inside, Job* job);

/// The same for some points on the calling thread; `inside` is overwritten.
void ask_points(const Model& model, const Scales& resolved, const QueryPlan& plan,
                const Vec3* points, uint8_t* inside, size_t count, Job* job);

/// Of all points of a grid, by rows.
void grid_membership(const Model& model, const Scales& resolved, const SampleGrid& grid,
                     uint8_t* inside, Job* job);

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// Set queries of membership. Source: paper, section "Set-based queries": scale by scale from the
// coarsest. Finer scales evaluate only the points that coarser ones do not decide.
#pragma once

#include <functional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "query/ask_group.h"
#include "query/point_set.h"

namespace msq {

/// Called with parts of a slab whose bits are final, each once, on any thread, and with how many
/// rows of the slab each row stands for. It may change them.
using FinishRows = std::function<void(const RowBlock&, uint64_t times)>;

/// Computes the bits of layers [z0, z1) of a grid, rows tightly packed in words_for(nx) words.
/// Overwrites `words`. Processes whole layers, in parallel. `finish`: empty, or called for all
/// rows.
void fill_slab(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
               uint64_t z1, uint64_t* words, const Job* job, QueryCounts* counts = nullptr,
               const FinishRows& finish = {});

/// The same of rows [y0, y1) of the layers alone, on the calling thread. `words` are those of whole
/// layers. The model's skins are prepared.
void fill_rows_of_slab(const Model& model, const Scales& resolved, const SampleGrid& grid,
                       uint64_t z0, uint64_t z1, uint64_t y0, uint64_t y1, uint64_t* words,
                       const Job* job);

/// Whether fill_tiles() serves a model.
bool fills_by_tile(const Model& model, const Scales& resolved);

/// As fill_slab() with `finish`, where nothing else needs the bits: each block has its rows in
/// working memory, which caches hold. Blocks begin at multiples of `rows_together`, at most 16.
void fill_tiles(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
                uint64_t z1, uint64_t rows_together, const Job* job, const FinishRows& finish);

/// Words of working memory that fill_tiles() takes.
uint64_t fill_tiles_words(const Model& model, const Scales& resolved, const SampleGrid& grid,
                          uint64_t layers);

/// Rows that fill_slab() takes at once.
uint64_t rows_of_tile(const Model& model, const Scales& resolved, const SampleGrid& grid,
                      uint64_t layers);

/// Words of working memory that fill_slab takes in addition to its output, for slabs of this many
/// layers.
uint64_t fill_slab_scratch_words(const Model& model, const Scales& resolved, const SampleGrid& grid,
                                 uint64_t layers);

/// Sets inside[i] to 0 or 1. All points must be finite.
void set_membership(const Model& model, const Scales& resolved, const PointSet& points,
                    const QueryPlan& plan, uint8_t* inside, Job* job);

/// The same for some points on the calling thread; `inside` is overwritten.
void ask_points(const Model& model, const Scales& resolved, const QueryPlan& plan,
                const Vec3* points, uint8_t* inside, size_t count, Job* job);

/// regions[i] becomes the region that point i belongs to, 0 in a model that is one; -1 where it is
/// in the shape of none. All points must be finite.
void set_regions(const Model& model, const PointSet& points, int32_t* regions, Job* job);

/// Of all points of a grid, by rows.
void grid_membership(const Model& model, const Scales& resolved, const SampleGrid& grid,
                     uint8_t* inside, Job* job);

}  // namespace msq

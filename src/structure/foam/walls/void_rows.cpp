// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/void_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/borrowed.h"
#include "base/sample_bounds.h"
#include "base/simd.h"
#include "structure/common/grid_boxes.h"
#include "structure/foam/walls/face_brick.h"
#include "structure/foam/walls/vent_rows.h"
#include "structure/foam/walls/void_spans.h"

namespace msq {

namespace {

/// Samples of a cell from which on its faces cost less than asking them (docs/benchmarks.md).
constexpr double critical_samples = 12;
constexpr size_t cache_line = 64;
/// Fields that grow faster tilt planes too far for the margin; they are bounded instead.
constexpr double max_gradient = 0.25;

/// Rows and layers of the block.
struct RowPart {
  uint64_t j, k;  // the first ones
  size_t rows, layers;
};

/// A cell that meets the block.
struct NearCell {
  const FaceBrick::Cell* cell;
  Vec3 seed;    // model units, along the axes of the samples
  Box3 around;  // about the cell, from the seed, foam units
};

struct VoidRowsWorkspace {
  std::vector<NearCell> near;
  std::vector<DoubtfulSamples> doubts;
  std::vector<float> near_y, near_z;
  std::vector<VentPlane> vents;
  std::vector<double> vent_y, vent_z;

  size_t bytes() const { return doubts.capacity() * sizeof(DoubtfulSamples); }
};

class BlockVoids {
 public:
  BlockVoids(const FoamWalls& walls, const RowBlock& block, VoidRowsWorkspace& work)
      : walls_(walls),
        grid_(walls.neighbourhood()),
        unit_(walls.unit() * (walls.seeds().stretch() ? walls.seeds().stretch()->max_factor() : 1)),
        block_(block),
        w_(work) {
    find_alive();
  }

  bool is_empty() const { return is_empty_; }
  /// Of the samples that are alive.
  const Box3& box() const { return box_; }
  bool pays() const {
    const GradedSeeds* const graded = walls_.seeds().graded().get();
    const double seeds_of_cell = graded ? graded->mean_density(grid_.to_grid(box_)) : 1;
    return samples_ > critical_samples * seeds_of_cell * mean_cells_met(grid_, box_) &&
           margin_ < 1e-4 && unit_ < max_per_unit * block_.grid->spacing.x &&
           block_.grid->spacing.x < unit_;
  }

  void take(const FaceBrick& brick, CellIndex corner) {
    const Vec3 origin =
        Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid_.cell_size;
    w_.near.clear();
    for (const FaceBrick::Cell& cell : brick.cells()) {
      const Vec3 seed = grid_.from_grid(origin + cell.seed * unit_);
      const Box3 around = turned(
          {{cell.low[0], cell.low[1], cell.low[2]}, {cell.high[0], cell.high[1], cell.high[2]}});
      if (Box3{seed + around.min * unit_, seed + around.max * unit_}.overlaps(box_))
        w_.near.push_back({&cell, seed, around});
    }
    for (size_t i = 0; i < w_.near.size(); ++i) {
      // Bricks do not stay in a core's cache from one block to the next.
      if (i + 1 < w_.near.size()) {
        const FaceBrick::Cell& next = *w_.near[i + 1].cell;
        const char* const faces = reinterpret_cast<const char*>(brick.faces(next));
        for (size_t at = 0; at < next.count * sizeof(FaceBrick::Face); at += cache_line)
          hwy::Prefetch(faces + at);
      }
      clear(brick, w_.near[i]);
    }
  }

  void decide(const Job* job) {
    size_t queried = 0;
    for (const DoubtfulSamples& run : w_.doubts) {
      uint64_t* const row = block_.row(block_.y0 + run.row, block_.z0 + run.layer);
      for (uint64_t i = run.first; i < run.first + run.count; ++i) {
        uint64_t& word = row[i / bits_per_word];
        const uint64_t bit = uint64_t{1} << (i % bits_per_word);
        if (!(word & bit)) continue;
        if (queried++ % 256 == 0) check_cancelled(job);
        if (!walls_.inside(block_.grid->at(i, block_.y0 + run.row, block_.z0 + run.layer)))
          word &= ~bit;
      }
    }
    w_.doubts.clear();
  }
  bool has_many_doubts() const { return w_.doubts.size() > size_t{1} << 16; }

 private:
  void find_alive() {
    const SampleGrid& samples = *block_.grid;
    is_empty_ = !find_bounds(block_, alive_);
    if (is_empty_) return;
    box_ = {samples.at(alive_.i0, alive_.j0, alive_.k0),
            samples.at(alive_.i1 - 1, alive_.j1 - 1, alive_.k1 - 1)};
    samples_ = double(alive_.i1 - alive_.i0) * double(alive_.j1 - alive_.j0) *
               double(alive_.k1 - alive_.k0);
    // Positions of samples and seeds carry a few units of 2^-53 of the largest magnitude.
    const double most = max_magnitude(box_.min) + max_magnitude(box_.max) +
                        max_magnitude(grid_.origin) + samples.magnitude();
    position_error_ = 0x1p-40 * most / unit_;
    margin_ = void_margin(max_void_reach) + position_error_;
    w_.doubts.clear();
  }

  /// What may meet a box of the rows and layers with samples that are alive; false if nothing does.
  bool find_part(const Box3& box, RowPart& part) const {
    const SampleGrid& samples = *block_.grid;
    part.j = std::max(alive_.j0, samples.first_y_from(box.min.y));
    part.k = std::max(alive_.k0, samples.first_z_from(box.min.z));
    const uint64_t j1 = std::min(alive_.j1, samples.first_y_from<true>(box.max.y)),
                   k1 = std::min(alive_.k1, samples.first_z_from<true>(box.max.z));
    if (part.j >= j1 || part.k >= k1) return false;
    part.rows = j1 - part.j;
    part.layers = k1 - part.k;
    return true;
  }

  void clear(const FaceBrick& brick, const NearCell& near) {
    const FaceBrick::Cell& cell = *near.cell;
    const Vec3 seed = near.seed;
    const Box3& around = near.around;
    const Box3 reach{seed + around.min * unit_, seed + around.max * unit_};
    // The thickness: at_seed + gradient . x, off by `off` at most.
    const Parameter& thickness = walls_.thickness();
    const Box3 whole = reach.grown(1e-3 * unit_);
    const Interval range = thickness.range(whole);
    double at_seed = range.high / unit_, off = 0;
    Vec3 gradient;
    if (!thickness.is_constant()) {
      if (thickness.is_linear(whole, gradient) && max_magnitude(gradient) <= max_gradient) {
        at_seed = thickness.at(seed) / unit_;
        off = 1e-9 * range.high / unit_;
      } else {
        gradient = {};
        at_seed = 0.5 * (range.low + range.high) / unit_;
        off = 0.5 * (range.high - range.low) / unit_ * (1 + 1e-9) + 1e-9 * range.high / unit_;
      }
    }
    const double reach_of_cell = std::max(max_magnitude(around.min), max_magnitude(around.max));
    const double margin = void_margin(reach_of_cell) + position_error_;
    const VoidFaces faces{brick.faces(cell),
                          cell.count,
                          grid_.rotation,
                          0.5 * at_seed,
                          gradient * 0.5,
                          static_cast<float>((margin + 0.5 * off) * (1 + 1e-6)),
                          static_cast<float>(reach_of_cell * (1 + 1e-6))};
    const double place = (seed.x - block_.grid->x(0)) / block_.grid->spacing.x;
    if (!(std::abs(place) < 0x1p52)) return;  // no sample is near
    clear_spans(faces, around, seed, place, 0.5 * range.low / unit_);
    if (walls_.vents().exist())
      clear_holes(faces, brick.areas(cell), seed, reach, place, 0.5 * range.high / unit_);
  }

  /// `around`: about the cell, from the seed along the axes of the samples. `place`: of the seed
  /// along x, in samples. `half`: half the thickness at least.
  void clear_spans(const VoidFaces& faces, Box3 around, Vec3 seed, double place, double half) {
    // A ball of half the thickness about a point of the void lies in the cell.
    around = around.grown(margin_ - half);
    if (!(around.min.x < around.max.x && around.min.y < around.max.y &&
          around.min.z < around.max.z))
      return;
    const Box3 reach{seed + around.min * unit_, seed + around.max * unit_};
    RowPart part;
    if (!find_part(reach, part)) return;

    const size_t room = 2 * max_simd_doubles;
    w_.near_y.assign(part.rows + room, 0);
    w_.near_z.assign(part.layers + room, 0);
    const SampleGrid& samples = *block_.grid;
    const double per_unit = 1 / unit_;
    for (size_t j = 0; j < part.rows; ++j)
      w_.near_y[j] = static_cast<float>((samples.y(part.j + j) - seed.y) * per_unit);
    for (size_t k = 0; k < part.layers; ++k)
      w_.near_z[k] = static_cast<float>((samples.z(part.k + k) - seed.z) * per_unit);
    const double base = std::floor(place);
    const VoidRows target{w_.near_y.data(),
                          w_.near_z.data(),
                          part.rows,
                          part.layers,
                          static_cast<uint32_t>(part.j - block_.y0),
                          static_cast<uint32_t>(part.k - block_.z0),
                          block_.row(part.j, part.k),
                          block_.row_stride,
                          block_.layer_stride,
                          static_cast<float>(unit_ / samples.spacing.x),
                          static_cast<float>(place - base),
                          static_cast<int64_t>(base),
                          static_cast<int64_t>(samples.nx) - 1};
    clear_void(faces, target, w_.doubts);
  }

  /// In holes. `reach`: about the cell. `half`: half the thickness at most.
  void clear_holes(const VoidFaces& faces, const WallFace* areas, Vec3 seed, const Box3& reach,
                   double place, double half) {
    const Parameter& radius = walls_.vents().radius();
    w_.vents.clear();
    for (size_t i = 0; i < faces.count; ++i) {
      const FaceBrick::Face& face = faces.faces[i];
      const Vec3 n = grid_.rotation.apply({face.normal[0], face.normal[1], face.normal[2]}),
                 middle = grid_.rotation.apply(areas[i].middle), at = seed + middle * unit_;
      const double area = areas[i].area;
      VentPlane plane{faces.plane(i), n * (1 / length(n)), face.distance, area, middle, 0, {0, 0}};
      if (area + face_area_error >= vent_area(min_vent_radius)) {
        plane.error = centroid_error(area);
        const Interval range = radius.range(Box3{at, at}.grown((1e-6 + plane.error) * unit_));
        plane.radius = {range.low / unit_, range.high / unit_};
      }
      w_.vents.push_back(plane);
    }
    RowPart part;
    if (!find_part(reach, part)) return;
    const SampleGrid& samples = *block_.grid;
    w_.vent_y.resize(part.rows);
    w_.vent_z.resize(part.layers);
    for (size_t j = 0; j < part.rows; ++j) w_.vent_y[j] = (samples.y(part.j + j) - seed.y) / unit_;
    for (size_t k = 0; k < part.layers; ++k)
      w_.vent_z[k] = (samples.z(part.k + k) - seed.z) / unit_;
    const VentRows rows{w_.vent_y.data(),
                        w_.vent_z.data(),
                        part.rows,
                        part.layers,
                        static_cast<uint32_t>(part.j - block_.y0),
                        static_cast<uint32_t>(part.k - block_.z0),
                        block_.row(part.j, part.k),
                        block_.row_stride,
                        block_.layer_stride,
                        unit_ / samples.spacing.x,
                        place,
                        static_cast<int64_t>(samples.nx) - 1};
    clear_vents(w_.vents, half, margin_, rows, w_.doubts);
  }

  /// About a box that is given along the grid's axes, along those of the samples.
  Box3 turned(const Box3& box) const {
    const Vec3 centre = grid_.rotation.apply((box.min + box.max) * 0.5);
    const Vec3 half = box.extent() * 0.5;
    const auto& m = grid_.rotation.m;
    const auto along = [&](size_t row) {
      return std::abs(m[3 * row]) * half.x + std::abs(m[3 * row + 1]) * half.y +
             std::abs(m[3 * row + 2]) * half.z;
    };
    const Vec3 h = Vec3{along(0), along(1), along(2)} * (1 + 1e-12);
    return {centre - h, centre + h};
  }

  const FoamWalls& walls_;
  const Neighbourhood& grid_;
  const double unit_;  // of FaceBrick
  const RowBlock& block_;
  VoidRowsWorkspace& w_;
  bool is_empty_ = true;
  SampleBounds alive_;
  Box3 box_;
  double samples_ = 0;
  double position_error_ = 0, margin_ = 0;  // in that unit; the latter for any cell
};

}  // namespace

bool keep_void_rows(const FoamWalls& walls, const RowBlock& block, const Job* job) {
  const std::shared_ptr<const GradedSeeds>& graded = walls.seeds().graded();
  const Borrowed<VoidRowsWorkspace> workspace;
  BlockVoids voids(walls, block, *workspace);
  if (voids.is_empty()) return true;
  if (!voids.pays()) return false;
  const Neighbourhood& grid = walls.neighbourhood();
  const FoamSeeds& seeds = walls.seeds().seeds();
  // A cell that touches the box has a point in it, and its seed within the empty radius of that.
  const Stretch* const stretch = walls.seeds().stretch();
  const double around = stretch ? 0 : seeds.empty_radius() * walls.unit() * (1 + 1e-9);
  const Vec3 beyond = stretch ? stretch->reach() * walls.unit() : Vec3{};
  // Without jitter, one brick serves for all.
  const bool has_vents = walls.vents().exist();
  const bool are_equal = seeds.jitter() == 0 && !seeds.is_weighted() && !graded;
  const int side = graded ? graded->brick_side() : FaceBrick::side,
            lead = graded ? 0 : FaceBrick::lead;
  CellCache::Data brick;
  for_each_brick_near(
      grid, voids.box(), around, beyond, side, lead, [&](CellIndex corner, const Box3& near) {
        check_cancelled(job);
        // Seeds of cells that touch a box are as far from it as owners of edges.
        if (graded && !(graded->may_own_edges(corner, near) && graded->is_needed(corner))) return;
        if (!are_equal) brick.reset();
        if (!brick)
          brick = walls.context().cache.fetch(walls.id(), are_equal ? CellIndex{} : corner, [&] {
            if (graded) return std::make_shared<const FaceBrick>(graded, corner, has_vents);
            if (stretch) return std::make_shared<const FaceBrick>(*stretch, corner);
            if (seeds.is_weighted())
              return std::make_shared<const FaceBrick>(FaceBrick::Weighted{}, seeds, corner);
            return std::make_shared<const FaceBrick>(seeds, corner, has_vents);
          });
        voids.take(static_cast<const FaceBrick&>(*brick), corner);
        if (voids.has_many_doubts()) voids.decide(job);
      });
  voids.decide(job);
  return true;
}

}  // namespace msq

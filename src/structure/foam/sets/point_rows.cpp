// SPDX-License-Identifier: Apache-2.0
// Samples of a grid that is aligned with the cells need no sorting by cell: each coordinate of a
// sample alone gives its cell and position along one axis of the cells.
#include <bit>
#include <span>
#include <vector>

#include "structure/foam/sets/point_batch.h"
#include "structure/foam/sets/point_set.h"

namespace msq {

namespace {

/// Samples evaluated at a time: the seeds around their cells stay in a core's own cache.
constexpr size_t tile_samples = 4096;

/// Samples begin ... end - 1 along an axis, all in one cell.
struct Run {
  uint64_t begin, end;
  int32_t cell;
};

/// The samples begin ... end - 1 along one axis of the model.
struct AxisSamples {
  int axis;  // of the cells, parallel to this axis
  uint64_t begin;
  std::vector<double> place;  // foam units from the cell's corner
  std::vector<Run> runs;      // ascending, none longer than a word; without samples beyond all
                              // cells
};

/// The axis of the cells that is parallel to an axis of the model, or -1 if none is: then one
/// coordinate alone does not determine the bits of the position.
int cell_axis(const Rotation& rotation, int model_axis) {
  int found = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (rotation.m[static_cast<size_t>(3 * model_axis + axis)] == 0) continue;
    if (found >= 0) return -1;
    found = axis;
  }
  return found;
}

AxisSamples along(const FoamData& foam, const RowBlock& block, int model_axis, uint64_t begin,
                  uint64_t end) {
  const Neighbourhood& grid = foam.neighbourhood();
  AxisSamples samples{cell_axis(grid.rotation, model_axis), begin, {}, {}};
  for (uint64_t i = begin; i < end; ++i) {
    Vec3 p = grid.origin;
    p[model_axis] = model_axis == 0   ? block.grid->x(i)
                    : model_axis == 1 ? block.grid->y(i)
                                      : block.grid->z(i);
    samples.place.push_back(0);
    // Samples beyond the shape are not alive; their cells may have no valid index.
    const int axis = samples.axis;
    if (!(std::abs(grid.to_grid(p)[axis] / grid.cell_size[axis]) < 2 * max_cell_index)) continue;
    const Neighbourhood::Located located = grid.locate(p);
    const int32_t cell = axis == 0 ? located.cell.x : axis == 1 ? located.cell.y : located.cell.z;
    samples.place.back() = (located.fraction * foam.seeds().scale())[axis];
    if (samples.runs.empty() || samples.runs.back().cell != cell || samples.runs.back().end != i ||
        i % bits_per_word == 0)
      samples.runs.push_back({i, i, cell});
    samples.runs.back().end = i + 1;
  }
  return samples;
}

/// Bit i of the result is bytes[i], 0 or 1.
uint64_t bits_of(const uint8_t* bytes) {
  uint64_t bits = 0;
  for (int group = 0; group < 8; ++group) {
    uint64_t eight = 0;
    for (int i = 0; i < 8; ++i) eight |= uint64_t{bytes[8 * group + i]} << 8 * i;
    // Byte i moves to bit 56 + i, and no other product reaches or carries into those bits.
    bits |= (eight * 0x0102040810204080ULL >> 56) << 8 * group;
  }
  return bits;
}

/// The number of runs, from run `first` on, that together contain about `most` samples.
size_t runs_within(const std::vector<Run>& runs, size_t first, uint64_t most) {
  size_t last = first + 1;
  while (last < runs.size() && runs[last].end - runs[first].begin <= most) ++last;
  return last;
}

class RowTiles {
 public:
  RowTiles(const FoamData& foam, const RowBlock& block)
      : foam_(foam),
        block_(block),
        x_(along(foam, block, 0, 0, block.grid->nx)),
        y_(along(foam, block, 1, block.y0, block.y1)),
        z_(along(foam, block, 2, block.z0, block.z1)),
        max_radius_(foam.max_radius()),
        batch_(foam.seeds(), max_radius_) {}

  void keep(const Job* job) {
    for (size_t z = 0, z_end; z < z_.runs.size(); z = z_end) {
      z_end = runs_within(z_.runs, z, 8);
      const uint64_t layers = z_.runs[z_end - 1].end - z_.runs[z].begin;
      const uint64_t rows = std::max<uint64_t>(1, tile_samples / bits_per_word / layers);
      for (size_t y = 0, y_end; y < y_.runs.size(); y = y_end) {
        y_end = runs_within(y_.runs, y, rows);
        check_cancelled(job);
        for (size_t x = 0, x_end; x < x_.runs.size(); x = x_end) {
          const uint64_t word = x_.runs[x].begin / bits_per_word;
          x_end = x + 1;
          while (x_end < x_.runs.size() && x_.runs[x_end].begin / bits_per_word == word) ++x_end;
          keep_tile({&x_.runs[x], x_end - x}, {&y_.runs[y], y_end - y}, {&z_.runs[z], z_end - z});
        }
      }
    }
  }

 private:
  using Runs = std::span<const Run>;

  void keep_tile(Runs x, Runs y, Runs z) {
    const uint64_t word = x.front().begin / bits_per_word, j0 = y.front().begin,
                   k0 = z.front().begin, rows = y.back().end - j0;
    const auto for_each_word = [&](auto&& visit) {
      for (uint64_t k = k0; k < z.back().end; ++k)
        for (uint64_t j = j0; j < y.back().end; ++j)
          visit(block_.row(j, k)[word], ((k - k0) * rows + (j - j0)) * bits_per_word);
    };
    size_t alive = 0, samples = 0;
    for_each_word([&](uint64_t bits, size_t) {
      alive += static_cast<size_t>(std::popcount(bits));
      samples += bits_per_word;
    });
    if (alive == 0) return;
    if (inside_.size() < samples) inside_.resize(samples);
    batch_.answer_to(inside_.data());

    int32_t low[3], high[3];
    int size[3];
    bool is_dense = true;
    const auto bound = [&](const AxisSamples& samples_of, Runs runs) {
      const auto [least, most] = std::minmax(runs.front().cell, runs.back().cell);
      low[samples_of.axis] = least;
      high[samples_of.axis] = most;
    };
    bound(x_, x);
    bound(y_, y);
    bound(z_, z);
    for (int axis = 0; axis < 3; ++axis) size[axis] = high[axis] - low[axis] + 1;
    is_dense =
        batch_.seeds_about(size) <= PointBatch::max_seeds_a_point * static_cast<double>(alive);
    if (is_dense) batch_.move_to({low[0], low[1], low[2]}, size);

    for (const Run& layers : z)
      for (const Run& lines : y)
        for (const Run& run : x) {
          int32_t cell[3];
          cell[x_.axis] = run.cell;
          cell[y_.axis] = lines.cell;
          cell[z_.axis] = layers.cell;
          keep_cell({cell[0], cell[1], cell[2]}, run, lines, layers, j0, k0, rows, !is_dense);
        }
    batch_.finish();
    for_each_word([&](uint64_t& bits, size_t at) {
      if (bits) bits &= bits_of(inside_.data() + at);
    });
  }

  /// Evaluates the samples of one cell.
  void keep_cell(CellIndex cell, const Run& x, const Run& y, const Run& z, uint64_t j0, uint64_t k0,
                 uint64_t rows, bool is_sparse) {
    const uint64_t word = x.begin / bits_per_word;
    const uint64_t mask = ~uint64_t{0} >> (bits_per_word - (x.end - x.begin))
                                              << (x.begin % bits_per_word);
    bool is_at_cell = !is_sparse;
    double q[3];
    for (uint64_t k = z.begin; k < z.end; ++k) {
      q[z_.axis] = z_.place[k - z_.begin];
      for (uint64_t j = y.begin; j < y.end; ++j) {
        q[y_.axis] = y_.place[j - y_.begin];
        const uint64_t at = ((k - k0) * rows + (j - j0)) * bits_per_word;
        for (uint64_t rest = block_.row(j, k)[word] & mask; rest; rest &= rest - 1) {
          const auto bit = static_cast<uint64_t>(std::countr_zero(rest));
          const uint64_t i = word * bits_per_word + bit;
          q[x_.axis] = x_.place[i];
          const double radius = foam_.radius().is_constant()
                                    ? max_radius_
                                    : foam_.radius().at(block_.grid->at(i, j, k)) / foam_.unit();
          if (!is_at_cell) batch_.move_to(cell, {1, 1, 1}, true);
          is_at_cell = true;
          if (batch_.is_full()) batch_.ask(cell);
          batch_.add({q[0], q[1], q[2]}, radius, static_cast<uint32_t>(at + bit));
        }
      }
    }
    batch_.ask(cell);
  }

  const FoamData& foam_;
  const RowBlock& block_;
  AxisSamples x_, y_, z_;
  double max_radius_;
  PointBatch batch_;
  std::vector<uint8_t> inside_;
};

}  // namespace

void foam_keep_rows_by_point(const FoamData& foam, const RowBlock& block, const Job* job) {
  const Rotation& rotation = foam.neighbourhood().rotation;
  for (int axis = 0; axis < 3; ++axis)
    if (cell_axis(rotation, axis) < 0) return foam.Structure::keep_rows(block, job);
  RowTiles(foam, block).keep(job);
}

}  // namespace msq

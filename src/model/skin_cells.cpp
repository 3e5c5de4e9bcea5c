// SPDX-License-Identifier: Apache-2.0
#include "model/skin_cells.h"

#include <bit>

namespace msq {

namespace {

/// Samples of a brick along an axis: in x, those of a word.
constexpr uint64_t side = bits_per_word;
/// Samples of a cell along an axis.
constexpr double max_step = 16;
/// Bound on the rounding of a square, many times over.
constexpr double rounding = 0x1p-40;

/// Bits [begin, end) of a word.
uint64_t bits_between(uint32_t begin, uint32_t end) {
  return ~uint64_t{0} >> (bits_per_word - (end - begin)) << begin;
}

double squared(double v) {
  return v * v;
}

}  // namespace

void SkinCells::Axis::set(uint64_t from, uint64_t samples) {
  first = from;
  count = static_cast<uint32_t>(samples);
  cells = step == 1 ? count : std::max(1u, (count - 2 + step) / step);
}

SkinCells::SkinCells(const Skin& skin, const BoundarySearch& search, const RowBlock& alive,
                     const RowBlock& rows)
    : skin_(skin),
      search_(search),
      alive_(alive),
      rows_(rows),
      error_(skin.shape().depth_error()),
      margin_(skin.search_margin()) {
  choose_steps();
}

// Halving the width h of cells needs four times as many corners about a level surface, and leaves a
// quarter of the samples undecided; their share is about h^2 / (3 t) in units of samples. Both cost
// the same where h^4 is about 7 t.
void SkinCells::choose_steps() {
  const SampleGrid& grid = *alive_.grid;
  const double extent = max_component(skin_.shape().bounds().extent());
  const double dz = grid.heights
                        ? (grid.z(alive_.z1 - 1) - grid.z(alive_.z0)) /
                              static_cast<double>(std::max<uint64_t>(1, alive_.layers() - 1))
                        : grid.spacing.z;
  const double spacing[3] = {grid.spacing.x, grid.spacing.y, dz};
  const uint64_t counts[3] = {grid.nx, alive_.rows(), alive_.layers()};
  double product = 1;
  int dimensions = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (counts[axis] < 2 || spacing[axis] > extent) continue;
    product *= spacing[axis] / extent;
    ++dimensions;
  }
  if (dimensions == 0) return;
  const double unit = extent * std::pow(product, 1.0 / dimensions);
  const double thickness = std::min(skin_.thickness().range().high, extent);
  const double width = unit * std::pow(7 * thickness / unit, 0.25);
  for (int axis = 0; axis < 3; ++axis)
    axes_[axis].step =
        static_cast<uint32_t>(std::clamp(std::floor(width / spacing[axis] + 0.5), 1.0, max_step));
}

void SkinCells::mark(const Job* job) {
  for (uint64_t k = alive_.z0; k < alive_.z1; k += side)
    for (uint64_t j = alive_.y0; j < alive_.y1; j += side) {
      find_alive_words(j, k);
      for (size_t w = 0; w < alive_.row_words(); ++w) {
        if (!alive_words_[w]) continue;
        check_cancelled(job);
        set_brick(w, j, k);
        divide({{0, 0, 0}, {axes_[0].cells, axes_[1].cells, axes_[2].cells}});
      }
    }
}

/// Row by row: words of one brick lie far apart in memory.
void SkinCells::find_alive_words(uint64_t j0, uint64_t k0) {
  alive_words_.assign(alive_.row_words(), 0);
  for (uint64_t k = k0; k < std::min(k0 + side, alive_.z1); ++k)
    for (uint64_t j = j0; j < std::min(j0 + side, alive_.y1); ++j) {
      const uint64_t* const row = alive_.row(j, k);
      for (size_t w = 0; w < alive_words_.size(); ++w) alive_words_[w] |= row[w];
    }
}

void SkinCells::set_brick(uint64_t word, uint64_t j, uint64_t k) {
  const SampleGrid& grid = *alive_.grid;
  const uint64_t i = word * bits_per_word;
  axes_[0].set(i, std::min(side, grid.nx - i));
  axes_[1].set(j, std::min(side, alive_.y1 - j));
  axes_[2].set(k, std::min(side, alive_.z1 - k));
  for (uint32_t n = 0; n < axes_[0].count; ++n) axes_[0].at[n] = grid.x(i + n);
  for (uint32_t n = 0; n < axes_[1].count; ++n) axes_[1].at[n] = grid.y(j + n);
  for (uint32_t n = 0; n < axes_[2].count; ++n) axes_[2].at[n] = grid.z(k + n);
  size_t corners = 1;
  for (const Axis& axis : axes_) corners *= axis.cells + 1;
  corners_.resize(corners);
  is_known_.assign(corners, 0);
}

bool SkinCells::any_alive(const Cells& cells) const {
  const uint64_t mask = bits_between(axes_[0].begin(cells.low[0]), axes_[0].end(cells.high[0] - 1));
  for (uint32_t k = axes_[2].begin(cells.low[2]); k < axes_[2].end(cells.high[2] - 1); ++k)
    for (uint32_t j = axes_[1].begin(cells.low[1]); j < axes_[1].end(cells.high[1] - 1); ++j)
      if (alive_word(j, k) & mask) return true;
  return false;
}

/// The box of the samples that may be alive.
Box3 SkinCells::samples_box(const Cells& cells) const {
  Box3 box;
  for (int a = 0; a < 3; ++a) {
    box.min[a] = axes_[a].at[axes_[a].begin(cells.low[a])];
    box.max[a] = axes_[a].at[axes_[a].end(cells.high[a] - 1) - 1];
  }
  const Box3& bounds = skin_.shape().bounds();
  return {max(box.min, bounds.min), min(box.max, bounds.max)};
}

BoundarySearch::Range SkinCells::ask_box(const Box3& box) {
  const Interval thickness = skin_.thickness().range(box);
  const Vec3 centre = (box.min + box.max) * 0.5;
  const double reach = 0.5 * length(box.extent()) + margin_;
  return search_.compare(centre, thickness.low - reach, thickness.high + reach, part_);
}

void SkinCells::divide(const Cells& cells) {
  check_cancelled();
  if (!any_alive(cells)) return;
  bool is_cell = true, is_sample = true;
  for (int a = 0; a < 3; ++a) {
    is_cell = is_cell && cells.high[a] - cells.low[a] == 1;
    is_sample = is_sample && axes_[a].step == 1;
  }
  if (!(is_cell && is_sample)) {
    const Box3 box = samples_box(cells);
    const Range depth = ask_box(box);
    if (depth == Range::beyond) return;
    if (depth == Range::below) return fill(cells);
    if (!is_cell) {
      // Along the axes that are more than half as long as the longest.
      const Vec3 extent = box.extent();
      const double longest = max_component(extent);
      bool cuts[3], any = false;
      for (int a = 0; a < 3; ++a) {
        cuts[a] = cells.high[a] - cells.low[a] > 1 && extent[a] > 0.5 * longest;
        any = any || cuts[a];
      }
      uint32_t middle[3];
      for (int a = 0; a < 3; ++a) {
        if (!any) cuts[a] = cells.high[a] - cells.low[a] > 1;
        middle[a] = (cells.low[a] + cells.high[a]) / 2;
      }
      for (int part = 0; part < 8; ++part) {
        Cells half = cells;
        bool is_part = true;
        for (int a = 0; a < 3; ++a) {
          const bool is_upper = part >> a & 1;
          if (is_upper && !cuts[a]) is_part = false;
          if (cuts[a]) (is_upper ? half.low[a] : half.high[a]) = middle[a];
        }
        if (is_part) divide(half);
      }
      return;
    }
  }
  fill_cell(cells);
}

void SkinCells::fill(const Cells& cells) {
  const uint64_t mask = bits_between(axes_[0].begin(cells.low[0]), axes_[0].end(cells.high[0] - 1));
  for (uint32_t k = axes_[2].begin(cells.low[2]); k < axes_[2].end(cells.high[2] - 1); ++k)
    for (uint32_t j = axes_[1].begin(cells.low[1]); j < axes_[1].end(cells.high[1] - 1); ++j)
      skin_word(j, k) |= mask;
}

const SkinCells::Corner& SkinCells::corner(const uint32_t (&at)[3]) {
  const size_t index =
      at[0] + (axes_[0].cells + 1) * (at[1] + static_cast<size_t>(axes_[1].cells + 1) * at[2]);
  if (!is_known_[index]) {
    Vec3 p;
    for (int a = 0; a < 3; ++a) p[a] = axes_[a].at[axes_[a].sample(at[a])];
    const BoundarySearch::Foot foot = search_.nearest(p, part_);
    part_ = foot.part;
    corners_[index] = {squared(std::max(0.0, foot.distance - error_)), foot.point};
    is_known_[index] = 1;
  }
  return corners_[index];
}

void SkinCells::fill_cell(const Cells& cell) {
  const Parameter& parameter = skin_.thickness();
  Corner corners[8];
  double origin[3], width[3];
  for (int a = 0; a < 3; ++a) {
    const Axis& axis = axes_[a];
    origin[a] = axis.at[axis.begin(cell.low[a])];
    width[a] = axis.at[axis.sample(axis.upper_corner(cell.low[a]))] - origin[a];
  }
  double greatest = 0;  // of the values in the lower bound
  const bool is_sample = axes_[0].step == 1 && axes_[1].step == 1 && axes_[2].step == 1;
  if (!is_sample) {
    for (int n = 0; n < 8; ++n) {
      uint32_t at[3];
      for (int a = 0; a < 3; ++a)
        at[a] = n >> a & 1 ? axes_[a].upper_corner(cell.low[a]) : cell.low[a];
      corners[n] = corner(at);
      greatest = std::max(greatest, corners[n].min_squared);
    }
    for (double w : width) greatest += w * w;
  }
  const uint32_t i0 = axes_[0].begin(cell.low[0]), i1 = axes_[0].end(cell.low[0]);
  double thickness = parameter.range().high;
  double above = squared(thickness + margin_) + rounding * greatest;
  double below = thickness > margin_ ? squared(thickness - margin_) : -1;
  for (uint32_t k = axes_[2].begin(cell.low[2]); k < axes_[2].end(cell.low[2]); ++k)
    for (uint32_t j = axes_[1].begin(cell.low[1]); j < axes_[1].end(cell.low[1]); ++j) {
      uint64_t rest = alive_word(j, k) & bits_between(i0, i1);
      if (!rest) continue;
      const double y = axes_[1].at[j] - origin[1], z = axes_[2].at[k] - origin[2];
      const double of_y = width[1] > 0 ? y / width[1] : 0, of_z = width[2] > 0 ? z / width[2] : 0;
      double ends[2];
      for (int n = 0; n < 2; ++n) {
        const auto at = [&](int m) { return corners[m + n].min_squared; };
        const double low = at(0) + of_y * (at(2) - at(0)), high = at(4) + of_y * (at(6) - at(4));
        ends[n] = low + of_z * (high - low);
      }
      const double less = y * (width[1] - y) + z * (width[2] - z);
      uint64_t in_skin = 0;
      for (; rest; rest &= rest - 1) {
        const uint32_t i = static_cast<uint32_t>(std::countr_zero(rest));
        const Vec3 p{axes_[0].at[i], axes_[1].at[j], axes_[2].at[k]};
        bool is_skin = false, is_decided = false;
        if (!is_sample) {
          if (!parameter.is_constant()) {
            thickness = parameter.at(p);
            above = squared(std::max(thickness, 0.0) + margin_) + rounding * greatest;
            below = thickness > margin_ ? squared(thickness - margin_) : -1;
          }
          const double x = p.x - origin[0], of_x = width[0] > 0 ? x / width[0] : 0;
          const double least = ends[0] + of_x * (ends[1] - ends[0]) - less - x * (width[0] - x);
          is_decided = least > above;
          for (int n = 0; n < 8 && !is_decided; ++n) {
            const Vec3 away = p - corners[n].foot;
            is_decided = is_skin = dot(away, away) < below;
          }
        }
        if (!is_decided) is_skin = skin_.find(p, part_);
        if (is_skin) in_skin |= uint64_t{1} << i;
      }
      skin_word(j, k) |= in_skin;
    }
}

}  // namespace msq

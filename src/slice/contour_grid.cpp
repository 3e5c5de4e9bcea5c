// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_grid.h"

#include <algorithm>

#include "base/sample_grid.h"
#include "base/status.h"
#include "query/membership.h"
#include "slice/contour_points.h"
#include "slice/contour_samples.h"
#include "slice/contour_struts.h"

namespace msq {

namespace {

/// follow_ring() loads two bytes for two nodes.
constexpr uint64_t columns_beyond = 16;

}  // namespace

void ContourAxis::check(double low, double high, double pitch, const char* name) {
  constexpr double max_nodes = 0x1p31 - 256, max_index = 0x1p40;
  const double nodes = (high - low) / pitch;
  if (!(nodes < max_nodes))
    fail(Status::limit, "%g nodes of a pitch of %g along %s; the limit is %.0f", nodes, pitch, name,
         max_nodes);
  const double far = std::max(std::abs(low), std::abs(high)) / pitch;
  if (!(far < max_index))
    fail(Status::limit,
         "the window reaches %g pitches of %g from the origin along %s; the limit is %g", far,
         pitch, name, max_index);
}

ContourAxis::ContourAxis(double low, double high, double pitch)
    : low_(low), high_(high), pitch_(pitch), inverse_pitch_(1 / pitch) {
  constexpr double shift = 0.3125;
  // Whole numbers below 2^41 times three digits: exact.
  const auto node = [&](double k) { return (k + shift) * pitch; };
  double k = std::floor(low / pitch);
  while (node(k) < low + 0.25 * pitch) ++k;
  first_ = node(k);
  while (node(k + static_cast<double>(inner_)) <= high - 0.25 * pitch) {
    const double left = high - 0.25 * pitch - node(k + static_cast<double>(inner_));
    inner_ += std::max<uint64_t>(1, static_cast<uint64_t>(left / pitch));
  }
}

void ContourGrid::check(LayerPlane plane, const double window_min[2], const double window_max[2],
                        double pitch) {
  ContourAxis::check(window_min[0], window_max[0], pitch, plane.u_axis() == 0 ? "x" : "y");
  ContourAxis::check(window_min[1], window_max[1], pitch, plane.v_axis() == 1 ? "y" : "z");
}

ContourGrid::ContourGrid(LayerPlane plane, const double window_min[2], const double window_max[2],
                         double pitch)
    : plane_(plane),
      u_(window_min[0], window_max[0], pitch),
      v_(window_min[1], window_max[1], pitch),
      pitch_(pitch),
      row_words_(words_for(uint64_t{right_edge()} + 2 + columns_beyond)) {}

uint64_t ContourGrid::bytes(const Model& model, const Scales& resolved) const {
  SampleGrid grid;
  grid.nx = u_.inner() + 1;
  grid.ny = v_.inner() + 1;
  grid.nz = 1;
  return (words() + 2 * words_for(grid.nx) * grid.ny + v_.inner() +
          fill_slab_scratch_words(model, resolved, grid, 1)) *
         sizeof(uint64_t);
}

void ContourGrid::find_nodes(const Model& model, const Scales& resolved, const Job* job) {
  memory_->bits.assign(words(), 0);
  const uint64_t across = u_.inner(), rows = v_.inner();
  const double u0 = u_.first(), v0 = v_.first();
  find_part(model, resolved, {u0, v0, across, rows, first_inner, 2}, job);
  for (const uint32_t row : {bottom_edge(), top_edge()})
    find_part(model, resolved, {u0, v(row), across, 1, first_inner, row}, job);
  for (const uint32_t column : {uint32_t{left_edge}, right_edge()}) {
    find_part(model, resolved, {u(column), v0, 1, rows, column, 2}, job);
    for (const uint32_t row : {bottom_edge(), top_edge()})
      find_part(model, resolved, {u(column), v(row), 1, 1, column, row}, job);
  }
}

void ContourGrid::find_nodes(const PlaneStruts& struts, const ContourGrid& shape,
                             ContourPoints& points) {
  std::vector<uint64_t>& bits = memory_->bits;
  bits.assign(words(), 0);
  std::vector<GridNode> doubtful;
  struts.draw(*this, {bits.data(), row_words_, doubtful}, points.job());
  std::erase_if(doubtful, [&](const GridNode& n) { return inside(n.column, n.row); });
  points.clear();
  for (const GridNode& n : doubtful) points.add({u(n.column), v(n.row)});
  const std::vector<uint8_t>& held = points.find_inside();
  for (size_t i = 0; i < doubtful.size(); ++i)
    bits[doubtful[i].row * row_words_ + doubtful[i].column / 64] |= uint64_t{held[i]}
                                                                    << (doubtful[i].column % 64);
  for (size_t w = 0; w < bits.size(); ++w) bits[w] &= shape.memory_->bits[w];
}

void ContourGrid::find_part(const Model& model, const Scales& resolved, const Part& part,
                            const Job* job) {
  const SampleBlock block{part.u, part.v, pitch_, pitch_, part.across, part.rows};
  for_sample_rows(model, resolved, plane_, block, job, [&](uint64_t j, const uint64_t* words) {
    put_row(words, part, part.row + static_cast<uint32_t>(j));
  });
}

void ContourGrid::put_row(const uint64_t* words, const Part& part, uint32_t row) {
  uint64_t* const out = memory_->bits.data() + row * row_words_ + part.column / 64;
  if (part.column % 64 == 0)
    for (size_t w = 0; w < words_for(part.across); ++w) out[w] |= words[w];
  else
    *out |= words[0] << (part.column % 64);  // an edge: one node
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "cell/graded_period.h"

#include <algorithm>
#include <cmath>

#include "base/status.h"
#include "cell/neighbourhood.h"

namespace msq {

namespace {

void check(const std::vector<GradedPeriod::Knot>& knots) {
  if (knots.empty() || knots.size() > GradedPeriod::max_knots)
    fail(Status::argument, "a period has %zu positions; it must have from 1 to %zu", knots.size(),
         GradedPeriod::max_knots);
  double smallest = knots[0].cell_size, largest = smallest;
  for (size_t i = 0; i < knots.size(); ++i) {
    const double size = knots[i].cell_size, position = knots[i].position;
    if (!(size >= GradedPeriod::min_size && size <= GradedPeriod::max_size))
      fail(Status::argument, "period.cell_sizes[%zu] is %g; it must be from 1e-75 to 1e75", i,
           size);
    if (!std::isfinite(position))
      fail(Status::argument, "period.positions[%zu] is %g; it must be finite", i, position);
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
    if (largest > GradedPeriod::max_ratio * smallest)
      fail(Status::argument,
           "period.cell_sizes run from %g to %g up to index %zu; the largest may be %g times the "
           "smallest",
           smallest, largest, i, GradedPeriod::max_ratio);
    if (i == 0) continue;
    const double before = knots[i - 1].position;
    if (!(position > before))
      fail(Status::argument,
           "period.positions[%zu] is %.17g, not above the one before it, %.17g: the period would "
           "fold there",
           i, position, before);
    const double least = GradedPeriod::min_distance * std::min(size, knots[i - 1].cell_size);
    if (!(position - before >= least))
      fail(Status::argument,
           "period.positions[%zu] is %.17g, %g above the one before it; cells of these sizes need "
           "%g",
           i, position, position - before, least);
  }
}

}  // namespace

GradedPeriod::GradedPeriod(int axis, const std::vector<Knot>& knots) : axis_(axis) {
  check(knots);
  const auto frequency_of = [](const Knot& knot) { return 1 / knot.cell_size; };
  least_ = most_ = frequency_of(knots[0]);
  pieces_.push_back({knots[0].position, 0, frequency_of(knots[0]), 0});
  for (size_t i = 0; i < knots.size(); ++i) {
    Piece piece{knots[i].position, 0, frequency_of(knots[i]), 0};
    least_ = std::min(least_, piece.frequency);
    most_ = std::max(most_, piece.frequency);
    if (i > 0) {
      const Piece& before = pieces_.back();
      const double d = piece.start - before.start;
      piece.cells = before.cells + d * (before.frequency + before.bend * d);
    }
    if (i + 1 < knots.size())
      piece.bend = (frequency_of(knots[i + 1]) - piece.frequency) /
                   (2 * (knots[i + 1].position - piece.start));
    pieces_.push_back(piece);
  }
  const double at_origin = cells(0);
  for (size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    piece.cells -= at_origin;
    if (!(std::abs(piece.cells) < max_cell_index))
      fail(Status::limit,
           "period.positions[%zu] is %g, %g cells from the grid's origin; the limit is %g",
           i > 0 ? i - 1 : 0, piece.start, std::abs(piece.cells), max_cell_index);
    max_cells_ = std::max(max_cells_, std::abs(piece.cells));
  }
}

size_t GradedPeriod::knots_to(double s) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), s,
                                      [](double v, const Piece& p) { return v < p.start; });
  return static_cast<size_t>(after - pieces_.begin()) - 1;
}

double GradedPeriod::position_of(double u) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), u,
                                      [](double v, const Piece& p) { return v < p.cells; });
  const Piece& p = *(after - 1);
  const double d = u - p.cells;
  const double slope = std::sqrt(std::max(0.0, p.frequency * p.frequency + 4 * (p.bend * d)));
  return p.start + 2 * d / (p.frequency + slope);
}

double GradedPeriod::error(double u) const {
  return 0x1p-49 * (max_cells_ + std::abs(u));
}

GradedPeriod::Bounds GradedPeriod::over(Interval s) const {
  const size_t first = knots_to(s.low), last = knots_to(s.high);
  const double at_low = frequency(s.low), at_high = frequency(s.high);
  Bounds bounds{std::min(at_low, at_high), std::max(at_low, at_high), 0};
  for (size_t i = first; i <= last; ++i) {
    if (i > first) {
      bounds.least = std::min(bounds.least, pieces_[i].frequency);
      bounds.most = std::max(bounds.most, pieces_[i].frequency);
    }
    bounds.bend = std::max(bounds.bend, std::abs(pieces_[i].bend));
  }
  // Frequencies are rounded.
  return {bounds.least * (1 - 0x1p-48), bounds.most * (1 + 0x1p-48), bounds.bend * (1 + 0x1p-48)};
}

double GradedPeriod::distance_to(double s, double limit, double most) const {
  if (frequency(s) * (1 + 0x1p-48) > limit) return 0;
  // The frequency is linear on a piece, so it passes the limit at most once there. Computed places
  // are rounded by less than 2^-46 of the piece's length.
  const size_t at = knots_to(s);
  const auto reach = [&](double distance, double length) {
    most = std::min(most, std::max(0.0, distance * (1 - 0x1p-46) - 0x1p-46 * length));
  };
  for (size_t i = std::max<size_t>(at, 1); i + 1 < pieces_.size(); ++i) {
    const double ahead = pieces_[i].start - s;
    if (ahead >= most) break;
    const double f = pieces_[i].frequency, g = pieces_[i + 1].frequency;
    const double length = pieces_[i + 1].start - pieces_[i].start;
    if (g > limit) reach(ahead + length * std::max(0.0, (limit - f) / (g - f)), length);
  }
  for (size_t i = std::min(at, pieces_.size() - 2); i > 0; --i) {
    const double behind = s - pieces_[i + 1].start;
    if (behind >= most) break;
    const double f = pieces_[i].frequency, g = pieces_[i + 1].frequency;
    const double length = pieces_[i + 1].start - pieces_[i].start;
    if (f > limit) reach(behind + length * std::max(0.0, (limit - g) / (f - g)), length);
  }
  return most;
}

void GradedPeriod::describe(HashInput& input) const {
  input.integer(static_cast<uint64_t>(axis_));
  input.integer(pieces_.size());
  for (const Piece& piece : pieces_) {
    input.number(piece.start);
    input.number(piece.frequency);
  }
}

}  // namespace msq

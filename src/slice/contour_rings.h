// SPDX-License-Identifier: Apache-2.0
// The crossings of a section ring by ring, each ring as a run of an array. What follows reads them
// in that order, again and again, so each ring is followed through the section just once.
#pragma once

#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/vec2.h"
#include "slice/contour_section.h"

namespace msq {

/// A crossing in its ring, and its edge.
struct RingCrossing {
  Vec2 at;
  uint32_t column, row;
};

class ContourRings {
 public:
  /// Follows the rings of a section; its crossings then know the numbers of their rings.
  ContourRings(ContourSection& section, const Job* job);

  struct Ring {
    uint32_t first, end;  ///< its crossings
    uint32_t beside;      ///< a ring that borders on the same; none if nothing is around both
    bool is_hole;
    bool is_closed;  ///< none of its crossings lies beyond the window
  };
  static constexpr uint32_t none = UINT32_MAX;
  /// In the order of their lowest rows.
  const std::vector<Ring>& rings() const { return rings_; }

  const ContourGrid& grid() const { return grid_; }
  double margin() const { return margin_; }
  uint32_t count() const { return static_cast<uint32_t>(memory_->crossings.size()); }
  const RingCrossing& operator[](uint32_t i) const { return memory_->crossings[i]; }

  bool is_horizontal(uint32_t i) const { return memory_->kinds[i] & horizontal; }
  /// Whether the first node of its edge is inside.
  bool starts_inside(uint32_t i) const { return memory_->kinds[i] & first_inside; }
  bool is_beyond(uint32_t i) const { return memory_->kinds[i] & beyond; }
  /// Whether it lies on an edge of the window.
  bool is_on_seam(uint32_t i) const { return memory_->kinds[i] & seam; }
  bool is_before_saddle(uint32_t i) const { return memory_->kinds[i] & saddle; }

  /// The cell that follows a crossing.
  struct Cell {
    Vec2 low, high;
  };
  Cell cell_of(uint32_t i) const;
  /// Ends of the edge.
  double low(uint32_t i) const {
    const RingCrossing& c = memory_->crossings[i];
    return is_horizontal(i) ? grid_.u(c.column) : grid_.v(c.row);
  }
  double high(uint32_t i) const {
    const RingCrossing& c = memory_->crossings[i];
    return is_horizontal(i) ? grid_.u(c.column + 1) : grid_.v(c.row + 1);
  }

  static constexpr uint64_t bytes_of_crossing = sizeof(RingCrossing) + 1;

 private:
  enum : uint8_t { horizontal = 1, first_inside = 2, beyond = 4, seam = 8, saddle = 16 };

  /// Whether the ring is closed.
  bool follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row, const Job* job);

  const ContourGrid& grid_;
  const double margin_;
  std::vector<Ring> rings_;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<RingCrossing> crossings;
    std::vector<uint8_t> kinds;
    size_t bytes() const { return crossings.capacity() * sizeof(RingCrossing) + kinds.capacity(); }
  };
  const Borrowed<Memory> memory_;
};

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// The pieces of rings that may be farther from the boundary than the tolerance, as the crossings
// around them tell. A piece leads from one crossing to the next.
//
// Lines through the crossings before and behind a piece meet at a point X. The triangle of X and
// the piece's crossings holds the boundary where it turns one way, so pieces whose triangle is no
// higher than the tolerance are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "slice/contour_bends.h"
#include "slice/contour_rings.h"
#include "slice/contour_room.h"

namespace msq {

/// A piece, or a part of one.
struct ContourPiece {
  uint32_t id = 0, next = 0;  // crossings
  int depth = 0;
  int turn = 0;  // where known: 1: the boundary turns left between its ends, -1: right
  bool has_triangle = false;
  bool is_inside = false;  // its middle; where `turn` is not known it is found later
  ContourRoom::Beside beside = {};
  Vec2 a, b;                  // its ends
  Vec2 before, behind;        // points that tell about the direction there; the ends if none does
  double begin = 0, end = 1;  // orders of a and b
  double bend = 0;            // of an arc: how far its middle is from the chord, to the right; or 0

  Vec2 middle() const { return (a + b) * 0.5; }
  Vec2 arc() const;  // its middle
};

class ContourSuspects {
 public:
  /// `has_struts`: they give the crossings.
  ContourSuspects(const ContourRings& rings, double tolerance, bool has_struts,
                  const ContourRoom& room);

  /// Adds the next pieces, in the order of crossings: so many that they stay in the core's cache.
  /// False if none is left.
  bool add_some(std::vector<ContourPiece>& pieces, const Job* job);
  /// What these pieces need, whatever has been kept of earlier ones.
  uint64_t bytes() const {
    return sizeof(Memory) + memory_->bends.size() * sizeof(uint64_t) +
           memory_->closed.size() * sizeof(RingPoints);
  }

 private:
  struct Suspect {
    uint32_t id, next;
    bool has_direction;
  };

  void find_all_bends(const Job* job);
  void suspect(const ContourRings::Ring& ring, uint32_t id);
  void add_block(std::vector<ContourPiece>& pieces);

  const ContourRings& rings_;
  const double tolerance_;
  const BendLimits limits_;
  const ContourRoom& room_;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<uint64_t> bends;     // see find_bends()
    std::vector<RingPoints> closed;  // rings
    PieceBlock block;                // of suspects
    Suspect suspects[PieceBlock::capacity];
    size_t bytes() const {
      return sizeof *this + bends.capacity() * sizeof(uint64_t) +
             closed.capacity() * sizeof(RingPoints);
    }
  };
  const Borrowed<Memory> memory_;
  size_t count_ = 0;   // of the block
  size_t ring_ = 0;    // the next to look along
  uint32_t next_ = 0;  // the next crossing
};

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_suspects.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

namespace msq {

namespace {

constexpr size_t pieces_at_once = 4096;
/// Curvatures of triples of points are even where those in the middle exceed the others by no more
/// than this factor.
constexpr double even_curvature = 1.6;
/// Of the tolerance: arcs that are no higher than that are probably near enough to their chords, so
/// their middles are not taken. Corners of regular polygons look like such arcs.
constexpr double flat_arc = 0.5;
/// Of the tolerance.
constexpr double highest_arc = 4;

BendLimits limits_of(const ContourRings& rings, double tolerance, bool has_struts) {
  // Corners may hide others behind them, so pieces beside corners are looked into. Struts are
  // round: corners are few, and looking behind every bend would take a fifth of the layer's time.
  const bool is_fine = rings.gaps().parts() > 1;
  const double corner = has_struts ? (is_fine ? 2 : 4) : (is_fine ? 0 : 0.125);
  return {tolerance, rings.grid().pitch() / 16, corner * tolerance, flat_arc * tolerance};
}

/// Curvature of the circle through three points, positive where they turn left.
double curvature(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 ab = b - a, bc = c - b, ac = c - a;
  const double sizes = dot(ab, ab) * dot(bc, bc) * dot(ac, ac);
  return sizes > 0 ? 2 * cross(ab, bc) / std::sqrt(sizes) : 0;
}

/// How far an arc from a to b is from its chord, to the right, where the six points lie on a curve
/// that bends about evenly; 0 where they do not. At a corner between a and b the curvature of
/// triples that hold both is far above that of the outer ones; above that of one of them, where the
/// other holds a second corner.
double bend_of(Vec2 before_p, Vec2 p, Vec2 a, Vec2 b, Vec2 q, Vec2 behind_q, double least) {
  const double k1 = curvature(p, a, b), k2 = curvature(a, b, q);
  const double bend = 0.125 * 0.5 * (k1 + k2) * dot(b - a, b - a);
  if (!(k1 * k2 > 0 && std::abs(bend) > least)) return 0;
  const double k0 = curvature(before_p, p, a);
  if (!(k0 * k1 > 0)) return 0;
  const double k3 = curvature(b, q, behind_q);
  if (!(k3 * k1 > 0)) return 0;
  const double inner = std::max(std::abs(k1), std::abs(k2));
  if (!(inner <= even_curvature * std::min(std::abs(k0), std::abs(k3)))) return 0;
  return bend;
}

}  // namespace

Vec2 ContourPiece::arc() const {
  return middle() - left_of(unit(b - a)) * bend;
}

ContourSuspects::ContourSuspects(const ContourRings& rings, double tolerance, bool has_struts,
                                 const ContourRoom& room)
    : rings_(rings),
      tolerance_(tolerance),
      limits_(limits_of(rings, tolerance, has_struts)),
      room_(room) {}

void ContourSuspects::find_all_bends(const Job* job) {
  const size_t count = rings_.count();
  memory_->bends.resize((count + 63) / 64);
  constexpr size_t at_once = size_t{1} << 18;
  for (size_t first = 0; first < count; first += at_once) {
    check_cancelled(job);
    find_bends(rings_.x() + first, rings_.y() + first, std::min(at_once, count - first), limits_,
               memory_->bends.data() + first / 64);
  }
  memory_->closed.clear();
  for (const ContourRings::Ring& ring : rings_.rings())
    if (ring.is_closed) memory_->closed.push_back({ring.first, ring.end});
  find_bends_at_ends(rings_.x(), rings_.y(), memory_->closed, limits_, memory_->bends.data());
}

bool ContourSuspects::add_some(std::vector<ContourPiece>& pieces, const Job* job) {
  CancelPoll poll(job);
  const std::vector<ContourRings::Ring>& rings = rings_.rings();
  if (ring_ == 0 && next_ == 0) find_all_bends(job);
  for (; ring_ < rings.size() && pieces.size() < pieces_at_once; ++ring_) {
    const ContourRings::Ring& ring = rings[ring_];
    next_ = std::max(next_, ring.first);
    while (next_ < ring.end) {
      poll();
      // Most pieces of closed rings are short or nearly straight.
      const uint64_t rest =
          ring.is_closed ? memory_->bends[next_ / 64] >> (next_ % 64) : uint64_t{1};
      next_ = rest ? next_ + static_cast<uint32_t>(std::countr_zero(rest)) : (next_ / 64 + 1) * 64;
      if (!rest || next_ >= ring.end) continue;
      suspect(ring, next_++);
      if (count_ < PieceBlock::capacity) continue;
      add_block(pieces);
      if (pieces.size() >= pieces_at_once) return true;
    }
  }
  add_block(pieces);
  return !pieces.empty();
}

/// Puts the piece that begins at a crossing into the block, unless it is too short to bend.
void ContourSuspects::suspect(const ContourRings::Ring& ring, uint32_t id) {
  const auto behind = [&](uint32_t i) { return i + 1 < ring.end ? i + 1 : ring.first; };
  const auto before = [&](uint32_t i) { return i > ring.first ? i - 1 : ring.end - 1; };
  const auto is_near = [&](Vec2 p, Vec2 q) {
    return dot(q - p, q - p) < limits_.close * limits_.close;
  };
  const uint32_t next = behind(id);
  if (rings_.is_beyond(id) || rings_.is_beyond(next) || rings_.is_before_saddle(id)) return;
  // A ring leaves divided cells anywhere on a whole cell's edge, so not within the part.
  if (rings_.is_fine(id) && !rings_.is_fine(next)) return;
  const Vec2 a = rings_.at(id), b = rings_.at(next);
  if (dot(b - a, b - a) <= tolerance_ * tolerance_) return;
  uint32_t p = before(id), q = behind(next);
  // The direction of the boundary at the edge of a window is not known.
  const bool has_direction = !rings_.is_beyond(p) && !rings_.is_beyond(q);
  if (has_direction) {
    // A crossing that is very near tells little about the direction.
    if (is_near(rings_.at(p), a) && !rings_.is_beyond(before(p))) p = before(p);
    if (is_near(rings_.at(q), b) && !rings_.is_beyond(behind(q))) q = behind(q);
    const Vec2 points[] = {rings_.at(before(p)), rings_.at(p),        a, b,
                           rings_.at(q),         rings_.at(behind(q))};
    for (size_t n = 0; n < std::size(points); ++n) {
      memory_->block.x[n][count_] = points[n].x;
      memory_->block.y[n][count_] = points[n].y;
    }
  }
  memory_->suspects[count_++] = {id, next, has_direction};
}

/// Adds the pieces of the block that may bend.
void ContourSuspects::add_block(std::vector<ContourPiece>& pieces) {
  PieceBlock& block = memory_->block;
  const size_t count = std::exchange(count_, 0);
  find_bends(block, count, limits_);
  for (size_t i = 0; i < count; ++i) {
    const Suspect& s = memory_->suspects[i];
    if (!s.has_direction) {
      const Vec2 a = rings_.at(s.id), b = rings_.at(s.next);
      pieces.push_back({.id = s.id, .next = s.next, .a = a, .b = b, .before = a, .behind = b});
      continue;
    }
    const PieceBlock::Bits& bits = block.bits[i / 64];
    const auto bit = [&](uint64_t word) { return (word >> (i % 64) & 1) != 0; };
    if (!bit(bits.bends)) continue;
    const auto at = [&](size_t n) { return Vec2{block.x[n][i], block.y[n][i]}; };
    ContourPiece& piece = pieces.emplace_back(
        ContourPiece{.id = s.id,
                     .next = s.next,
                     .turn = int{bit(bits.turns_left)} - int{bit(bits.turns_right)},
                     .has_triangle = bit(bits.has_triangle),
                     .is_inside = bit(bits.turns_left),
                     .a = at(2),
                     .b = at(3),
                     .before = at(1),
                     .behind = at(4)});
    if (!bit(bits.may_be_arc)) continue;
    piece.bend = bend_of(at(0), at(1), at(2), at(3), at(4), at(5), limits_.arc);
    if (!(std::abs(piece.bend) <= highest_arc * tolerance_ && room_.holds(s.id, {}, piece.arc())))
      piece.bend = 0;
  }
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/section/section_cells.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"

namespace msq {

SectionCells::SectionCells(const SectionSeeds& seeds, const Box2& window) : seeds_(seeds) {
  constexpr double seeds_per_square = 4, max_squares = 0x1p26;
  const Box2 area = window.grown(3 * seeds.reach);
  const double count = std::max(1.0, static_cast<double>(seeds.seeds.size()));
  const Vec2 extent = area.extent();
  low_ = area.min;
  side_ = std::max(std::sqrt(extent.x * extent.y * seeds_per_square / count),
                   std::sqrt(extent.x * extent.y / max_squares));
  columns_ = static_cast<int>(extent.x / side_) + 1;
  rows_ = static_cast<int>(extent.y / side_) + 1;
  starts_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  const auto square = [this](const SectionSeed& s) {
    return static_cast<size_t>(row(s.position.y)) * static_cast<size_t>(columns_) +
           static_cast<size_t>(column(s.position.x));
  };
  CancelPoll poll(current_job());
  for (const SectionSeed& s : seeds.seeds) {
    poll();
    ++starts_[square(s) + 1];
  }
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  members_.resize(seeds.seeds.size());
  CountedVector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t i = 0; i < members_.size(); ++i) {
    poll();
    members_[next[square(seed(i))]++] = i;
  }
  find_hidden();
}

// Of seeds one above the other, the plane is nearer to one, or in the face between them. The others
// must not cut cells: in the face, sides that two seeds bound alike would be cut anywhere by
// rounding.
void SectionCells::find_hidden() {
  CancelPoll poll(current_job());
  hidden_.resize(seeds_.seeds.size());
  for (uint32_t i = 0; i < hidden_.size(); ++i) {
    poll();
    hidden_[i] = is_hidden(i);
  }
  uint32_t kept = 0;
  for (size_t square = 0, at = 0; square + 1 < starts_.size(); ++square) {
    for (; at < starts_[square + 1]; ++at)
      if (!hidden_[members_[at]]) members_[kept++] = members_[at];
    starts_[square + 1] = kept;
  }
  members_.resize(kept);
}

bool SectionCells::is_hidden(uint32_t own) const {
  const SectionSeed& mine = seed(own);
  const Vec2 p = mine.position;
  const double near = seeds_.same_place(p);
  for (int j = row(p.y - near); j <= row(p.y + near); ++j)
    for (int i = column(p.x - near); i <= column(p.x + near); ++i) {
      const size_t square =
          static_cast<size_t>(j) * static_cast<size_t>(columns_) + static_cast<size_t>(i);
      for (uint32_t at = starts_[square]; at < starts_[square + 1]; ++at) {
        const uint32_t other = members_[at];
        const Vec2 d = seed(other).position - p;
        if (other == own || !(std::max(std::abs(d.x), std::abs(d.y)) <= near)) continue;
        const double weight = seed(other).weight;
        if (weight < mine.weight || (weight == mine.weight && other < own)) return true;
      }
    }
  return false;
}

int SectionCells::column(double x) const {
  return std::clamp(static_cast<int>((x - low_.x) / side_), 0, columns_ - 1);
}

int SectionCells::row(double y) const {
  return std::clamp(static_cast<int>((y - low_.y) / side_), 0, rows_ - 1);
}

const CountedVector<SectionCells::Corner>& SectionCells::cell(uint32_t own) {
  corners_.clear();
  if (hidden_[own]) return corners_;
  const Vec2 p = seed(own).position;
  const double r = 1.01 * seeds_.reach;  // no cell extends beyond the reach
  corners_ = {{{p.x - r, p.y - r}, nobody},
              {{p.x + r, p.y - r}, nobody},
              {{p.x + r, p.y + r}, nobody},
              {{p.x - r, p.y + r}, nobody}};
  measure(own);
  const int x = column(p.x), y = row(p.y);
  // From the seed to the nearest side of its square: what rings of squares about it leave out is
  // at least so much farther away than whole squares.
  const double in_x = p.x - (low_.x + x * side_), in_y = p.y - (low_.y + y * side_);
  const double inner =
      std::max(0.0, std::min(std::min(in_x, side_ - in_x), std::min(in_y, side_ - in_y)));
  for (int ring = 0; ring <= std::max(columns_, rows_) && !corners_.empty(); ++ring) {
    if (ring > 0 && (ring - 1) * side_ + inner > bound_) break;
    const int y0 = std::max(y - ring, 0), y1 = std::min(y + ring, rows_ - 1);
    const int x0 = std::max(x - ring, 0), x1 = std::min(x + ring, columns_ - 1);
    for (int j = y0; j <= y1; ++j) {
      const bool is_whole = std::abs(j - y) == ring;
      for (int i = x0; i <= x1; ++i)
        if (is_whole || std::abs(i - x) == ring) cut(own, i, j);
    }
  }
  return corners_;
}

// A seed j takes a part of the cell of i if there is a corner v with |v - j|^2 + w_j < |v - i|^2 +
// w_i. Then |v - j| is below the greatest distance of a corner from seed i in space, and |j - i| is
// below that plus the greatest distance in the plane.
void SectionCells::measure(uint32_t own) {
  double farthest = 0;
  for (const Corner& c : corners_) {
    const Vec2 d = c.point - seed(own).position;
    farthest = std::max(farthest, dot(d, d));
  }
  bound_ = (std::sqrt(farthest) + std::sqrt(farthest + seed(own).weight)) * (1 + 1e-9);
}

void SectionCells::cut(uint32_t own, int column, int row) {
  const size_t square =
      static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  const SectionSeed& mine = seed(own);
  for (uint32_t at = starts_[square]; at < starts_[square + 1]; ++at) {
    const uint32_t other = members_[at];
    const Vec2 d = seed(other).position - mine.position;
    const double apart = dot(d, d);
    if (other == own || apart > bound_ * bound_ || corners_.empty()) continue;
    cut(own, other, d, apart + (seed(other).weight - mine.weight));
  }
}

// A point u from the own seed stays where 2 u . d <= offset.
void SectionCells::cut(uint32_t own, uint32_t other, Vec2 to_other, double offset) {
  const size_t count = corners_.size();
  gaps_.resize(count);
  bool has_outside = false;
  for (size_t i = 0; i < count; ++i) {
    gaps_[i] = offset - 2 * dot(corners_[i].point - seed(own).position, to_other);
    has_outside |= gaps_[i] < 0;
  }
  if (!has_outside) return;
  next_.clear();
  for (size_t i = 0; i < count; ++i) {
    const size_t j = i + 1 < count ? i + 1 : 0;
    const Corner &a = corners_[i], &b = corners_[j];
    const bool a_stays = gaps_[i] >= 0, b_stays = gaps_[j] >= 0;
    if (a_stays) next_.push_back(a);
    if (a_stays == b_stays) continue;
    const double t = gaps_[i] / (gaps_[i] - gaps_[j]);
    const Vec2 about = a.point + (b.point - a.point) * t;
    next_.push_back({corner(own, a.beyond, other, about), a_stays ? other : a.beyond});
  }
  // A cell that is narrower than rounding is none.
  if (next_.size() < 3) next_.clear();
  std::swap(corners_, next_);
  measure(own);
}

Vec2 SectionCells::corner(uint32_t own, uint32_t before, uint32_t after, Vec2 about) const {
  if (before == nobody) return about;
  uint32_t order[3] = {own, before, after};
  std::sort(order, order + 3);
  const SectionSeed &a = seed(order[0]), &b = seed(order[1]), &c = seed(order[2]);
  const Vec2 to_b = b.position - a.position, to_c = c.position - a.position;
  const double at_b = 0.5 * (dot(to_b, to_b) + (b.weight - a.weight));
  const double at_c = 0.5 * (dot(to_c, to_c) + (c.weight - a.weight));
  const double twice_area = cross(to_b, to_c);
  const Vec2 p = a.position + Vec2{(at_b * to_c.y - at_c * to_b.y) / twice_area,
                                   (at_c * to_b.x - at_b * to_c.x) / twice_area};
  // Where the three seeds lie almost on one line, the crossing of the side is known better.
  const Vec2 off = p - about;
  const bool is_good = std::abs(off.x) + std::abs(off.y) <= 1e-8 * seeds_.reach;
  return is_good ? p : about;
}

}  // namespace msq

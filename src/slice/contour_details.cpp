// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_details.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "slice/contour_line.h"
#include "slice/nearest_unit.h"

namespace msq {

namespace {

/// Halvings of a piece.
constexpr int max_depth = 10;
/// Along a piece, and of the tolerance: where membership tells whether it is near enough to the
/// boundary; see keep_bent().
constexpr double places_beside[] = {0.25, 0.5, 0.75};
constexpr double beside_piece = 0.75;
/// Of the tolerance. Points of the boundary are found as exactly.
constexpr double on_segment = 0.125;

/// Whether segments ab and cd have a point in common.
bool do_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) {
    const double s = cross(q - p, r - p);
    return s > 0 ? 1 : s < 0 ? -1 : 0;
  };
  const auto holds = [](Vec2 p, Vec2 q, Vec2 r) {  // r, on the line through p, q
    return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
           r.y <= std::max(p.y, q.y);
  };
  const int s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
  if (s1 != s2 && s3 != s4) return true;
  return (s1 == 0 && holds(a, b, c)) || (s2 == 0 && holds(a, b, d)) ||
         (s3 == 0 && holds(c, d, a)) || (s4 == 0 && holds(c, d, b));
}

/// Whether a polyline touches itself.
bool is_tangled(std::span<const Vec2> p) {
  for (size_t i = 0; i + 1 < p.size(); ++i) {
    if (p[i] == p[i + 1]) return true;
    if (i + 2 < p.size() && cross(p[i + 1] - p[i], p[i + 2] - p[i + 1]) == 0 &&
        dot(p[i + 1] - p[i], p[i + 2] - p[i + 1]) < 0)
      return true;
    for (size_t j = i + 2; j + 1 < p.size(); ++j)
      if (do_meet(p[i], p[i + 1], p[j], p[j + 1])) return true;
  }
  return false;
}

}  // namespace

void ContourDetails::find(ContourPoints& points) {
  held_ = Reservation(points.model().context().budget, 0, "");
  while (suspects_.add_some(memory_->pieces, points.job())) settle(points);
  hold_memory();
  finish_pieces();
}

/// Takes the memory for as many pieces and points as there are: both halves of each piece, the
/// points that tell about it, and the lines that RingBuilder makes of the points found.
void ContourDetails::hold_memory() {
  constexpr uint64_t points_of_piece = 6;
  constexpr uint64_t of_piece = 3 * sizeof(Piece) + sizeof(Corner) + sizeof(Search) +
                                sizeof(Search*) + points_of_piece * ContourPoints::bytes_of_point;
  constexpr uint64_t of_point = sizeof(DetailPoint) + sizeof(LineRun) + 2 * sizeof(Vec2);
  held_.grow_to(suspects_.bytes() + memory_->pieces.size() * of_piece +
                    memory_->details.size() * of_point + room_.bytes(),
                "the details of contours");
}

/// Looks into the pieces that there are.
void ContourDetails::settle(ContourPoints& points) {
  begin_run();
  hold_memory();
  take_arcs(points);
  while (!memory_->pieces.empty()) {
    hold_memory();
    keep_bent(points);
    take_corners(points);
    split(points);
  }
  merge_runs();
  hold_memory();
}

/// Begins a run of points in the order of crossings.
void ContourDetails::begin_run() {
  if (memory_->runs.empty() || memory_->runs.back() < memory_->details.size())
    memory_->runs.push_back(memory_->details.size());
}

/// Each step found its points in the order of crossings.
void ContourDetails::merge_runs() {
  std::vector<DetailPoint>& details = memory_->details;
  std::vector<size_t>& runs = memory_->runs;
  const auto is_before = [](const DetailPoint& a, const DetailPoint& b) {
    return a.id != b.id ? a.id < b.id : a.order < b.order;
  };
  // Later runs are shorter.
  size_t end = details.size();
  const auto at = [&](size_t i) { return details.begin() + static_cast<ptrdiff_t>(i); };
  while (runs.size() >= 2) {
    const size_t middle = runs.back();
    runs.pop_back();
    std::inplace_merge(at(runs.back()), at(middle), at(end), is_before);
  }
  runs.clear();
}

/// Whether the lines through both ends of a piece and the points before and behind meet beside it.
bool ContourDetails::do_lines_meet(const Piece& piece) {
  const Vec2 d1 = piece.a - piece.before, ab = piece.b - piece.a, d2 = piece.behind - piece.b;
  const double turn1 = cross(d1, ab);
  return turn1 * cross(ab, d2) > 0 && turn1 * cross(d1, d2) > 0;
}

/// Where these lines meet.
ContourDetails::Corner ContourDetails::corner_of(const Piece& piece) const {
  if (!piece.has_triangle) return {};
  const Vec2 d1 = piece.a - piece.before, d2 = piece.behind - piece.b;
  Corner corner;
  corner.at = piece.a + d1 * (cross(piece.b - piece.a, d2) / cross(d1, d2));
  corner.is_possible = room_.holds(piece.id, piece.beside, corner.at);
  if (corner.is_possible || piece.beside.place != 0) return corner;
  const Cell cell = rings_.cell_of(piece.id);
  const double margin = rings_.margin();
  const auto is_beyond = [&](int axis) {
    return corner.at[axis] < cell.low[axis] + margin || corner.at[axis] > cell.high[axis] - margin;
  };
  const int axis = is_beyond(0) ? 0 : 1;
  corner.beside = room_.beside(piece.id, axis, corner.at[axis] > cell.high[axis] - margin);
  corner.is_possible = corner.beside.place != 0 && room_.holds(piece.id, corner.beside, corner.at);
  return corner;
}

/// Takes the middles of arcs where membership confirms the two lines to them: beside the middle and
/// the middle of each line.
void ContourDetails::take_arcs(ContourPoints& points) {
  constexpr size_t places = 3;
  points.clear();
  for (const Piece& piece : memory_->pieces) {
    if (piece.bend == 0) continue;
    const Vec2 to_inside = left_of(unit(piece.b - piece.a)) * (beside_piece * tolerance_);
    const Vec2 arc = piece.arc();
    const Vec2 lines[places] = {(piece.a + arc) * 0.5, arc, (arc + piece.b) * 0.5};
    for (const Vec2 at : lines) {
      points.add(at + to_inside);
      points.add(at - to_inside);
    }
  }
  const std::vector<uint8_t>& inside = points.find_inside();
  begin_run();
  size_t kept = 0, n = 0;
  for (const Piece& piece : memory_->pieces) {
    if (piece.bend != 0) {
      bool is_near = true;
      for (size_t k = 0; k < places; ++k, n += 2) is_near = is_near && inside[n] && !inside[n + 1];
      if (is_near) {
        memory_->details.push_back({piece.id, piece.next, 0.5, piece.arc()});
        continue;
      }
    }
    memory_->pieces[kept++] = piece;
  }
  memory_->pieces.resize(kept);
}

/// Drops pieces that are within the tolerance of the boundary, as membership beside the middle and
/// the quarters of each tells. Where the boundary turns left, it lies to the right of these points,
/// which are inside: the point on that side tells.
///
/// A corner at the fraction f of a piece whose height is h lies beside the quarters and the middle
/// at heights of which the largest is at least 0.75 h (least for f = 1/3). So three quarters of the
/// tolerance leave no such corner out.
void ContourDetails::keep_bent(ContourPoints& points) {
  constexpr size_t places = std::size(places_beside);
  find_sides(points);
  std::vector<Piece>& pieces = memory_->pieces;
  points.clear();
  Vec2* to = points.add_some(places * pieces.size());
  for (const Piece& piece : pieces) {
    const Vec2 along = piece.b - piece.a;
    const double size = piece.is_inside ? -beside_piece : beside_piece;
    const Vec2 aside = left_of(unit(along)) * (size * tolerance_);
    for (const double place : places_beside) *to++ = piece.a + along * place + aside;
  }
  const std::vector<uint8_t>& inside = points.find_inside();
  size_t next = 0, kept = 0;
  for (const Piece& piece : pieces) {
    bool is_bent = false;
    for (size_t k = 0; k < places; ++k, ++next)
      // Along the edges of a window, what is beyond does not count.
      is_bent |= (inside[next] != 0) == piece.is_inside && is_in_window(points.at(next));
    if (!is_bent) continue;
    if (piece.depth < max_depth)
      pieces[kept++] = piece;
    else
      ++unresolved_;
  }
  pieces.resize(kept);
}

/// On which side of the boundary the middles of pieces are, where that is not known.
void ContourDetails::find_sides(ContourPoints& points) {
  std::vector<Piece>& pieces = memory_->pieces;
  points.clear();
  for (const Piece& piece : pieces)
    if (piece.turn == 0) points.add(piece.middle());
  const std::vector<uint8_t>& middles = points.find_inside();
  size_t n = 0;
  for (Piece& piece : pieces)
    if (piece.turn == 0) piece.is_inside = middles[n++] != 0;
}

bool ContourDetails::is_in_window(Vec2 p) const {
  const ContourGrid& grid = rings_.grid();
  return p.x >= grid.u(ContourGrid::left_edge) && p.x <= grid.u(grid.right_edge()) &&
         p.y >= grid.v(grid.bottom_edge()) && p.y <= grid.v(grid.top_edge());
}

void ContourDetails::take_corners(ContourPoints& points) {
  points.clear();
  const auto both_sides = [&](Vec2 p, Vec2 towards_inside) {
    points.add(p + towards_inside * tolerance_);
    points.add(p - towards_inside * tolerance_);
  };
  std::vector<Corner>& corners = memory_->corners;
  corners.clear();
  for (const Piece& piece : memory_->pieces) {
    Corner& corner = corners.emplace_back(corner_of(piece));
    if (!corner.is_possible) continue;
    const Vec2 x = corner.at;
    both_sides((piece.a + x) * 0.5, left_of(unit(x - piece.a)));
    both_sides((x + piece.b) * 0.5, left_of(unit(piece.b - x)));
    const bool is_concave = cross(piece.b - piece.a, x - piece.a) > 0;
    both_sides(x, unit(piece.middle() - x) * (is_concave ? -1.0 : 1.0));
  }
  const std::vector<uint8_t>& inside = points.find_inside();
  begin_run();
  size_t kept = 0, first = 0, number = 0;
  for (const Piece& piece : memory_->pieces) {
    const Corner& corner = corners[number++];
    if (corner.is_possible) {
      bool is_corner = true;
      for (size_t n = first; n < first + 6; n += 2)
        is_corner = is_corner && inside[n] && !inside[n + 1];
      first += 6;
      is_corner = is_corner && room_.take(corner.beside);
      if (is_corner) {
        memory_->details.push_back(
            {piece.id, piece.next, 0.5 * (piece.begin + piece.end), corner.at});
        continue;
      }
    }
    memory_->pieces[kept++] = piece;
  }
  memory_->pieces.resize(kept);
}

/// Where the normal at the middle of a piece leaves the cells that the piece may use.
ContourDetails::Search ContourDetails::search_of(size_t number, const Beside& beside) const {
  const Piece& piece = memory_->pieces[number];
  const Vec2 m = piece.middle();
  const Vec2 d = left_of(unit(piece.b - piece.a)) * (piece.is_inside ? -1.0 : 1.0);
  const Cell cell = room_.cells(piece.id, beside);
  double reach = std::numeric_limits<double>::infinity();
  Search search{number, m, m, beside, 0, false};
  for (int axis = 0; axis < 2; ++axis) {
    const double room = d[axis] > 0 ? cell.high[axis] - rings_.margin() - m[axis]
                                    : m[axis] - rings_.margin() - cell.low[axis];
    if (d[axis] == 0) continue;
    const double size = std::max(0.0, room) / std::abs(d[axis]);
    if (size >= reach) continue;
    reach = size;
    search.axis = axis;
    search.is_high = d[axis] > 0;
  }
  if (std::isfinite(reach)) search.other = m + d * reach;
  return search;
}

/// Keeps those of the searches whose other end has not the membership of the piece's middle.
void ContourDetails::keep_open(std::vector<Search>& searches, std::vector<Search>& closed,
                               ContourPoints& points) const {
  points.clear();
  for (const Search& s : searches) points.add(s.other);
  const std::vector<uint8_t>& ends = points.find_inside();
  size_t kept = 0;
  for (size_t n = 0; n < searches.size(); ++n) {
    const bool is_open = (ends[n] != 0) != memory_->pieces[searches[n].piece].is_inside;
    if (is_open)
      searches[kept++] = searches[n];
    else
      closed.push_back(searches[n]);
  }
  searches.resize(kept);
}

/// From the middle of each piece to where the membership differs, if the piece's cells hold such a
/// place.
std::vector<ContourDetails::Search> ContourDetails::find_searches(ContourPoints& points) {
  std::vector<Search> searches, closed, beyond;
  for (size_t i = 0; i < memory_->pieces.size(); ++i)
    searches.push_back(search_of(i, memory_->pieces[i].beside));
  keep_open(searches, closed, points);
  // The boundary leaves the cell. It may be in the one beside.
  for (const Search& s : closed) {
    const Piece& piece = memory_->pieces[s.piece];
    const Beside other = s.beside.place == 0 ? room_.beside(piece.id, s.axis, s.is_high) : Beside();
    if (other.place != 0)
      beyond.push_back(search_of(s.piece, other));
    else
      ++unresolved_;
  }
  closed.clear();
  keep_open(beyond, closed, points);
  unresolved_ += closed.size();
  searches.insert(searches.end(), beyond.begin(), beyond.end());
  const auto is_before = [](const Search& a, const Search& b) { return a.piece < b.piece; };
  std::inplace_merge(searches.begin(), searches.end() - static_cast<ptrdiff_t>(beyond.size()),
                     searches.end(), is_before);
  return searches;
}

/// Halves the searches until their ends are so near to each other that either is on the boundary.
/// Each by itself, so that no window changes what another one finds.
void ContourDetails::bisect(std::vector<Search>& searches, ContourPoints& points) const {
  std::vector<Search*> open;
  open.reserve(searches.size());
  for (Search& s : searches) open.push_back(&s);
  constexpr int max_halvings = 24;
  for (int round = 0; round < max_halvings; ++round) {
    std::erase_if(open, [&](const Search* s) {
      const Vec2 d = s->other - s->same;
      return dot(d, d) <= tolerance_ * tolerance_ / 64;
    });
    if (open.empty()) break;
    points.clear();
    for (const Search* s : open) points.add((s->same + s->other) * 0.5);
    const std::vector<uint8_t>& inside = points.find_inside();
    for (size_t n = 0; n < open.size(); ++n) {
      Search& s = *open[n];
      const bool is_same = (inside[n] != 0) == memory_->pieces[s.piece].is_inside;
      (is_same ? s.same : s.other) = (s.same + s.other) * 0.5;
    }
  }
}

void ContourDetails::split(ContourPoints& points) {
  std::vector<Search> searches = find_searches(points);
  bisect(searches, points);
  std::vector<Piece>& halves = memory_->halves;
  halves.clear();
  begin_run();
  for (const Search& s : searches) {
    const Piece& piece = memory_->pieces[s.piece];
    const Vec2 at = (s.same + s.other) * 0.5;
    const auto is_free = [&] {
      return s.beside.place == piece.beside.place || room_.take(s.beside);
    };
    if (!room_.holds(piece.id, s.beside, at) || !is_free()) {
      ++unresolved_;
      continue;
    }
    const double order = 0.5 * (piece.begin + piece.end);
    memory_->details.push_back({piece.id, piece.next, order, at});
    const auto add_half = [&](Piece half) {
      // One as short as that is near enough.
      if (length(half.b - half.a) <= tolerance_) return;
      half.id = piece.id;
      half.next = piece.next;
      half.depth = piece.depth + 1;
      half.beside = s.beside;
      half.has_triangle = do_lines_meet(half);
      halves.push_back(half);
    };
    add_half({.a = piece.a,
              .b = at,
              .before = piece.before,
              .behind = piece.b,
              .begin = piece.begin,
              .end = order});
    add_half({.a = at,
              .b = piece.b,
              .before = piece.a,
              .behind = piece.behind,
              .begin = order,
              .end = piece.end});
  }
  memory_->pieces.swap(halves);
}

Vec2 ContourDetails::rounded(Vec2 p) const {
  if (units_ == 0) return p;
  return {nearest_unit(p.x * units_), nearest_unit(p.y * units_)};
}

/// Of the points of one piece, leaves out those on segments between others: between corners,
/// halving finds several. Returns the end of those that remain.
size_t ContourDetails::straighten(size_t first, size_t end) {
  std::vector<DetailPoint>& details = memory_->details;
  if (end - first < 2) return end;
  const Vec2 last = rings_.at(details[first].next);
  Vec2 from = rings_.at(details[first].id);
  const auto at = [&](size_t i) { return i < end ? details[i].at : last; };
  const auto are_on_segment = [&](size_t begin, size_t to) {
    for (size_t i = begin; i < to; ++i)
      if (length(off_segment(at(i), from, at(to))) > on_segment * tolerance_) return false;
    return true;
  };
  size_t kept = first;
  for (size_t next = first; next < end; ++next) {
    const size_t begin = next;
    while (next < end && are_on_segment(begin, next + 1)) ++next;
    if (next == end) break;
    from = at(next);
    details[kept++] = details[next];
  }
  return kept;
}

/// Puts the points of each piece in their final form. Drops those of pieces that would touch
/// themselves.
void ContourDetails::finish_pieces() {
  std::vector<DetailPoint>& details = memory_->details;
  std::vector<Vec2> line;
  size_t kept = 0;
  for (size_t first = 0, end; first < details.size(); first = end) {
    const uint32_t id = details[first].id, next = details[first].next;
    for (end = first; end < details.size() && details[end].id == id;) ++end;
    const size_t straight_end = straighten(first, end);
    line.assign(1, rounded(rings_.at(id)));
    for (size_t i = first; i < straight_end; ++i) line.push_back(rounded(details[i].at));
    line.push_back(rounded(rings_.at(next)));
    if (is_tangled(line)) {
      ++unresolved_;
      continue;
    }
    for (size_t i = first; i < straight_end; ++i) details[kept++] = details[i];
  }
  details.resize(kept);
}

}  // namespace msq

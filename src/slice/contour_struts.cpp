// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_struts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace msq {

namespace {

/// Along an axis.
constexpr double max_cells_of_tile = 64;
/// A bound on the error of struts, relative to the cell: twice the edge_error of foams.
constexpr double strut_error = 1e-6;
constexpr size_t bytes_of_strut = sizeof(PlaneStrut) + sizeof(AxisPart) + sizeof(uint32_t);

/// Of the disc of a strut's section about a point of its axis: the squared radius.
double disc_at(const PlaneStrut& s, double t) {
  const double off = s.w - t * s.d_w;
  return s.radius * s.radius - off * off;
}
/// Of the widest disc.
double widest_of(const PlaneStrut& s, const AxisPart& part) {
  return s.d_w != 0 ? std::clamp(s.w / s.d_w, part.from, part.to) : part.from;
}
/// Discs that are about as wide as the widest have at least this squared radius.
double wide_disc(const PlaneStrut& s, const AxisPart& part) {
  return 0.25 * disc_at(s, widest_of(s, part));
}

}  // namespace

PlaneStruts::PlaneStruts(const Structure& structure, const ContourGrid& grid, double around,
                         std::shared_ptr<MemoryBudget> budget, const Job* job)
    : budget_(std::move(budget)),
      u_{grid.u_nodes().low() - around, grid.u_nodes().high() + around, 0, 1},
      v_{grid.v_nodes().low() - around, grid.v_nodes().high() + around, 0, 1} {
  const LayerPlane& plane = grid.plane();
  // The rounding of positions is a few units of 2^-53.
  margin_ = (strut_error * max_component(structure.neighbourhood().cell_size) +
             0x1p-40 * (max_magnitude(plane.at(u_.low, v_.low)) +
                        max_magnitude(plane.at(u_.high, v_.high)) +
                        max_magnitude(structure.neighbourhood().origin))) /
            plane.unit;
  // A disc whose diameter is the diagonal of a cell holds a node.
  holds_node_ = 0.5 * grid.pitch() * grid.pitch();
  memory_->struts.clear();
  memory_->parts.clear();
  collect(structure, plane, job);
  set_squares(grid.pitch());
  sort(job);
  list_by_square(job);
}

void PlaneStruts::add(const LayerPlane& plane, Vec3 a, Vec3 b, double radius) {
  const Vec3 d = b - a;
  const double w = plane.height / plane.unit - a[plane.axis], d_w = d[plane.axis];
  double from = 0, to = 1;
  if (d_w != 0) {
    const double p = (w - radius) / d_w, q = (w + radius) / d_w;
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
  } else if (std::abs(w) > radius) {
    from = 2;
  }
  if (!(from <= to)) {
    // Near the plane, within the margin: it has no crossings, but points may be in doubt.
    const double near = std::clamp(w, std::min(0.0, d_w), std::max(0.0, d_w));
    if (std::abs(w - near) > radius + margin_) return;
    from = to = d_w != 0 ? near / d_w : 0;
    if (d_w == 0) to = 1;
  }
  std::vector<PlaneStrut>& struts = memory_->struts;
  if (struts.size() == room_) {
    const size_t room = std::max<size_t>(1024, 2 * room_);
    Reservation more(budget_, room * bytes_of_strut, "the struts of a layer");
    struts.reserve(room);
    memory_->parts.reserve(room);
    held_ = std::move(more);
    room_ = room;
  }
  widest_ = std::max(widest_, radius);
  const double squared = dot(d, d);
  const int u = plane.u_axis(), v = plane.v_axis();
  struts.push_back({a[u], a[v], w, d[u], d[v], d_w, radius, squared > 0 ? 1 / squared : 0});
  memory_->parts.push_back({from, to});
}

void PlaneStruts::collect(const Structure& structure, const LayerPlane& plane, const Job* job) {
  // A box about a layer of a turned grid holds far more cells than the layer: tile by tile then.
  const auto& turn = structure.neighbourhood().rotation.m;
  const bool is_turned = std::any_of(std::begin(turn), std::end(turn),
                                     [](double m) { return m != 0 && std::abs(m) != 1; });
  const double side = is_turned ? max_cells_of_tile * structure.cell_length() / plane.unit
                                : std::numeric_limits<double>::infinity();
  const auto tiles = [&](const Squares& axis) {
    return std::max(1.0, std::ceil((axis.high - axis.low) / side));
  };
  const double across = tiles(u_), up = tiles(v_), inverse_unit = 1 / plane.unit;
  for (double j = 0; j < up; ++j)
    for (double i = 0; i < across; ++i) {
      const auto part = [&](const Squares& axis, double n) {
        return n > 0 ? std::min(axis.high, axis.low + n * side) : axis.low;
      };
      const Vec3 low = plane.at(part(u_, i), part(v_, j));
      const Vec3 high = plane.at(part(u_, i + 1), part(v_, j + 1));
      structure.for_each_strut(
          Box3{low, high}.grown(margin_ * plane.unit),
          [&](Vec3 a, Vec3 b, double radius) {
            add(plane, a * inverse_unit, b * inverse_unit, radius * inverse_unit);
          },
          job);
    }
}

void PlaneStruts::set_squares(double min_side) {
  const double width = u_.high - u_.low, height = v_.high - v_.low;
  const double count = static_cast<double>(memory_->struts.size()) + 1;
  const double side =
      std::max({min_side, std::sqrt(width * height / count), width / count, height / count});
  for (Squares* axis : {&u_, &v_}) {
    axis->inverse_side = 1 / side;
    axis->count = static_cast<uint32_t>(std::ceil((axis->high - axis->low) / side));
  }
}

/// Rings and points come row by row, so struts that are near each other lie near in memory, too.
void PlaneStruts::sort(const Job* job) {
  const Borrowed<Unsorted> unsorted;
  std::vector<PlaneStrut>&from = unsorted->struts, &to = memory_->struts;
  std::vector<AxisPart>&parts_from = unsorted->parts, &parts_to = memory_->parts;
  std::swap(from, to);
  std::swap(parts_from, parts_to);
  const size_t squares = size_t{u_.count} * v_.count, count = from.size();
  if (count > UINT32_MAX)
    fail(Status::limit, "%zu struts of the layer; the limit is %u", count, UINT32_MAX);
  const Reservation held(
      budget_, count * (bytes_of_strut + sizeof(size_t)) + (squares + 1) * sizeof(uint32_t),
      "the struts of a layer");
  const auto square_of = [&](size_t n) {
    const PlaneStrut& s = from[n];
    const double middle = 0.5 * (parts_from[n].from + parts_from[n].to);
    return size_t{v_.at(s.a_v + middle * s.d_v)} * u_.count + u_.at(s.a_u + middle * s.d_u);
  };
  std::vector<uint32_t>& starts = unsorted->starts;
  starts.assign(squares + 1, 0);
  std::vector<size_t>& of_struts = unsorted->squares;
  of_struts.resize(count);
  CancelPoll poll(job);
  for (size_t n = 0; n < count; ++n) {
    poll();
    of_struts[n] = square_of(n);
    ++starts[of_struts[n] + 1];
  }
  for (size_t i = 0; i < squares; ++i) starts[i + 1] += starts[i];
  to.resize(count);
  parts_to.resize(count);
  for (size_t n = 0; n < count; ++n) {
    poll();
    const uint32_t at = starts[of_struts[n]]++;
    to[at] = from[n];
    parts_to[at] = parts_from[n];
  }
}

void PlaneStruts::list_by_square(const Job* job) {
  const std::vector<PlaneStrut>& struts = memory_->struts;
  const auto range = [&](const Squares& axis, double a, double d, AxisPart part, double reach,
                         uint32_t& first, uint32_t& last) {
    const double p = a + part.from * d, q = a + part.to * d;
    const double low = std::min(p, q) - reach, high = std::max(p, q) + reach;
    if (high < axis.low || low > axis.high) return false;
    first = axis.at(low);
    last = axis.at(high);
    return true;
  };
  const size_t squares = size_t{u_.count} * v_.count, count = struts.size();
  std::vector<uint32_t>& ends = memory_->starts;
  ends.assign(squares + 1, 0);
  memory_->squares.resize(count);
  memory_->thin.clear();
  CancelPoll poll(job);
  uint64_t total = 0;
  for (size_t n = 0; n < count; ++n) {
    poll();
    const PlaneStrut& s = struts[n];
    const AxisPart& part = memory_->parts[n];
    const double wide = wide_disc(s, part), reach = s.radius + 2 * margin_;
    if (wide > 0 && wide < holds_node_) memory_->thin.push_back(static_cast<uint32_t>(n));
    SquareRange& at = memory_->squares[n];
    if (!range(u_, s.a_u, s.d_u, part, reach, at.first_u, at.last_u) ||
        !range(v_, s.a_v, s.d_v, part, reach, at.first_v, at.last_v))
      at = {1, 0, 1, 0};
    for (uint32_t j = at.first_v; j <= at.last_v; ++j)
      for (uint32_t i = at.first_u; i <= at.last_u; ++i) ++ends[size_t{j} * u_.count + i];
    total += uint64_t{at.last_u + 1 - at.first_u} * (at.last_v + 1 - at.first_v);
  }
  if (total > UINT32_MAX || count > UINT32_MAX)
    fail(Status::limit, "%llu entries of struts in squares of the layer; the limit is %u",
         static_cast<unsigned long long>(total), UINT32_MAX);
  held_lists_ =
      Reservation(budget_, (squares + 1 + total) * sizeof(uint32_t) + count * sizeof(SquareRange),
                  "the struts of a layer");
  uint32_t sum = 0;
  for (uint32_t& end : ends) sum = end += sum;
  memory_->lists.resize(sum);
  for (size_t n = count; n-- > 0;) {
    poll();
    const SquareRange& at = memory_->squares[n];
    for (uint32_t j = at.first_v; j <= at.last_v; ++j)
      for (uint32_t i = at.first_u; i <= at.last_u; ++i)
        memory_->lists[--ends[size_t{j} * u_.count + i]] = static_cast<uint32_t>(n);
  }
}

void PlaneStruts::propose(const ContourGrid& grid, const CrossingTable& table,
                          const Job* job) const {
  constexpr size_t at_once = 128;
  // The struts of a few rows meet few crossings: these are set just before, so they are near the
  // core. One that a strut reached earlier would be queried instead.
  constexpr uint32_t rows_beyond = 3;
  const ContourAxis& v = grid.v_nodes();
  uint32_t row = 0;
  const auto set_rows = [&](uint32_t end) {
    if (end <= row) return;
    const auto set = [&](const EdgeWord* edges) {
      const auto start = [&](uint32_t r) { return table.ends + edges[r * table.row_words].first; };
      std::fill(start(row), start(end), std::numeric_limits<double>::infinity());
    };
    set(table.horizontal);
    set(table.vertical);
    row = end;
  };
  const std::vector<PlaneStrut>& struts = memory_->struts;
  const std::vector<AxisPart>& parts = memory_->parts;
  for (size_t first = 0; first < struts.size(); first += at_once) {
    if (first % 1024 == 0) check_cancelled(job);
    const size_t count = std::min(at_once, struts.size() - first);
    double reach = v.low();
    for (size_t i = first; i < first + count; ++i) {
      const PlaneStrut& s = struts[i];
      const double up = std::max(parts[i].from * s.d_v, parts[i].to * s.d_v);
      reach = std::max(reach, s.a_v + up + s.radius);
    }
    set_rows(reach >= v.high()
                 ? table.rows
                 : std::min(table.rows, ContourGrid::bottom_row + v.edge_of(reach) + rows_beyond));
    propose_struts(struts.data() + first, parts.data() + first, count, grid, table);
  }
  set_rows(table.rows);
}

void PlaneStruts::draw(const ContourGrid& grid, const NodeDrawing& out, const Job* job) const {
  constexpr size_t at_once = 1024;
  const std::vector<PlaneStrut>& struts = memory_->struts;
  for (size_t first = 0; first < struts.size(); first += at_once) {
    check_cancelled(job);
    draw_plane_struts(struts.data() + first, std::min(at_once, struts.size() - first), margin_,
                      grid, out);
  }
}

// The section of a strut is a union of discs about the axis as seen along the normal.
std::vector<PlaneStruts::Unseen> PlaneStruts::find_unseen(const ContourGrid& grid,
                                                          const Job* job) const {
  std::vector<Unseen> unseen;
  const ContourAxis &u = grid.u_nodes(), &v = grid.v_nodes();
  CancelPoll poll(job);
  for (const uint32_t n : memory_->thin) {
    poll();
    const PlaneStrut& s = memory_->struts[n];
    const AxisPart& part = memory_->parts[n];
    const double wide = wide_disc(s, part);
    const auto look = [&](double t) {
      const double squared = disc_at(s, t);
      if (!(squared >= wide && squared < holds_node_)) return;
      const Vec2 p{s.a_u + t * s.d_u, s.a_v + t * s.d_v};
      if (!(p.x >= u.low() && p.x < u.high() && p.y >= v.low() && p.y < v.high())) return;
      const uint32_t column = ContourGrid::left_edge + u.edge_of(p.x);
      const uint32_t row = ContourGrid::bottom_row + v.edge_of(p.y);
      if (grid.inside(column, row) || grid.inside(column + 1, row) ||
          grid.inside(column, row + 1) || grid.inside(column + 1, row + 1))
        return;
      unseen.push_back({column, row, p});
    };
    const double size = (part.to - part.from) * std::hypot(s.d_u, s.d_v);
    const double steps = 1 + std::floor(size / grid.pitch());
    look(widest_of(s, part));
    for (double i = 0; i < steps; ++i) look(part.from + (i + 0.5) / steps * (part.to - part.from));
  }
  std::sort(unseen.begin(), unseen.end(), [](const Unseen& a, const Unseen& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  return unseen;
}

}  // namespace msq

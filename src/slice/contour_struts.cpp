// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_struts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "slice/contour_struts.h"
#include "strut/capsule_lines.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// Where lines of nodes (rows where horizontal, else columns) enter and leave a strut goes to a
/// sink: put_line() takes one line, put_lines() several inner lines by their numbers.
template <bool horizontal, class Sink>
class Lines {
 public:
  Lines(const ContourAxis& across, Sink& sink) : across_(across), sink_(sink) {}

  /// `part`: of the axis, within the radius of the plane.
  HWY_INLINE void meet(const PlaneStrut& strut, const AxisPart& part, double radius) const {
    const double a_s = horizontal ? strut.a_u : strut.a_v, a_t = horizontal ? strut.a_v : strut.a_u;
    const double d_s = horizontal ? strut.d_u : strut.d_v, d_t = horizontal ? strut.d_v : strut.d_u;
    const CapsuleLines capsule(a_s, a_t, strut.w, d_s, d_t, strut.d_w, radius);
    const double p = a_t + part.from * d_t, q = a_t + part.to * d_t;
    const double low = std::min(p, q) - radius, high = std::max(p, q) + radius;
    sink_.begin(capsule);
    if (capsule.inverse == 0) {
      across_.for_nodes(low, high, [&](uint32_t line, double at) { meet_line(capsule, line, at); });
      return;
    }
    if (low <= across_.low() && across_.low() <= high) meet_line(capsule, 0, across_.low());
    if (low <= across_.high() && across_.high() <= high)
      meet_line(capsule, static_cast<uint32_t>(across_.inner() + 1), across_.high());
    double first, last;
    if (across_.inner_between(low, high, first, last)) meet_lines(capsule, first, last);
  }

 private:
  HWY_INLINE void meet_line(const CapsuleLines& capsule, uint32_t line, double at) const {
    double low, high;
    if (capsule.meet(at, low, high)) sink_.put_line(capsule, line, at, low, high);
  }

  /// Inner lines, several at a time; the arithmetic is that of CapsuleLines::meet().
  HWY_INLINE void meet_lines(const CapsuleLines& capsule, double first, double last) const {
    const D d;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const V zero = hn::Zero(d), squared = set(capsule.squared), radius2 = set(capsule.radius2);
    const V d_s = set(capsule.d_s), d_t = set(capsule.d_t), a_s = set(capsule.a_s);
    const V w = set(capsule.w), w2 = set(capsule.w * capsule.w);
    const double w_b = capsule.w - capsule.d_w;
    for (double i = first; i <= last; i += static_cast<double>(hn::Lanes(d))) {
      const V number = hn::Iota(d, i);
      const V at = hn::Add(set(across_.first()), hn::Mul(number, set(across_.pitch())));
      const V t = hn::Sub(at, set(capsule.a_t)), off2 = hn::Add(hn::Mul(t, t), w2);
      const V t_b = hn::Sub(t, d_t), at_b = hn::Add(hn::Mul(t_b, t_b), set(w_b * w_b));
      const V m = hn::Add(hn::Mul(t, d_t), hn::Mul(w, set(capsule.d_w)));
      const V c = hn::Sub(hn::Mul(hn::Sub(off2, radius2), squared), hn::Mul(m, m));
      const V b = hn::Mul(m, d_s);
      const V under = hn::Sub(hn::Mul(b, b), hn::Mul(set(capsule.rest), c));
      M met = hn::And(hn::Ge(under, zero), hn::Le(number, set(last)));
      if (hn::AllFalse(d, met)) continue;
      const V root = hn::Sqrt(under), inverse = set(capsule.inverse);
      const auto end = [&](V s, bool is_high) HWY_ATTR {
        const V along = hn::Add(m, hn::Mul(s, d_s));
        const M before = hn::Lt(along, zero), behind = hn::Gt(along, squared);
        const M round = hn::And(hn::Or(before, behind), met);
        V out = hn::Add(a_s, s);
        if (!hn::AllFalse(d, round)) {
          const V q2 = hn::Sub(radius2, hn::IfThenElse(before, off2, at_b));
          met = hn::AndNot(hn::AndNot(hn::Ge(q2, zero), round), met);
          const V centre = hn::Add(a_s, hn::IfThenElse(before, zero, d_s));
          const V q = hn::Sqrt(q2);
          out = hn::IfThenElse(round, is_high ? hn::Add(centre, q) : hn::Sub(centre, q), out);
        }
        return out;
      };
      const V low = end(hn::Mul(hn::Sub(b, root), inverse), false);
      const V high = end(hn::Mul(hn::Add(b, root), inverse), true);
      sink_.put_lines(low, high, number, met);
    }
  }

  const ContourAxis& across_;
  Sink& sink_;
};

/// Moves the crossings of a table to where struts are entered and left.
template <bool horizontal>
class Proposals {
 public:
  Proposals(const ContourAxis& along, const CrossingTable& table) : along_(along), table_(table) {}

  HWY_INLINE void begin(const CapsuleLines&) const {}
  HWY_INLINE void put_line(const CapsuleLines&, uint32_t line, double, double low,
                           double high) const {
    if (low >= along_.low() && low < along_.high()) put(line, along_.edge_of(low), true, low);
    if (high >= along_.low() && high < along_.high()) put(line, along_.edge_of(high), false, high);
  }
  HWY_INLINE void put_lines(V low, V high, V number, M met) const {
    put_ends(low, number, met, true);
    put_ends(high, number, met, false);
  }

 private:
  /// put() for inner lines. Vectors that gather the words of bits took longer.
  HWY_INLINE void put_ends(V ends, V number, M met, bool enters) const {
    const D d;
    const hn::Rebind<int32_t, D> di;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const M in =
        hn::And(met, hn::And(hn::Ge(ends, set(along_.low())), hn::Lt(ends, set(along_.high()))));
    uint64_t rest = bits_of(d, in);
    if (!rest) return;
    const V steps =
        hn::Add(hn::Mul(hn::Sub(ends, set(along_.first())), set(along_.inverse_pitch())), set(1));
    const V edge = hn::Min(hn::Max(steps, hn::Zero(d)), set(static_cast<double>(along_.inner())));
    HWY_ALIGN double places[max_simd_doubles];
    HWY_ALIGN int32_t edges[max_simd_doubles];
    hn::Store(ends, d, places);
    hn::Store(hn::DemoteTo(di, edge), di, edges);
    const uint32_t line = static_cast<uint32_t>(hn::GetLane(number)) + 1;
    for (; rest; rest &= rest - 1) {
      const unsigned lane = static_cast<unsigned>(std::countr_zero(rest));
      put(line + lane, static_cast<uint32_t>(edges[lane]), enters, places[lane]);
    }
  }

  /// Moves the crossing of an edge, if that has one which enters or leaves as the strut does.
  HWY_INLINE void put(uint32_t line, uint32_t edge, bool enters, double at) const {
    const uint32_t column = ContourGrid::left_edge + (horizontal ? edge : line);
    const uint32_t row = ContourGrid::bottom_row + (horizontal ? line : edge);
    const size_t word = row * table_.row_words + column / 64;
    const unsigned bit = column % 64;
    const uint64_t first = table_.bits[word];
    uint64_t second = horizontal ? first >> 1 : table_.bits[word + table_.row_words];
    if (horizontal && bit == 63) second |= table_.bits[word + 1] << 63;
    const uint64_t alike = enters ? second & ~first : first & ~second;
    const uint64_t before = (first ^ second) & ((uint64_t{1} << bit) - 1);
    const uint32_t id = (horizontal ? table_.horizontal : table_.vertical)[word] +
                        static_cast<uint32_t>(std::popcount(before));
    // A branch would often be predicted wrongly: many ends lie within other struts.
    const uint32_t is_alike = static_cast<uint32_t>(alike >> bit & 1);
    double& known = table_.ends[table_.none ^ ((table_.none ^ id) & (0 - is_alike))];
    known = std::min(known, enters ? at : -at);
  }

  const ContourAxis& along_;
  const CrossingTable& table_;
};

void propose_struts(const PlaneStrut* struts, const AxisPart* parts, size_t count,
                    const ContourGrid& grid, const CrossingTable& table) {
  const ContourAxis &u = grid.u_nodes(), &v = grid.v_nodes();
  Proposals<true> of_rows(u, table);
  Proposals<false> of_columns(v, table);
  const Lines<true, Proposals<true>> rows(v, of_rows);
  const Lines<false, Proposals<false>> columns(u, of_columns);
  for (size_t i = 0; i < count; ++i) {
    rows.meet(struts[i], parts[i], struts[i].radius);
    columns.meet(struts[i], parts[i], struts[i].radius);
  }
}

/// Sets the bits of nodes that struts hold by a margin, and lists those near a strut's surface.
//
// Along a line, the squared distance from the axis is convex, and bends at least as the cylinder
// about the axis does: by 2 k, where k is the squared sine between line and axis (a sphere's is 1).
// Where the line is in the wider capsule of radius R for a length of L, a point t <= L / 2 from
// an end has a squared distance of at most R^2 - k t (L - t) <= R^2 - k t L / 2. So from t = 2 K /
// L on, with k K = R^2 - r^2, it is within r.
class Drawing {
 public:
  Drawing(const ContourAxis& along, const NodeDrawing& out) : along_(along), out_(out) {}

  /// `wide`, `narrow`: the radii.
  HWY_INLINE void set_radii(double wide, double narrow) {
    shell_ = narrow > 0 ? wide * wide - narrow * narrow : std::numeric_limits<double>::infinity();
    narrow2_ = narrow > 0 ? narrow * narrow : -1;
  }
  HWY_INLINE void begin(const CapsuleLines& capsule) {
    inset_ = capsule.inverse == 0 ? 0 : 2 * shell_ * capsule.squared * capsule.inverse;
  }

  HWY_INLINE void put_line(const CapsuleLines& capsule, uint32_t line, double at, double low,
                           double high) {
    double inner_low, inner_high;
    if (capsule.inverse != 0) {
      const double inset = inset_ / (high - low);
      inner_low = low + inset;
      inner_high = high - inset;
    } else {
      // Nearly along the line: as far as both ends of the axis are near it.
      const double t = at - capsule.a_t, w = capsule.w;
      const double t_b = t - capsule.d_t, w_b = w - capsule.d_w;
      const bool is_near = std::max(t * t + w * w, t_b * t_b + w_b * w_b) <= narrow2_;
      inner_low = is_near ? capsule.a_s + std::min(0.0, capsule.d_s) : high;
      inner_high = is_near ? capsule.a_s + std::max(0.0, capsule.d_s) : low;
    }
    const uint32_t row = ContourGrid::bottom_row + line;
    look_at_ends(row, low, high);
    double i0, i1, j0, j1;
    if (!along_.inner_between(low, high, i0, i1)) return;
    if (!along_.inner_between(inner_low, inner_high, j0, j1)) j0 = i1 + 1, j1 = i1;
    put_run(row, i0, i1, j0, j1);
  }

  HWY_INLINE void put_lines(V low, V high, V number, M met) {
    const D d;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const V last = set(static_cast<double>(along_.inner()) - 1);
    const V inset = hn::Div(set(inset_), hn::Sub(high, low));
    const auto steps = [&](V x) HWY_ATTR {
      return hn::Mul(hn::Sub(x, set(along_.first())), set(along_.inverse_pitch()));
    };
    const V i0 = hn::Max(hn::Ceil(steps(low)), hn::Zero(d));
    const V i1 = hn::Min(hn::Floor(steps(high)), last);
    const V j0 = hn::Max(hn::Ceil(steps(hn::Add(low, inset))), i0);
    const V j1 = hn::Min(hn::Floor(steps(hn::Sub(high, inset))), i1);
    const M at_ends =
        hn::And(met, hn::Or(hn::Le(low, set(along_.low())), hn::Ge(high, set(along_.high()))));
    HWY_ALIGN double numbers[max_simd_doubles], first[max_simd_doubles], end[max_simd_doubles];
    hn::Store(number, d, numbers);
    if (!hn::AllFalse(d, at_ends)) {
      hn::Store(low, d, first);
      hn::Store(high, d, end);
      for (uint64_t rest = bits_of(d, at_ends); rest; rest &= rest - 1) {
        const unsigned lane = static_cast<unsigned>(std::countr_zero(rest));
        look_at_ends(ContourGrid::first_inner_row + static_cast<uint32_t>(numbers[lane]),
                     first[lane], end[lane]);
      }
    }
    HWY_ALIGN double inner_first[max_simd_doubles], inner_end[max_simd_doubles];
    hn::Store(i0, d, first);
    hn::Store(i1, d, end);
    hn::Store(j0, d, inner_first);
    hn::Store(j1, d, inner_end);
    for (uint64_t rest = bits_of(d, hn::And(met, hn::Le(i0, i1))); rest; rest &= rest - 1) {
      const unsigned lane = static_cast<unsigned>(std::countr_zero(rest));
      put_run(ContourGrid::first_inner_row + static_cast<uint32_t>(numbers[lane]), first[lane],
              end[lane], inner_first[lane], inner_end[lane]);
    }
  }

 private:
  /// The nodes on both edges of the window.
  HWY_INLINE void look_at_ends(uint32_t row, double low, double high) {
    if (low <= along_.low() && along_.low() <= high)
      out_.doubtful.push_back({ContourGrid::left_edge, row});
    if (low <= along_.high() && along_.high() <= high)
      out_.doubtful.push_back(
          {static_cast<uint32_t>(ContourGrid::first_inner + along_.inner()), row});
  }
  /// Inner nodes i0 to i1 lie in the wide capsule, j0 to j1 also in the narrow one.
  HWY_INLINE void put_run(uint32_t row, double i0, double i1, double j0, double j1) {
    if (!(j0 <= j1)) {
      look_at(row, i0, i1);
      return;
    }
    if (i0 < j0) look_at(row, i0, j0 - 1);
    if (j1 < i1) look_at(row, j1 + 1, i1);
    uint64_t* const words = out_.bits + row * out_.row_words;
    const uint32_t first = ContourGrid::first_inner + static_cast<uint32_t>(j0);
    const uint32_t last = ContourGrid::first_inner + static_cast<uint32_t>(j1);
    const uint64_t from = ~uint64_t{0} << (first % 64), to = ~uint64_t{0} >> (63 - last % 64);
    if (first / 64 == last / 64) {
      words[first / 64] |= from & to;
      return;
    }
    words[first / 64] |= from;
    for (uint32_t w = first / 64 + 1; w < last / 64; ++w) words[w] = ~uint64_t{0};
    words[last / 64] |= to;
  }
  void look_at(uint32_t row, double i0, double i1) {
    for (double i = i0; i <= i1; ++i)
      out_.doubtful.push_back({ContourGrid::first_inner + static_cast<uint32_t>(i), row});
  }

  const ContourAxis& along_;
  const NodeDrawing& out_;
  double shell_ = 0, narrow2_ = 0, inset_ = 0;
};

void draw_plane_struts(const PlaneStrut* struts, size_t count, double margin,
                       const ContourGrid& grid, const NodeDrawing& out) {
  Drawing drawing(grid.u_nodes(), out);
  const Lines<true, Drawing> rows(grid.v_nodes(), drawing);
  for (size_t i = 0; i < count; ++i) {
    const PlaneStrut& s = struts[i];
    // Lines nearly along an axis are taken to be parallel to it (CapsuleLines).
    const double size2 = s.d_u * s.d_u + s.d_v * s.d_v + s.d_w * s.d_w;
    const double wide = s.radius + 2 * margin + 2e-6 * std::sqrt(size2);
    AxisPart part{0, 1};
    if (s.d_w != 0) {
      const double p = (s.w - wide) / s.d_w, q = (s.w + wide) / s.d_w;
      part.from = std::max(part.from, std::min(p, q));
      part.to = std::min(part.to, std::max(p, q));
      if (!(part.from <= part.to)) continue;
    }
    drawing.set_radii(wide, s.radius - margin);
    rows.meet(s, part, wide);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(propose_struts);
HWY_EXPORT(draw_plane_struts);

/// Along an axis.
constexpr double max_cells_of_tile = 64;
/// A bound on the error of struts, relative to the cell: twice the edge_error of foams.
constexpr double strut_error = 1e-6;
constexpr size_t bytes_of_strut = sizeof(PlaneStrut) + sizeof(AxisPart);

}  // namespace

PlaneStruts::PlaneStruts(const Structure& structure, const ContourGrid& grid, double around,
                         std::shared_ptr<MemoryBudget> budget, const Job* job)
    : budget_(std::move(budget)),
      u_{grid.u_nodes().low() - around, grid.u_nodes().high() + around, 0, 1},
      v_{grid.v_nodes().low() - around, grid.v_nodes().high() + around, 0, 1} {
  const LayerPlane& plane = grid.plane();
  // The rounding of positions is a few units of 2^-53.
  margin_ = strut_error * max_component(structure.neighbourhood().cell_size) +
            0x1p-40 * (max_magnitude(plane.at(u_.low, v_.low)) +
                       max_magnitude(plane.at(u_.high, v_.high)) +
                       max_magnitude(structure.neighbourhood().origin));
  memory_->struts.clear();
  memory_->parts.clear();
  collect(structure, plane, job);
  set_squares(grid.pitch());
  sort(job);
  list_by_square(job);
}

void PlaneStruts::add(const LayerPlane& plane, Vec3 a, Vec3 b, double radius) {
  const Vec3 d = b - a;
  const double w = plane.height - a[plane.axis], d_w = d[plane.axis];
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
  const double side = is_turned ? max_cells_of_tile * structure.cell_length()
                                : std::numeric_limits<double>::infinity();
  const auto tiles = [&](const Squares& axis) {
    return std::max(1.0, std::ceil((axis.high - axis.low) / side));
  };
  const double across = tiles(u_), up = tiles(v_);
  for (double j = 0; j < up; ++j)
    for (double i = 0; i < across; ++i) {
      const auto part = [&](const Squares& axis, double n) {
        return n > 0 ? std::min(axis.high, axis.low + n * side) : axis.low;
      };
      const Vec3 low = plane.at(part(u_, i), part(v_, j));
      const Vec3 high = plane.at(part(u_, i + 1), part(v_, j + 1));
      structure.for_each_strut(
          Box3{low, high}.grown(margin_),
          [&](Vec3 a, Vec3 b, double radius) { add(plane, a, b, radius); }, job);
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
  const Reservation held(budget_, count * bytes_of_strut + (squares + 1) * sizeof(uint32_t),
                         "the struts of a layer");
  const auto square_of = [&](size_t n) {
    const PlaneStrut& s = from[n];
    const double middle = 0.5 * (parts_from[n].from + parts_from[n].to);
    return size_t{v_.at(s.a_v + middle * s.d_v)} * u_.count + u_.at(s.a_u + middle * s.d_u);
  };
  std::vector<uint32_t>& starts = unsorted->starts;
  starts.assign(squares + 1, 0);
  CancelPoll poll(job);
  for (size_t n = 0; n < count; ++n) {
    poll();
    ++starts[square_of(n) + 1];
  }
  for (size_t i = 0; i < squares; ++i) starts[i + 1] += starts[i];
  to.resize(count);
  parts_to.resize(count);
  for (size_t n = 0; n < count; ++n) {
    poll();
    const uint32_t at = starts[square_of(n)]++;
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
  CancelPoll poll(job);
  uint64_t total = 0;
  for (size_t n = 0; n < count; ++n) {
    poll();
    const PlaneStrut& s = struts[n];
    const AxisPart& part = memory_->parts[n];
    const double reach = s.radius + 2 * margin_;
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
  // core. One that a strut reached earlier would be asked about instead.
  constexpr uint32_t rows_beyond = 3;
  const ContourAxis& v = grid.v_nodes();
  uint32_t row = 0;
  const auto set_rows = [&](uint32_t end) {
    if (end <= row) return;
    const auto set = [&](const uint32_t* starts, uint32_t rows, uint32_t last) {
      const auto start = [&](uint32_t r) {
        return table.ends + (r < rows ? starts[r * table.row_words] : last);
      };
      std::fill(start(row), start(end), std::numeric_limits<double>::infinity());
    };
    set(table.horizontal, table.rows, table.vertical[0]);
    set(table.vertical, table.rows - 1, table.none);
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
    HWY_DYNAMIC_DISPATCH(propose_struts)
    (struts.data() + first, parts.data() + first, count, grid, table);
  }
  set_rows(table.rows);
}

void PlaneStruts::draw(const ContourGrid& grid, const NodeDrawing& out, const Job* job) const {
  constexpr size_t at_once = 1024;
  const std::vector<PlaneStrut>& struts = memory_->struts;
  for (size_t first = 0; first < struts.size(); first += at_once) {
    check_cancelled(job);
    HWY_DYNAMIC_DISPATCH(draw_plane_struts)
    (struts.data() + first, std::min(at_once, struts.size() - first), margin_, grid, out);
  }
}

// The section of a strut is a union of discs about the axis as seen along the normal. A disc whose
// diameter is the diagonal of a cell holds a node.
std::vector<PlaneStruts::Unseen> PlaneStruts::find_unseen(const ContourGrid& grid,
                                                          const Job* job) const {
  std::vector<Unseen> unseen;
  const ContourAxis &u = grid.u_nodes(), &v = grid.v_nodes();
  const double holds_node = 0.5 * grid.pitch() * grid.pitch();
  CancelPoll poll(job);
  for (size_t n = 0; n < memory_->struts.size(); ++n) {
    poll();
    const PlaneStrut& s = memory_->struts[n];
    const AxisPart& part = memory_->parts[n];
    const auto disc = [&](double t) {  // its squared radius
      const double off = s.w - t * s.d_w;
      return s.radius * s.radius - off * off;
    };
    const double widest = s.d_w != 0 ? std::clamp(s.w / s.d_w, part.from, part.to) : part.from;
    const double wide = 0.25 * disc(widest);
    if (!(wide > 0 && wide < holds_node)) continue;
    const auto look = [&](double t) {
      const double squared = disc(t);
      if (!(squared >= wide && squared < holds_node)) return;
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
    look(widest);
    for (double i = 0; i < steps; ++i) look(part.from + (i + 0.5) / steps * (part.to - part.from));
  }
  std::sort(unseen.begin(), unseen.end(), [](const Unseen& a, const Unseen& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  return unseen;
}

}  // namespace msq
#endif  // HWY_ONCE

// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/plane_strut_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "slice/plane_strut_kernels.h"
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

/// Where struts are entered, or left, on edges of the grid; some at a time. Loops over the few ends
/// of each strut would often be predicted wrongly.
struct ProposedEnds {
  static constexpr size_t room = 128;
  double places[room + max_simd_doubles];
  double edges[room + max_simd_doubles];  // by their first nodes: bits of the table
  size_t count = 0;
};

/// Moves the crossings of a table to where struts are entered and left.
template <bool horizontal>
class Proposals {
 public:
  Proposals(const ContourAxis& along, const CrossingTable& table)
      : along_(along), table_(table), row_bits_(static_cast<double>(table.row_words * 64)) {}
  ~Proposals() {
    put_all<true>(entered_);
    put_all<false>(left_);
  }

  HWY_INLINE void begin(const CapsuleLines&) const {}
  HWY_INLINE void put_line(const CapsuleLines&, uint32_t line, double, double low,
                           double high) const {
    const auto bit = [&](double place) {
      const uint32_t edge = along_.edge_of(place);
      const uint64_t column = ContourGrid::left_edge + uint64_t{horizontal ? edge : line};
      const uint64_t row = ContourGrid::bottom_row + uint64_t{horizontal ? line : edge};
      return row * table_.row_words * 64 + column;
    };
    if (low >= along_.low() && low < along_.high()) put<true>(bit(low), low);
    if (high >= along_.low() && high < along_.high()) put<false>(bit(high), high);
  }
  HWY_INLINE void put_lines(V low, V high, V number, M met) {
    add_ends(low, number, met, entered_);
    if (entered_.count > ProposedEnds::room) put_all<true>(entered_);
    add_ends(high, number, met, left_);
    if (left_.count > ProposedEnds::room) put_all<false>(left_);
  }

 private:
  /// Of inner lines. Bits are whole numbers below 2^53: so many have no room in memory.
  HWY_INLINE void add_ends(V ends, V number, M met, ProposedEnds& to) const {
    const D d;
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const M in =
        hn::And(met, hn::And(hn::Ge(ends, set(along_.low())), hn::Lt(ends, set(along_.high()))));
    const V steps =
        hn::Add(hn::Mul(hn::Sub(ends, set(along_.first())), set(along_.inverse_pitch())), set(1));
    const V edge =
        hn::Floor(hn::Min(hn::Max(steps, hn::Zero(d)), set(static_cast<double>(along_.inner()))));
    const V line = hn::Add(number, set(1));
    const V column = hn::Add(horizontal ? edge : line, set(ContourGrid::left_edge));
    const V row = hn::Add(horizontal ? line : edge, set(ContourGrid::bottom_row));
    const V bit = hn::Add(hn::Mul(row, set(row_bits_)), column);
    // The first edge of the grid has no crossing.
    hn::StoreU(ends, d, to.places + to.count);
    hn::StoreU(hn::IfThenElseZero(in, bit), d, to.edges + to.count);
    to.count += static_cast<size_t>(std::bit_width(bits_of(d, in)));
  }

  template <bool enters>
  HWY_INLINE void put_all(ProposedEnds& ends) const {
    for (size_t i = 0; i < ends.count; ++i)
      put<enters>(static_cast<uint64_t>(static_cast<int64_t>(ends.edges[i])), ends.places[i]);
    ends.count = 0;
  }

  /// Moves the crossing of an edge, if that has one which enters or leaves as the strut does.
  template <bool enters>
  HWY_INLINE void put(uint64_t edge, double at) const {
    const size_t word = edge / 64;
    const uint32_t bit = static_cast<uint32_t>(edge % 64);
    const uint64_t first = table_.bits[word];
    const EdgeWord& edges = (horizontal ? table_.horizontal : table_.vertical)[word];
    const uint64_t alike = edges.bits & (enters ? ~first : first);
    const uint32_t id = edges.crossing(bit);
    // A branch would often be predicted wrongly: many ends lie within other struts.
    const uint32_t is_alike = static_cast<uint32_t>(alike >> bit & 1);
    double& known = table_.ends[table_.none ^ ((table_.none ^ id) & (0 - is_alike))];
    known = std::min(known, enters ? at : -at);
  }

  const ContourAxis& along_;
  const CrossingTable& table_;
  const double row_bits_;
  ProposedEnds entered_, left_;
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

}  // namespace

void propose_struts(const PlaneStrut* struts, const AxisPart* parts, size_t count,
                    const ContourGrid& grid, const CrossingTable& table) {
  HWY_DYNAMIC_DISPATCH(propose_struts)(struts, parts, count, grid, table);
}

void draw_plane_struts(const PlaneStrut* struts, size_t count, double margin,
                       const ContourGrid& grid, const NodeDrawing& out) {
  HWY_DYNAMIC_DISPATCH(draw_plane_struts)(struts, count, margin, grid, out);
}

}  // namespace msq
#endif  // HWY_ONCE

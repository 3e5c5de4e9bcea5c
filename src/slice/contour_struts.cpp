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

/// Lines of nodes: rows where horizontal, else columns.
template <bool horizontal>
class Lines {
 public:
  Lines(const ContourAxis& along, const ContourAxis& across, const CrossingTable& table)
      : along_(along), across_(across), table_(table) {}

  HWY_INLINE void meet(const PlaneStrut& strut, const AxisPart& part) const {
    const double a_s = horizontal ? strut.a_u : strut.a_v, a_t = horizontal ? strut.a_v : strut.a_u;
    const double d_s = horizontal ? strut.d_u : strut.d_v, d_t = horizontal ? strut.d_v : strut.d_u;
    const CapsuleLines capsule(a_s, a_t, strut.w, d_s, d_t, strut.d_w, strut.radius);
    const double p = a_t + part.from * d_t, q = a_t + part.to * d_t;
    const double low = std::min(p, q) - strut.radius, high = std::max(p, q) + strut.radius;
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
    if (!capsule.meet(at, low, high)) return;
    if (low >= along_.low() && low < along_.high()) put(line, along_.edge_of(low), true, low);
    if (high >= along_.low() && high < along_.high()) put(line, along_.edge_of(high), false, high);
  }

  /// Inner lines, several at a time; the arithmetic is that of CapsuleLines::meet().
  HWY_INLINE void meet_lines(const CapsuleLines& capsule, double first, double last) const {
    const D d;
    const hn::Rebind<int32_t, D> di;
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
      const auto put_ends = [&](V ends, bool enters) HWY_ATTR {
        const M in = hn::And(
            met, hn::And(hn::Ge(ends, set(along_.low())), hn::Lt(ends, set(along_.high()))));
        uint64_t rest = bits_of(d, in);
        if (!rest) return;
        const V edge = hn::Add(
            hn::Mul(hn::Sub(ends, set(along_.first())), set(along_.inverse_pitch())), set(1));
        HWY_ALIGN double places[max_simd_doubles];
        HWY_ALIGN int32_t edges[max_simd_doubles];
        hn::Store(ends, d, places);
        hn::Store(hn::DemoteTo(
                      di, hn::Min(hn::Max(edge, zero), set(static_cast<double>(along_.inner())))),
                  di, edges);
        const uint32_t line = static_cast<uint32_t>(i) + 1;
        for (; rest; rest &= rest - 1) {
          const unsigned lane = static_cast<unsigned>(std::countr_zero(rest));
          put(line + lane, static_cast<uint32_t>(edges[lane]), enters, places[lane]);
        }
      };
      put_ends(low, true);
      put_ends(high, false);
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
    if (!(alike >> bit & 1)) return;
    const uint64_t before = (first ^ second) & ((uint64_t{1} << bit) - 1);
    const uint32_t id = (horizontal ? table_.horizontal : table_.vertical)[word] +
                        static_cast<uint32_t>(std::popcount(before));
    double& known = table_.crossings[id].at;
    known = enters ? std::min(known, at) : std::max(known, at);
  }

  const ContourAxis &along_, &across_;
  const CrossingTable& table_;
};

void propose_struts(const PlaneStrut* struts, const AxisPart* parts, size_t count,
                    const ContourGrid& grid, const CrossingTable& table) {
  const Lines<true> rows(grid.u_nodes(), grid.v_nodes(), table);
  const Lines<false> columns(grid.v_nodes(), grid.u_nodes(), table);
  for (size_t i = 0; i < count; ++i) {
    rows.meet(struts[i], parts[i]);
    columns.meet(struts[i], parts[i]);
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
  if (struts_.size() == struts_.capacity()) {
    const size_t room = std::max<size_t>(1024, 2 * struts_.capacity());
    Reservation more(budget_, room * bytes_of_strut, "the struts of a layer");
    struts_.reserve(room);
    parts_.reserve(room);
    held_ = std::move(more);
  }
  const double squared = dot(d, d);
  const int u = plane.u_axis(), v = plane.v_axis();
  struts_.push_back({a[u], a[v], w, d[u], d[v], d_w, radius, squared > 0 ? 1 / squared : 0});
  parts_.push_back({from, to});
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
  const double count = static_cast<double>(struts_.size()) + 1;
  const double side =
      std::max({min_side, std::sqrt(width * height / count), width / count, height / count});
  for (Squares* axis : {&u_, &v_}) {
    axis->inverse_side = 1 / side;
    axis->count = static_cast<uint32_t>(std::ceil((axis->high - axis->low) / side));
  }
}

/// Rings and points come row by row, so struts that are near each other lie near in memory, too.
void PlaneStruts::sort(const Job* job) {
  const auto square_of = [&](size_t n) {
    const PlaneStrut& s = struts_[n];
    const double middle = 0.5 * (parts_[n].from + parts_[n].to);
    return size_t{v_.at(s.a_v + middle * s.d_v)} * u_.count + u_.at(s.a_u + middle * s.d_u);
  };
  const size_t squares = size_t{u_.count} * v_.count;
  Reservation held(budget_, struts_.size() * bytes_of_strut + (squares + 1) * sizeof(size_t),
                   "the struts of a layer");
  std::vector<size_t> starts(squares + 1);
  CancelPoll poll(job);
  for (size_t n = 0; n < struts_.size(); ++n) {
    poll();
    ++starts[square_of(n) + 1];
  }
  for (size_t i = 0; i < squares; ++i) starts[i + 1] += starts[i];
  std::vector<PlaneStrut> struts(struts_.size());
  std::vector<AxisPart> parts(struts_.size());
  for (size_t n = 0; n < struts_.size(); ++n) {
    poll();
    const size_t to = starts[square_of(n)]++;
    struts[to] = struts_[n];
    parts[to] = parts_[n];
  }
  struts_ = std::move(struts);
  parts_ = std::move(parts);
  held_ = std::move(held);
}

void PlaneStruts::list_by_square(const Job* job) {
  const auto for_squares = [&](size_t n, auto&& visit) {
    const PlaneStrut& s = struts_[n];
    const AxisPart& part = parts_[n];
    const auto range = [&](const Squares& axis, double a, double d, uint32_t& first,
                           uint32_t& last) {
      const double p = a + part.from * d, q = a + part.to * d, reach = s.radius + 2 * margin_;
      const double low = std::min(p, q) - reach, high = std::max(p, q) + reach;
      if (high < axis.low || low > axis.high) return false;
      first = axis.at(low);
      last = axis.at(high);
      return true;
    };
    uint32_t u0, u1, v0, v1;
    if (!range(u_, s.a_u, s.d_u, u0, u1) || !range(v_, s.a_v, s.d_v, v0, v1)) return;
    for (uint32_t j = v0; j <= v1; ++j)
      for (uint32_t i = u0; i <= u1; ++i) visit(size_t{j} * u_.count + i);
  };
  const size_t squares = size_t{u_.count} * v_.count;
  std::vector<uint32_t> ends(squares + 1);
  CancelPoll poll(job);
  uint64_t total = 0;
  for (size_t n = 0; n < struts_.size(); ++n) {
    poll();
    for_squares(n, [&](size_t at) {
      ++ends[at];
      ++total;
    });
  }
  if (total > UINT32_MAX || struts_.size() > UINT32_MAX)
    fail(Status::limit, "%llu entries of struts in squares of the layer; the limit is %u",
         static_cast<unsigned long long>(total), UINT32_MAX);
  held_lists_ =
      Reservation(budget_, (squares + 1 + total) * sizeof(uint32_t), "the struts of a layer");
  uint32_t sum = 0;
  for (uint32_t& end : ends) sum = end += sum;
  lists_.resize(sum);
  for (size_t n = struts_.size(); n-- > 0;) {
    poll();
    for_squares(n, [&](size_t at) { lists_[--ends[at]] = static_cast<uint32_t>(n); });
  }
  starts_ = std::move(ends);
}

void PlaneStruts::propose(const ContourGrid& grid, const CrossingTable& table,
                          const Job* job) const {
  constexpr size_t at_once = 1024;
  for (size_t first = 0; first < struts_.size(); first += at_once) {
    check_cancelled(job);
    HWY_DYNAMIC_DISPATCH(propose_struts)
    (struts_.data() + first, parts_.data() + first, std::min(at_once, struts_.size() - first), grid,
     table);
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
  for (size_t n = 0; n < struts_.size(); ++n) {
    poll();
    const PlaneStrut& s = struts_[n];
    const AxisPart& part = parts_[n];
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

PlaneStruts::Found PlaneStruts::find(Vec2 p) const {
  if (!(p.x >= u_.low && p.x <= u_.high && p.y >= v_.low && p.y <= v_.high)) return Found::doubtful;
  const size_t square = size_t{v_.at(p.y)} * u_.count + u_.at(p.x);
  bool is_near = false;
  for (uint32_t i = starts_[square]; i < starts_[square + 1]; ++i) {
    const PlaneStrut& s = struts_[lists_[i]];
    const double x = p.x - s.a_u, y = p.y - s.a_v;
    const double t =
        std::clamp((x * s.d_u + y * s.d_v + s.w * s.d_w) * s.inverse_length_squared, 0.0, 1.0);
    const double dx = x - t * s.d_u, dy = y - t * s.d_v, dw = s.w - t * s.d_w;
    const double squared = dx * dx + dy * dy + dw * dw;
    const double low = s.radius - margin_, high = s.radius + margin_;
    if (squared > high * high) continue;
    if (low > 0 && squared < low * low) return Found::inside;
    is_near = true;
  }
  return is_near ? Found::doubtful : Found::outside;
}

}  // namespace msq
#endif  // HWY_ONCE

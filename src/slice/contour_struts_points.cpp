// SPDX-License-Identifier: Apache-2.0
// Membership of points of the plane by its struts.
#include <algorithm>

#include "base/simd.h"
#include "slice/contour_struts.h"

namespace msq {

PlaneStruts::Found PlaneStruts::find(Vec2 p) const {
  Found found;
  find(&p, 1, &found);
  return found;
}

void PlaneStruts::find(const Vec2* points, size_t count, Found* found) const {
  struct List {
    uint32_t first, end;
    bool is_known;
  };
  constexpr size_t at_once = 32;
  List some[at_once];
  const PlaneStrut* const struts = memory_->struts.data();
  const uint32_t *const starts = memory_->starts.data(), *const lists = memory_->lists.data();
  for (size_t done = 0; done < count; done += at_once) {
    const size_t end = std::min(count - done, at_once);
    for (size_t n = 0; n < end; ++n) {
      const Vec2 p = points[done + n];
      some[n].is_known = p.x >= u_.low && p.x <= u_.high && p.y >= v_.low && p.y <= v_.high;
      const size_t square = some[n].is_known ? size_t{v_.at(p.y)} * u_.count + u_.at(p.x) : 0;
      some[n].first = starts[square];
      some[n].end = starts[square + 1];
    }
    // Most of the time would go by waiting for struts, one after the other.
    for (size_t n = 0; n < end; ++n)
      for (uint32_t i = some[n].first; i < some[n].end; ++i) hwy::Prefetch(struts + lists[i]);
    for (size_t n = 0; n < end; ++n)
      found[done + n] = some[n].is_known ? find_among(lists + some[n].first, lists + some[n].end,
                                                      points[done + n])
                                         : Found::doubtful;
  }
}

PlaneStruts::Found PlaneStruts::find_among(const uint32_t* first, const uint32_t* end,
                                           Vec2 p) const {
  const PlaneStrut* const struts = memory_->struts.data();
  // All struts of the list, since branches on each one would cost more.
  bool is_near = false, is_inside = false;
  for (; first < end; ++first) {
    const PlaneStrut& s = struts[*first];
    const double x = p.x - s.a_u, y = p.y - s.a_v;
    const double along = (x * s.d_u + y * s.d_v + s.w * s.d_w) * s.inverse_length_squared;
    const double above = along > 0 ? along : 0, t = above < 1 ? above : 1;
    const double dx = x - t * s.d_u, dy = y - t * s.d_v, dw = s.w - t * s.d_w;
    const double squared = dx * dx + dy * dy + dw * dw;
    const double less = s.radius - margin_, high = s.radius + margin_;
    const double low = less > 0 ? less : 0;
    is_near |= squared <= high * high;
    is_inside |= squared < low * low;
  }
  return is_inside ? Found::inside : is_near ? Found::doubtful : Found::outside;
}

size_t PlaneStruts::Memory::bytes() const {
  return struts.capacity() * sizeof(PlaneStrut) + parts.capacity() * sizeof(AxisPart) +
         squares.capacity() * sizeof(SquareRange) +
         (starts.capacity() + lists.capacity()) * sizeof(uint32_t);
}

}  // namespace msq

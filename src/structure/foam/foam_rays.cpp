// SPDX-License-Identifier: Apache-2.0
// Rays are looked at in the grid's frame, in foam units. A packet goes along the axis on which it
// crosses most cells, slab by slab of cells. In each slab, the lists of the cells that its rays are
// in (cell_struts.h) are sieved in single precision (strut/capsule_rays.h), and what a ray may meet
// first is settled exactly (strut_entry.h). If a second strut may come before that, all that the
// sieve leaves to the ray are, in the order of their lower bounds.
//
// What a ray meets is the least exact entry of all struts in its way. The sieve decides which of
// them are asked, not what they answer; so the answer does not depend on packets, lists or caches.
#include "structure/foam/foam_rays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/cell_struts.h"
#include "structure/foam/strut_entry.h"
#include "structure/foam/strut_surface.h"

namespace msq {

namespace {

/// What one thread keeps from batch to batch; the struts are forgotten in between.
struct Memory {
  std::vector<FoamRay> rays;
  CellStruts struts;
};

class Walker {
 public:
  Walker(const Foam& foam, RaySearch* searches, Memory& memory)
      : foam_(foam),
        scale_(foam.seeds().scale()),
        radius_(foam.most_radius()),
        entries_(foam),
        searches_(searches),
        memory_(memory) {
    memory_.struts.move_to(foam);
  }
  ~Walker() { memory_.struts.forget(); }

  void run(size_t count) {
    std::vector<FoamRay>& rays = memory_.rays;
    rays.clear();
    for (size_t i = 0; i < count; ++i) {
      searches_[i].found = false;
      rays.push_back(entries_.ray(searches_[i]));
    }
    for (size_t i = 0; i < count;) {
      const size_t end = packet_end(i, count);
      start(i, end);
      i = end;
    }
  }

 private:
  static constexpr size_t most = RayPacket::most;
  /// How far apart rays of a packet may be, across it, in foam units, and how unlike their
  /// directions.
  static constexpr double most_apart = 0.6, most_turned = 0.05;
  /// Cells of a slab that a packet may be in; one that spreads farther goes on ray by ray.
  static constexpr int most_across = 4;

  /// Where the packet that begins at ray i ends.
  size_t packet_end(size_t i, size_t count) const {
    const FoamRay& first = memory_.rays[i];
    const Vec3 from = first.at(first.from);
    size_t end = i + 1;
    for (; end < count && end < i + most; ++end) {
      const FoamRay& ray = memory_.rays[end];
      const Vec3 turned = ray.direction - first.direction;
      if (dot(turned, turned) > most_turned * most_turned) break;
      const Vec3 apart = ray.at(ray.from) - from;
      const Vec3 across = apart - first.direction * dot(apart, first.direction);
      if (dot(across, across) > most_apart * most_apart) break;
    }
    return end;
  }

  /// The rays [begin, end) of the batch, as a packet.
  void start(size_t begin, size_t end) {
    uint32_t rays[most];
    size_t count = 0;
    for (size_t i = begin; i < end; ++i)
      if (memory_.rays[i].from <= memory_.rays[i].to) rays[count++] = static_cast<uint32_t>(i);
    if (count == 0) return;
    if (take_packet(rays, count)) return walk(first_slab());
    for (size_t n = 0; n < count; ++n) {
      take_packet(rays + n, 1);
      walk(first_slab());
    }
  }

  /// False if the rays cross too unlike cells along the axis that they go along.
  bool take_packet(const uint32_t* rays, size_t count) {
    count_ = count;
    Vec3 sum;
    for (size_t n = 0; n < count; ++n) {
      ray_[n] = rays[n];
      const FoamRay& ray = memory_.rays[rays[n]];
      sum = sum + ray.direction;
      for (int axis = 0; axis < 3; ++axis) {
        origin_[axis][n] = ray.origin[axis];
        direction_[axis][n] = ray.direction[axis];
        packet_.direction[axis][n] = static_cast<float>(ray.direction[axis]);
      }
      from_[n] = ray.from;
      to_[n] = ray.to;
    }
    // The axis along which the most cells are crossed; then each ray crosses it.
    axis_ = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(sum[axis]) * scale_[axis_] > std::abs(sum[axis_]) * scale_[axis]) axis_ = axis;
    up_ = sum[axis_] > 0;
    const double least = 0.5 * std::abs(sum[axis_]) / static_cast<double>(count);
    for (size_t n = 0; n < count; ++n) {
      const double d = direction_[axis_][n];
      if (!((up_ ? d : -d) >= least)) return false;
      inverse_[n] = 1 / d;
    }
    packet_.count = count;
    live_ = (uint32_t{1} << count) - 1;
    return true;
  }

  /// The first that a ray is in.
  int32_t first_slab() const {
    double first = 0;
    for (size_t n = 0; n < count_; ++n) {
      const double place = origin_[axis_][n] + direction_[axis_][n] * from_[n];
      const double at = std::floor(place / scale_[axis_]);
      first = n == 0 ? at : up_ ? std::min(first, at) : std::max(first, at);
    }
    return static_cast<int32_t>(first);
  }

  void walk(int32_t slab) {
    for (; live_; slab += up_ ? 1 : -1)
      if (!cross(slab)) {
        go_on_alone(slab);
        return;
      }
  }

  /// Ray by ray from a slab on.
  void go_on_alone(int32_t slab) {
    const uint32_t left = live_;
    const int axis = axis_;
    uint32_t rays[most];
    std::copy_n(ray_, count_, rays);
    for (uint32_t rest = left; rest; rest &= rest - 1) {
      take_packet(rays + std::countr_zero(rest), 1);
      // Alone, it may go along another axis, and from its beginning then.
      walk(axis_ == axis ? slab : first_slab());
    }
  }

  /// One slab; false, and nothing is done, if the packet is in too many of its cells.
  bool cross(int32_t slab) {
    const int k = axis_, lateral[2] = {(k + 1) % 3, (k + 2) % 3};
    const double plane_in = (slab + !up_) * scale_[k], plane_out = (slab + up_) * scale_[k];
    uint32_t active = 0;
    for (size_t n = 0; n < count_; ++n) {
      enter_[n] = (plane_in - origin_[k][n]) * inverse_[n];
      exit_[n] = (plane_out - origin_[k][n]) * inverse_[n];
      active |= static_cast<uint32_t>(enter_[n] <= to_[n] && exit_[n] >= from_[n]) << n;
      live_ &= ~(static_cast<uint32_t>(enter_[n] > to_[n]) << n);
    }
    active &= live_;
    if (!active) return true;
    // The places where rays come in and go out, and their box.
    const double far = 1e300;
    double low[2] = {far, far}, high[2] = {-far, -far};
    double in[2][most], out[2][most];
    for (int side = 0; side < 2; ++side) {
      const double *o = origin_[lateral[side]], *d = direction_[lateral[side]];
      for (size_t n = 0; n < count_; ++n) {
        in[side][n] = o[n] + d[n] * enter_[n];
        out[side][n] = o[n] + d[n] * exit_[n];
        const double p = o[n] + d[n] * std::max(from_[n], enter_[n]);
        const double q = o[n] + d[n] * std::min(to_[n], exit_[n]);
        const bool is_active = active >> n & 1;
        low[side] = std::min(low[side], is_active ? std::min(p, q) : far);
        high[side] = std::max(high[side], is_active ? std::max(p, q) : -far);
      }
    }
    int32_t first[2], last[2];
    for (int side = 0; side < 2; ++side) {
      const double size = scale_[lateral[side]];
      first[side] = static_cast<int32_t>(std::floor(low[side] / size));
      last[side] = static_cast<int32_t>(std::floor(high[side] / size));
    }
    if (count_ > 1 && (last[0] - first[0] >= most_across || last[1] - first[1] >= most_across))
      return false;

    int32_t corner[3];
    corner[k] = slab;
    corner[lateral[0]] = first[0];
    corner[lateral[1]] = first[1];
    for (int side = 0; side < 2; ++side) {
      const double shift = first[side] * scale_[lateral[side]];
      for (size_t n = 0; n < count_; ++n) {
        in[side][n] -= shift;
        out[side][n] -= shift;
      }
    }
    fill_packet(active, in, out);
    hits_.clear();
    slots_.clear();
    if (memory_.struts.is_full()) memory_.struts.forget();
    // Cells in the order in which the packet comes to them; rays end in the first ones mostly.
    order_.clear();
    for (int32_t j = first[1]; j <= last[1]; ++j)
      for (int32_t i = first[0]; i <= last[0]; ++i)
        if (const float at = comes_to(i - first[0], j - first[1]); at <= 1)
          order_.push_back({at, i, j});
    std::sort(order_.begin(), order_.end(),
              [](const Coming& x, const Coming& y) { return x.at < y.at; });
    for (size_t c = 0; c < order_.size() && active; ++c) {
      int32_t cell[3];
      cell[k] = slab;
      cell[lateral[0]] = order_[c].i;
      cell[lateral[1]] = order_[c].j;
      const Slot& slot = add_slot(cell, corner);
      meet_capsules(slot.list, static_cast<float>(radius_), slot.corner, packet_, hits_);
      const bool is_last = c + 1 == order_.size();
      for (uint32_t rest = active; rest; rest &= rest - 1) {
        const size_t n = static_cast<size_t>(std::countr_zero(rest));
        if (hits_.first[n] == std::numeric_limits<float>::infinity()) continue;
        // The other cells hold nothing that the ray may meet before.
        const double last_t =
            is_last
                ? limit(n)
                : std::min(limit(n), enter_[n] + double(order_[c + 1].at) * (exit_[n] - enter_[n]));
        if (enter_[n] + double(hits_.first[n]) > last_t || !settle(n, last_t)) continue;
        active &= ~(1u << n);
        live_ &= ~(1u << n);
        packet_.to[n] = -1;
      }
    }
    return true;
  }

  /// The rays in single precision, from the corner of a cell. in, out: where they cross the slab's
  /// planes, from there, along the two other axes.
  void fill_packet(uint32_t active, const double (&in)[2][most], const double (&out)[2][most]) {
    const int k = axis_, a = (k + 1) % 3, b = (k + 2) % 3;
    const double begin = up_ ? 0 : scale_[k];
    packet_.starts = false;
    double sums[4] = {}, total = 0;
    for (size_t n = 0; n < count_; ++n) {
      const bool is_active = active >> n & 1;
      packet_.origin[k][n] = static_cast<float>(begin);
      packet_.origin[a][n] = static_cast<float>(in[0][n]);
      packet_.origin[b][n] = static_cast<float>(in[1][n]);
      packet_.starts |= is_active && from_[n] >= enter_[n] - ray_list_margin;
      const double from = std::max(from_[n], enter_[n]) - enter_[n];
      packet_.from[n] = is_active ? static_cast<float>(from) : 1.0f;
      packet_.to[n] = is_active ? static_cast<float>(limit(n) - enter_[n]) + 1e-6f : -1.0f;
      const double weight = is_active ? 1 : 0;
      total += weight;
      sums[0] += weight * in[0][n];
      sums[1] += weight * in[1][n];
      sums[2] += weight * out[0][n];
      sums[3] += weight * out[1][n];
    }
    for (size_t n = count_; n < most; ++n) {
      packet_.from[n] = 1;
      packet_.to[n] = -1;
    }
    for (double& sum : sums) sum /= total;
    double squared = 0;
    for (size_t n = 0; n < count_; ++n) {
      const double x = in[0][n] - sums[0], y = in[1][n] - sums[1];
      const double u = out[0][n] - sums[2], v = out[1][n] - sums[3];
      const double far = std::max(x * x + y * y, u * u + v * v);
      squared = std::max(squared, active >> n & 1 ? far : 0.0);
    }
    const double rise = up_ ? scale_[k] : -scale_[k], x = sums[2] - sums[0], y = sums[3] - sums[1];
    const double inverse = 1 / std::sqrt(rise * rise + x * x + y * y);
    packet_.centre[k] = static_cast<float>(begin);
    packet_.centre[a] = static_cast<float>(sums[0]);
    packet_.centre[b] = static_cast<float>(sums[1]);
    packet_.along[k] = static_cast<float>(rise * inverse);
    packet_.along[a] = static_cast<float>(x * inverse);
    packet_.along[b] = static_cast<float>(y * inverse);
    // And as much farther as rays go beyond the slab.
    packet_.spread = static_cast<float>(std::sqrt(squared) * 1.01 + 1e-5);
  }

  /// The part of its way through the slab after which the packet may be in the cell that is (i, j)
  /// from the first along the two other axes; above 1 if it never is.
  float comes_to(int32_t i, int32_t j) const {
    const int32_t cell[2] = {i, j};
    float low = 0, high = 1;
    const float rise = static_cast<float>(scale_[axis_]) / std::abs(packet_.along[axis_]);
    for (int side = 0; side < 2; ++side) {
      const int axis = (axis_ + 1 + side) % 3;
      const float size = static_cast<float>(scale_[axis]), room = packet_.spread + 1e-5f;
      const float from = packet_.centre[axis], by = packet_.along[axis] * rise;
      const float begin = static_cast<float>(cell[side]) * size - room - from;
      const float end = begin + size + 2 * room;
      if (std::abs(by) < 1e-3f) continue;
      const float p = begin / by, q = end / by;
      low = std::max(low, std::min(p, q) - 1e-4f);
      high = std::min(high, std::max(p, q) + 1e-4f);
    }
    return low <= high ? low : 2.0f;
  }

  /// Up to where the lists of this slab hold all that ray n may meet.
  double limit(size_t n) const { return std::min(to_[n], exit_[n] + 0.5 * ray_list_margin); }

  /// The list of a cell, for one slab.
  struct Slot {
    CapsuleView list;
    float corner[3];
  };

  const Slot& add_slot(const int32_t (&cell)[3], const int32_t (&origin)[3]) {
    Slot& slot = slots_.emplace_back();
    slot.list = memory_.struts.list({cell[0], cell[1], cell[2]});
    for (int axis = 0; axis < 3; ++axis)
      slot.corner[axis] = static_cast<float>((cell[axis] - origin[axis]) * scale_[axis]);
    return slot;
  }

  StrutEntry entry(size_t n, uint32_t id) {
    // Rays of a packet meet few struts.
    Known& known = known_[id % std::size(known_)];
    if (known.id != id || known.era != memory_.struts.era()) {
      const CellStruts::Edge edge = memory_.struts.edge(id);
      known = {id, memory_.struts.era(), entries_.line(edge.brick, edge.number)};
    }
    return entries_.find(memory_.rays[ray_[n]], known.line);
  }

  /// Whether ray n ends in this slab before `last`, up to where the lists at hand hold all that it
  /// may meet.
  bool settle(size_t n, double last) {
    const double second = enter_[n] + double(hits_.second[n]);
    const StrutEntry found = entry(n, hits_.id[n]);
    if (found.is_met && (found.at_from || (found.t <= second && found.t <= last))) {
      take(n, found);
      return true;
    }
    if (second > last) return false;
    return settle_all(n, last);
  }

  /// Of all struts that the ray may meet in the slab's cells so far.
  bool settle_all(size_t n, double last) {
    RayPacket alone;
    alone.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      alone.origin[axis][0] = alone.centre[axis] = packet_.origin[axis][n];
      alone.direction[axis][0] = alone.along[axis] = packet_.direction[axis][n];
    }
    std::fill_n(alone.from, most, 1.0f);
    std::fill_n(alone.to, most, -1.0f);
    alone.from[0] = packet_.from[n];
    alone.to[0] = packet_.to[n];
    alone.starts = packet_.starts;
    candidates_.clear();
    for (const Slot& slot : slots_) {
      near_.resize(slot.list.count);
      const size_t found =
          near_capsules(slot.list, static_cast<float>(radius_), slot.corner, alone, near_.data());
      for (size_t c = 0; c < found; ++c) {
        const uint32_t i = near_[c];
        CapsuleView one = slot.list;
        for (int axis = 0; axis < 3; ++axis) {
          one.a[axis] += i;
          one.ab[axis] += i;
        }
        one.ids += i;
        one.count = 1;
        PacketHits hits;
        hits.clear();
        meet_capsules(one, static_cast<float>(radius_), slot.corner, alone, hits);
        if (hits.first[0] < std::numeric_limits<float>::infinity())
          candidates_.push_back({hits.first[0], hits.id[0]});
      }
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.first < b.first || (a.first == b.first && a.id < b.id);
    });
    StrutEntry best;
    for (const Candidate& candidate : candidates_) {
      const double first = enter_[n] + double(candidate.first);
      if (first > last || (best.is_met && first > best.t)) break;
      const StrutEntry found = entry(n, candidate.id);
      if (found.is_met && (!best.is_met || found.t < best.t)) best = found;
      if (best.at_from) break;
    }
    if (!best.is_met || best.t > last) return false;
    take(n, best);
    return true;
  }

  void take(size_t n, const StrutEntry& entry) {
    RaySearch& search = searches_[ray_[n]];
    search.found = true;
    search.t =
        entry.at_from ? search.from : std::clamp(entry.t * foam_.unit(), search.from, search.to);
    search.normal = entry.at_from ? Vec3{} : entry.normal;
    if (entry.by_ends) sharpen_entry(foam_, search);
  }

  const Foam& foam_;
  const Vec3 scale_;
  const double radius_;
  const StrutEntries entries_;
  RaySearch* const searches_;
  Memory& memory_;

  // The packet at hand.
  int axis_ = 0;
  bool up_ = true;
  size_t count_ = 0;
  uint32_t ray_[most], live_ = 0;
  double origin_[3][most], direction_[3][most], inverse_[most], from_[most], to_[most];
  // In the slab at hand.
  double enter_[most], exit_[most];
  RayPacket packet_;
  PacketHits hits_;
  struct Coming {
    float at;
    int32_t i, j;
  };
  std::vector<Coming> order_;
  std::vector<Slot> slots_;
  struct Candidate {
    float first;
    uint32_t id;
  };
  std::vector<Candidate> candidates_;
  struct Known {
    uint32_t id = UINT32_MAX;
    uint64_t era = 0;
    StrutLine line;
  };
  Known known_[16];
  std::vector<uint32_t> near_;
};

/// The brick of edges that a point is in.
CellIndex brick_at(const Foam& foam, Vec3 p) {
  const Vec3 cells = foam.neighbourhood().to_grid(p) * (1 / foam.unit());
  const Vec3 scale = foam.seeds().scale();
  const auto brick = [](double place, double size) {
    return static_cast<int32_t>(
        std::floor((place / size + SeededEdges::lead) * (1.0 / SeededEdges::side)));
  };
  return {brick(cells.x, scale.x), brick(cells.y, scale.y), brick(cells.z, scale.z)};
}

bool is_worth_edges(const Foam& foam, const RaySearch* searches, size_t count) {
  if (foam.ray_demand().has_paid()) return true;
  uint64_t beginnings = 0;
  CellIndex last;
  Box3 bricks{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
  const auto add = [&](CellIndex c) {
    const Vec3 place{double(c.x), double(c.y), double(c.z)};
    bricks = {min(bricks.min, place), max(bricks.max, place)};
  };
  for (size_t i = 0; i < count; ++i) {
    const RaySearch& s = searches[i];
    const CellIndex brick = brick_at(foam, s.ray.at(s.from));
    if (beginnings > 0 && brick == last) continue;
    last = brick;
    ++beginnings;
    add(brick);
    add(brick_at(foam, s.ray.at(s.to)));
  }
  const Vec3 sides = bricks.extent() + Vec3{3, 3, 3};
  constexpr double brick_bytes = 24e3;
  const double most = 0.5 * static_cast<double>(foam.context().cache.limit()) / brick_bytes;
  return foam.ray_demand().pays(count, beginnings, sides.x * sides.y * sides.z, most);
}

}  // namespace

bool walk_cells(const Foam& foam, RaySearch* searches, size_t count) {
  if (!SeededEdges::fits(foam.seeds())) return false;
  const Borrowed<Memory> borrowed_memory;
  Walker(foam, searches, *borrowed_memory).run(count);
  return true;
}

bool enter_by_cells(const Foam& foam, RaySearch* searches, size_t count) {
  return is_worth_edges(foam, searches, count) && walk_cells(foam, searches, count);
}

}  // namespace msq

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
        radius_(foam.radius().range().high / foam.unit()),
        entries_(foam),
        searches_(searches),
        memory_(memory) {
    memory_.struts.move_to(foam);
  }
  ~Walker() { memory_.struts.forget(); }

  void run(size_t count) {
    const Neighbourhood& grid = foam_.neighbourhood();
    const double to_foam = 1 / foam_.unit();
    std::vector<FoamRay>& rays = memory_.rays;
    rays.clear();
    for (size_t i = 0; i < count; ++i) {
      RaySearch& s = searches_[i];
      s.found = false;
      FoamRay ray{grid.to_grid(s.ray.origin) * to_foam,
                  grid.rotation.apply_inverse(s.ray.direction),
                  s.from * to_foam,
                  s.to * to_foam,
                  0,
                  &s};
      ray.most = std::max(max_magnitude(ray.at(ray.from)), max_magnitude(ray.at(ray.to)));
      rays.push_back(ray);
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
  static constexpr double most_apart = 1.25, most_turned = 0.05;
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
    Vec3 mean;
    count_ = 0;
    for (size_t i = begin; i < end; ++i) {
      if (!(memory_.rays[i].from <= memory_.rays[i].to)) continue;
      ray_[count_++] = static_cast<uint32_t>(i);
      mean = mean + memory_.rays[i].direction;
    }
    if (count_ == 0) return;
    // The axis along which the most cells are crossed; then each ray crosses it.
    axis_ = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(mean[axis]) / scale_[axis] > std::abs(mean[axis_]) / scale_[axis_]) axis_ = axis;
    up_ = mean[axis_] > 0;
    double first = 0;
    for (size_t n = 0; n < count_; ++n) {
      const FoamRay& ray = this->ray(n);
      const double at = slab_of(ray.at(ray.from)[axis_]);
      first = n == 0 ? at : up_ ? std::min(first, at) : std::max(first, at);
    }
    walk(static_cast<int32_t>(first));
  }

  const FoamRay& ray(size_t n) const { return memory_.rays[ray_[n]]; }
  double slab_of(double place) const { return std::floor(place / scale_[axis_]); }

  void walk(int32_t slab) {
    live_ = (uint32_t{1} << count_) - 1;
    for (; live_; slab += up_ ? 1 : -1)
      if (!cross(slab)) {
        go_on_alone(slab);
        return;
      }
  }

  /// Ray by ray from a slab on.
  void go_on_alone(int32_t slab) {
    const uint32_t left = live_;
    uint32_t rays[most];
    std::copy_n(ray_, count_, rays);
    const size_t count = count_;
    for (size_t n = 0; n < count; ++n) {
      if (!(left >> n & 1)) continue;
      ray_[0] = rays[n];
      count_ = 1;
      walk(slab);
    }
  }

  /// One slab; false, and nothing is done, if the packet is in too many of its cells.
  bool cross(int32_t slab) {
    const int k = axis_, a = (k + 1) % 3, b = (k + 2) % 3;
    const double plane_in = (slab + !up_) * scale_[k], plane_out = (slab + up_) * scale_[k];
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    uint32_t active = 0;
    for (size_t n = 0; n < count_; ++n) {
      if (!(live_ >> n & 1)) continue;
      const FoamRay& ray = this->ray(n);
      const double inverse = 1 / ray.direction[k];
      enter_[n] = (plane_in - ray.origin[k]) * inverse;
      exit_[n] = (plane_out - ray.origin[k]) * inverse;
      if (enter_[n] > ray.to) {
        live_ &= ~(1u << n);
        continue;
      }
      if (exit_[n] < ray.from) continue;
      active |= 1u << n;
      const double in = std::max(ray.from, enter_[n]), out = std::min(ray.to, exit_[n]);
      for (int side = 0; side < 2; ++side) {
        const int lateral = side ? b : a;
        const double o = ray.origin[lateral], d = ray.direction[lateral];
        const double p = o + d * in, q = o + d * out;
        low[side] = std::min({low[side], p, q});
        high[side] = std::max({high[side], p, q});
      }
    }
    if (!active) return true;
    int32_t first[2], last[2];
    for (int side = 0; side < 2; ++side) {
      const double size = scale_[side ? b : a];
      first[side] = static_cast<int32_t>(std::floor(low[side] / size));
      last[side] = static_cast<int32_t>(std::floor(high[side] / size));
    }
    if (count_ > 1 && (last[0] - first[0] >= most_across || last[1] - first[1] >= most_across))
      return false;

    CellIndex middle;
    (k == 0 ? middle.x : k == 1 ? middle.y : middle.z) = slab;
    (a == 0 ? middle.x : a == 1 ? middle.y : middle.z) = first[0];
    (b == 0 ? middle.x : b == 1 ? middle.y : middle.z) = first[1];
    fill_packet(middle, active);
    hits_.clear();
    slots_.clear();
    if (memory_.struts.is_full()) memory_.struts.forget();
    for (int32_t j = first[1]; j <= last[1]; ++j)
      for (int32_t i = first[0]; i <= last[0]; ++i) {
        CellIndex cell = middle;
        (a == 0 ? cell.x : a == 1 ? cell.y : cell.z) = i;
        (b == 0 ? cell.x : b == 1 ? cell.y : cell.z) = j;
        const Slot& slot = add_slot(cell, middle);
        meet_capsules(slot.list, static_cast<float>(radius_), slot.corner, packet_, hits_);
      }
    for (uint32_t rest = active; rest; rest &= rest - 1) {
      const size_t n = static_cast<size_t>(std::countr_zero(rest));
      if (hits_.first[n] < std::numeric_limits<float>::infinity() && settle(n)) live_ &= ~(1u << n);
    }
    return true;
  }

  /// The rays in single precision, from the corner of a cell.
  void fill_packet(CellIndex cell, uint32_t active) {
    const Vec3 corner = Vec3{double(cell.x), double(cell.y), double(cell.z)} * scale_;
    packet_.count = count_;
    packet_.starts = false;
    Vec3 in, out, places[2][most];
    int total = 0;
    for (size_t n = 0; n < count_; ++n) {
      if (!(active >> n & 1)) {
        packet_.from[n] = 1;
        packet_.to[n] = -1;
        continue;
      }
      const FoamRay& ray = this->ray(n);
      const Vec3 o = ray.at(enter_[n]) - corner;
      for (int axis = 0; axis < 3; ++axis) {
        packet_.origin[axis][n] = static_cast<float>(o[axis]);
        packet_.direction[axis][n] = static_cast<float>(ray.direction[axis]);
      }
      const double from = std::max(ray.from, enter_[n]) - enter_[n];
      packet_.starts |= ray.from >= enter_[n] - ray_list_margin;
      packet_.from[n] = static_cast<float>(from);
      packet_.to[n] = static_cast<float>(limit(n) - enter_[n]) + 1e-6f;
      places[0][n] = o;
      places[1][n] = o + ray.direction * (exit_[n] - enter_[n]);
      in = in + places[0][n];
      out = out + places[1][n];
      ++total;
    }
    for (size_t n = count_; n < most; ++n) {
      packet_.from[n] = 1;
      packet_.to[n] = -1;
    }
    in = in * (1.0 / total);
    out = out * (1.0 / total);
    double spread_squared = 0;
    for (size_t n = 0; n < count_; ++n) {
      if (!(active >> n & 1)) continue;
      const Vec3 p = places[0][n] - in, q = places[1][n] - out;
      spread_squared = std::max({spread_squared, dot(p, p), dot(q, q)});
    }
    const Vec3 along = (out - in) * (1 / length(out - in));
    for (int axis = 0; axis < 3; ++axis) {
      packet_.centre[axis] = static_cast<float>(in[axis]);
      packet_.along[axis] = static_cast<float>(along[axis]);
    }
    // And as much farther as rays go beyond the slab.
    packet_.spread = static_cast<float>(std::sqrt(spread_squared) * 1.01 + 1e-5);
  }

  /// Up to where the lists of this slab hold all that ray n may meet.
  double limit(size_t n) const { return std::min(ray(n).to, exit_[n] + 0.5 * ray_list_margin); }

  /// The list of a cell, for one slab.
  struct Slot {
    CapsuleView list;
    float corner[3];
  };

  const Slot& add_slot(CellIndex cell, CellIndex origin) {
    Slot& slot = slots_.emplace_back();
    slot.list = memory_.struts.list(cell);
    slot.corner[0] = static_cast<float>((cell.x - origin.x) * scale_.x);
    slot.corner[1] = static_cast<float>((cell.y - origin.y) * scale_.y);
    slot.corner[2] = static_cast<float>((cell.z - origin.z) * scale_.z);
    return slot;
  }

  StrutEntry entry(size_t n, uint32_t id) const {
    const CellStruts::Edge edge = memory_.struts.edge(id);
    const auto &a = edge.brick.end(edge.number, 0), &b = edge.brick.end(edge.number, 1);
    StrutAxis axis;
    axis.cell = edge.brick.corner();
    axis.a = {a[0], a[1], a[2]};
    axis.ab = Vec3{b[0], b[1], b[2]} - axis.a;
    axis.has_seeds = edge.brick.knows_seeds(edge.number);
    if (axis.has_seeds) axis.seeds = edge.brick.seeds(edge.number);
    return entries_.find(ray(n), axis);
  }

  /// Whether ray n ends in this slab.
  bool settle(size_t n) {
    const double second = enter_[n] + double(hits_.second[n]), last = limit(n);
    const StrutEntry found = entry(n, hits_.id[n]);
    if (found.is_met && (found.at_from || (found.t <= second && found.t <= last))) {
      take(n, found);
      return true;
    }
    if (second > last) return false;
    return settle_all(n, last);
  }

  /// Of all struts that the ray may meet in this slab.
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
  // In the slab at hand.
  double enter_[most], exit_[most];
  RayPacket packet_;
  PacketHits hits_;
  std::vector<Slot> slots_;
  struct Candidate {
    float first;
    uint32_t id;
  };
  std::vector<Candidate> candidates_;
  std::vector<uint32_t> near_;
};

}  // namespace

bool enter_by_cells(const Foam& foam, RaySearch* searches, size_t count) {
  if (foam.graded() || !foam.radius().is_constant() || !SeededEdges::fits(foam.seeds()))
    return false;
  const Borrowed<Memory> borrowed_memory;
  Walker(foam, searches, *borrowed_memory).run(count);
  return true;
}

}  // namespace msq

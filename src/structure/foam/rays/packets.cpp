// SPDX-License-Identifier: Apache-2.0
// Rays are processed in the grid's frame, in foam units. A packet advances along the axis on which
// it crosses most cells, slab by slab of cells. In each slab, the lists of the cells that its rays
// are in (cell_lists.h) are sieved in single precision (strut/capsule_rays.h). The strut that a ray
// may meet first is then tested exactly (strut_entry.h). If a second strut may come before that
// entry, all struts that the sieve leaves for the ray are tested, in the order of their lower
// bounds.
//
// A ray's result is the first exact entry of all struts in its way. The sieve decides which struts
// are tested, not the results of the tests. So the result does not depend on packets, lists or
// caches.
#include "structure/foam/rays/packets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/rays/cell_lists.h"
#include "structure/foam/rays/graded_lists.h"
#include "structure/foam/rays/packet_entries.h"
#include "structure/foam/rays/packet_path.h"
#include "structure/foam/rays/packet_rays.h"
#include "structure/foam/rays/ray_demand.h"
#include "structure/foam/rays/ray_struts.h"
#include "structure/foam/rays/single_ray.h"

namespace msq {

namespace {

/// Memory that a thread keeps from batch to batch; the struts are forgotten in between.
template <class Struts>
struct Memory {
  Struts struts;
  KnownLines lines;
};

template <class Struts>
class Walker {
 public:
  Walker(const FoamData& foam, RaySearch* searches, Memory<Struts>& memory, const Job* job)
      : foam_(foam),
        scale_(foam.seeds().scale()),
        asks_once_(!foam.graded() && foam.radius().is_constant()),
        searches_(searches),
        job_(job),
        memory_(memory),
        struts_(foam, memory.struts, memory.lines),
        lone_(foam, struts_, job) {
    memory_.struts.move_to(foam);
  }
  ~Walker() { memory_.struts.forget(); }

  void run(size_t count) {
    for (size_t i = 0; i < count;) {
      // Lanes left over from a packet that ended early are enough for another one, or set up again.
      if (begin_ + window_ < std::min(count, i + min_packet)) set_up(i, std::min(most, count - i));
      i = start(i);
    }
  }

 private:
  static constexpr size_t most = RayPacket::most;
  /// Maximum distance between rays of a packet, across it, in foam units, and maximum difference of
  /// their directions.
  static constexpr double max_apart = 0.9, max_turned = 0.05;
  /// If there are fewer rays, each is processed alone.
  static constexpr int min_packet = 12;
  /// Maximum error of rays, foam units: some thousand cells from the origin.
  static constexpr double max_sure_error = 0x1p-38;

  /// Takes rays from i on as those that packets consist of.
  void set_up(size_t i, size_t count) {
    begin_ = i;
    window_ = count;
    rays_.set(struts_.frame(), searches_ + i, count);
    for (size_t n = 0; n < count; ++n) {
      RaySearch& search = search_of(n);
      search.found = false;
      // Larger rounding errors may hide the strut in which the ray begins.
      if (rays_.error[n] <= max_sure_error || !(rays_.from[n] <= rays_.to[n])) continue;
      if (!foam_.inside(search.ray.at(search.from))) continue;
      StrutEntry begin;
      begin.is_met = begin.at_from = true;
      struts_.take(begin, search);
      rays_.to[n] = -std::numeric_limits<double>::infinity();
    }
  }
  RaySearch& search_of(size_t n) { return searches_[begin_ + n]; }

  /// Takes the rays from i on that stay close together as a packet. Returns the next ray's number.
  size_t start(size_t i) {
    const size_t begin = i - begin_;
    const uint32_t apart = ~rays_.beside(begin, max_apart, max_turned) >> begin;
    const size_t end =
        std::min(window_, begin + static_cast<size_t>(std::max(1, std::countr_zero(apart))));
    live_ = 0;
    for (size_t n = begin; n < end; ++n) live_ |= uint32_t{rays_.from[n] <= rays_.to[n]} << n;
    if (std::popcount(live_) >= min_packet && set_course(rays_, live_, scale_, course_, packet_)) {
      packet_.count = end;
      room_ = struts_.room(course_.error);
      has_base_ = false;
      walk(static_cast<int32_t>(std::floor(course_.begin / scale_[course_.axis])));
    } else {
      for (; live_; live_ &= live_ - 1) {
        const auto n = static_cast<size_t>(std::countr_zero(live_));
        lone_.walk(rays_.ray(n), rays_.from[n], search_of(n));
      }
    }
    return begin_ + end;
  }

  void walk(int32_t slab) {
    for (; live_; slab += course_.up ? 1 : -1) {
      check_cancelled(job_);
      if (!cross(slab)) {
        go_on_alone(slab);
        return;
      }
    }
  }

  /// Where rays enter a slab.
  double plane_of(int32_t slab) const { return (slab + !course_.up) * scale_[course_.axis]; }

  /// Continues ray by ray from a slab on.
  void go_on_alone(int32_t slab) {
    for (uint32_t rest = live_; rest; rest &= rest - 1) {
      const auto n = static_cast<size_t>(std::countr_zero(rest));
      lone_.walk(rays_.ray(n), std::max(rays_.from[n], crossing(n, slab)), search_of(n));
    }
  }
  double crossing(size_t n, int32_t slab) const {
    return (plane_of(slab) - rays_.origin[course_.axis][n]) * course_.inverse[n];
  }

  /// Makes the rays' coordinates relative to a slab, and to the cell there that the first live ray
  /// is in.
  void set_base(int32_t slab) {
    const int k = course_.axis, lateral[2] = {(k + 1) % 3, (k + 2) % 3};
    base_slab_ = slab;
    has_base_ = true;
    const auto first = static_cast<size_t>(std::countr_zero(live_));
    const Vec3 place = rays_.at(first, std::max(rays_.from[first], crossing(first, slab)));
    PathBase base{plane_of(slab), {}};
    for (int side = 0; side < 2; ++side) {
      const double size = scale_[lateral[side]], index = std::floor(place[lateral[side]] / size);
      base_[side] = static_cast<int32_t>(index);
      base.corner[side] = index * size;
    }
    set_path(rays_, course_, base, scale_, live_, path_, packet_);
    hits_.clear();
    seen_.clear();
  }

  /// Crosses one slab. Returns false and does nothing if the packet is in too many of its cells.
  bool cross(int32_t slab) {
    // Coordinates relative to nearby slabs and cells stay small.
    constexpr int max_slabs = 4;
    constexpr float max_cells = 5;
    const int k = course_.axis, lateral[2] = {(k + 1) % 3, (k + 2) % 3};
    const bool up = course_.up;
    int number = up ? slab - base_slab_ : base_slab_ - slab;
    if (!has_base_ || number < 0 || number >= max_slabs) {
      set_base(slab);
      number = 0;
    }
    SlabCrossing crossing;
    while (true) {
      const double rise = up ? scale_[k] : -scale_[k];
      crossing = cross_slab(path_,
                            {number, k, static_cast<float>((up ? 0 : scale_[k]) + number * rise),
                             static_cast<float>(rise)},
                            live_, packet_);
      live_ &= ~crossing.ended;
      if (!crossing.active) return true;
      if (number == 0) break;
      bool is_far = false;
      for (int side = 0; side < 2; ++side) {
        const float size = static_cast<float>(scale_[lateral[side]]);
        is_far |= crossing.low[side] < -max_cells * size || crossing.high[side] > max_cells * size;
      }
      if (!is_far) break;
      set_base(slab);
      number = 0;
    }
    uint32_t active = crossing.active;
    SlabCells cells;
    for (int side = 0; side < 2; ++side) {
      cells.size[side] = static_cast<float>(scale_[lateral[side]]);
      // Roundings are within the margin of the lists.
      cells.first[side] = static_cast<int32_t>(std::floor(crossing.low[side] / cells.size[side]));
      cells.last[side] = static_cast<int32_t>(std::floor(crossing.high[side] / cells.size[side]));
      // A wider packet continues ray by ray.
      if (cells.last[side] - cells.first[side] >= SlabCells::most) return false;
    }

    if (!asks_once_) hits_.clear();
    slots_.clear();
    if (struts_.lists().is_full()) {
      struts_.forget();
      set_base(slab);
      return cross(slab);
    }
    // Length of the packet's line in the slab.
    const float rise = static_cast<float>(scale_[k]) / std::abs(packet_.along[k]);
    // Cells in the order in which rays reach them; rays usually end in the first ones.
    CrossedCell order[SlabCells::most * SlabCells::most];
    CrossedCell* const end = order + find_crossed_cells(path_, number, active, cells, order);
    std::sort(order, end,
              [](const CrossedCell& x, const CrossedCell& y) { return x.enter < y.enter; });
    // The first of the cells from one on that an active ray crosses.
    const auto find_next = [&](const CrossedCell* from) {
      while (from < end && !(from->rays & active)) ++from;
      return from;
    };
    // If a ray and the centre are in one plane of the slab, the centre may be behind by this.
    const float behind =
        packet_.spread * std::sqrt(std::max(0.0f, 1 - packet_.along[k] * packet_.along[k])) +
        static_cast<float>(ray_list_margin);
    for (const CrossedCell* cell = order; active;) {
      double seen = std::numeric_limits<double>::infinity();
      if (cell < end) {
        packet_.near = cell->enter * rise - behind;
        packet_.far = cell->leave * rise + behind;
        const Slot& slot = add_slot(*cell, slab);
        meet_capsules(slot.list, slot.radius + room_, slot.corner, packet_,
                      asks_once_ ? &seen_ : nullptr, hits_);
        cell = find_next(cell + 1);
        // Active rays meet nothing more before they enter the next cell.
        if (cell < end) seen = double(cell->enter);
      }
      const uint32_t settled = settle(who_may_meet(rays_, number, hits_, active, seen, path_));
      active &= ~settled;
      live_ &= ~settled;
      for (uint32_t rest = settled; rest; rest &= rest - 1) packet_.to[std::countr_zero(rest)] = -1;
      if (seen == std::numeric_limits<double>::infinity()) break;
      cell = find_next(cell);
    }
    return true;
  }

  /// The list of a cell, for one slab.
  struct Slot {
    CapsuleView list;
    float corner[3];
    float radius;  // maximum radius there
  };

  const Slot& add_slot(const CrossedCell& crossed, int32_t slab) {
    const int k = course_.axis, a = (k + 1) % 3, b = (k + 2) % 3;
    int32_t cell[3];
    cell[k] = slab;
    cell[a] = base_[0] + crossed.cell[0];
    cell[b] = base_[1] + crossed.cell[1];
    Slot& slot = slots_.emplace_back();
    slot.list = memory_.struts.list({cell[0], cell[1], cell[2]});
    slot.corner[k] = static_cast<float>((slab - base_slab_) * scale_[k]);
    slot.corner[a] = static_cast<float>(crossed.cell[0] * scale_[a]);
    slot.corner[b] = static_cast<float>(crossed.cell[1] * scale_[b]);
    slot.radius = struts_.radius_in({cell[0], cell[1], cell[2]});
    if (slot.radius < 0) slot.list.count = 0;
    return slot;
  }

  /// Those of some rays that end in this slab before their path_.last. The current lists contain
  /// all struts that they may meet up to there.
  uint32_t settle(uint32_t rays) {
    uint32_t settled = 0;
    while (rays) {
      // Those that may meet the same strut first.
      const uint32_t id = hits_.id[std::countr_zero(rays)];
      uint32_t same = 0;
      for (uint32_t rest = rays; rest; rest &= rest - 1) {
        const int n = std::countr_zero(rest);
        same |= uint32_t{hits_.id[n] == id} << n;
      }
      rays &= ~same;
      entries_.met = entries_.missed = 0;
      if (const StrutLine& line = struts_.line(id); foam_.has_capsules() && line.has_line)
        find_packet_entries(line, scale_, foam_.max_radius(), rays_, same, entries_);
      for (; same; same &= same - 1) {
        const auto n = static_cast<size_t>(std::countr_zero(same));
        StrutEntry found;
        if (entries_.met >> n & 1) {
          const Vec3 normal{entries_.normal[0][n], entries_.normal[1][n], entries_.normal[2][n]};
          found.is_met = found.is_sure = true;
          found.t = entries_.t[n];
          found.normal = foam_.neighbourhood().rotation.apply(normal);
        } else if (!(entries_.missed >> n & 1)) {
          found = struts_.entry(rays_.ray(n), id);
        }
        settled |= uint32_t{settle(n, path_.last[n], found)} << n;
      }
    }
    return settled;
  }

  /// Whether ray n ends in this slab before `last`, given its entry into the strut that it may meet
  /// first.
  bool settle(size_t n, double last, const StrutEntry& found) {
    const double second = path_.enter[n] + double(hits_.second[n]);
    if (found.is_met && (found.at_from || (found.t <= second && found.t <= last))) {
      struts_.take(found, search_of(n));
      return true;
    }
    if (second > last) return false;
    return settle_all(n, last);
  }

  /// The same from all struts that the ray may meet in the slab's cells so far.
  bool settle_all(size_t n, double last) {
    const FoamRay own = rays_.ray(n);
    const float from = packet_.from[n];
    CapsuleRay alone;
    alone.to =
        std::min(packet_.to[n], static_cast<float>(last - path_.enter[n]) + along_rounding) - from;
    first_.clear();
    for (const Slot& slot : slots_) {
      for (int axis = 0; axis < 3; ++axis) {
        alone.direction[axis] = packet_.direction[axis][n];
        alone.origin[axis] =
            packet_.origin[axis][n] + alone.direction[axis] * from - slot.corner[axis];
      }
      struts_.ask(own, slot.list, slot.radius, alone, path_.enter[n] + double(from), first_);
    }
    if (!first_.entry.is_met || first_.entry.t > last) return false;
    struts_.take(first_.entry, search_of(n));
    return true;
  }

  const FoamData& foam_;
  const Vec3 scale_;
  /// Whether the result of a strut in one cell is valid in all cells; false if cells have their own
  /// radii.
  const bool asks_once_;
  RaySearch* const searches_;
  const Job* const job_;
  Memory<Struts>& memory_;
  RayStruts<Struts> struts_;
  SingleRay<Struts> lone_;

  // The rays that packets consist of: where they begin in the batch, and how many they are.
  PacketRays rays_;
  size_t begin_ = 0, window_ = 0;
  // The current packet.
  uint32_t live_ = 0;
  PacketCourse course_;
  float room_ = 0;  // the maximum of its rays
  bool has_base_ = false;
  int32_t base_slab_ = 0, base_[2];
  PacketPath path_;
  PacketEntries entries_;
  RayPacket packet_;
  // Relative to the base.
  PacketHits hits_;
  SeenIds seen_;
  std::vector<Slot> slots_;
  FirstEntry first_;
};

}  // namespace

bool walk_cells(const FoamData& foam, RaySearch* searches, size_t count, const Job* job) {
  // The lists of cells and their proofs are those of the Voronoi diagram in model space.
  if (foam.stretch() || foam.is_weighted() || !RayBrick::fits(foam.seeds())) return false;
  // On the heap: walkers are too large for the stacks of a host's threads.
  if (foam.graded()) {
    const Borrowed<Memory<GradedLists>> memory;
    std::make_unique<Walker<GradedLists>>(foam, searches, *memory, job)->run(count);
  } else {
    const Borrowed<Memory<CellLists>> memory;
    std::make_unique<Walker<CellLists>>(foam, searches, *memory, job)->run(count);
  }
  return true;
}

bool enter_by_cells(const FoamData& foam, RaySearch* searches, size_t count, const Job* job) {
  return !foam.stretch() && !foam.is_weighted() && RayDemand::pays_for(foam, searches, count) &&
         walk_cells(foam, searches, count, job);
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// The struts in the way of rays: lists for cells, and exact entries into single struts.
#pragma once

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "cell/cell_hash.h"
#include "structure/foam/foam_data.h"
#include "structure/foam/rays/march.h"
#include "structure/foam/rays/ray_brick.h"
#include "structure/foam/rays/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

/// The first strut that a ray meets, among those tested.
struct FirstEntry {
  StrutEntry entry;
  std::vector<uint32_t> queried;

  void clear() {
    entry = {};
    queried.clear();
  }
};

/// The lines of struts found last among those whose ids have the same last bits. Neighbouring rays
/// meet few different struts.
class KnownLines {
 public:
  /// The line of a strut; find(), unless it is known since the lists were forgotten last.
  template <class Find>
  const StrutLine& line(uint32_t id, uint64_t era, Find&& find) {
    Known& known = known_[id % std::size(known_)];
    if (known.id != id || known.era != era) known = {id, era, find()};
    return known.line;
  }

 private:
  struct Known {
    uint32_t id = UINT32_MAX;
    uint64_t era = 0;
    StrutLine line;
  };
  Known known_[256];
};

/// `Struts`: lists of struts for cells: CellLists, or a class with its interface.
template <class Struts>
class RayStruts {
 public:
  /// Lines that are known are those of these lists.
  RayStruts(const FoamData& foam, Struts& lists, KnownLines& lines)
      : foam_(foam), entries_(foam), lists_(lists), lines_(lines) {}

  Struts& lists() { return lists_; }
  /// Forgets all lists; call it when they are full.
  void forget() {
    lists_.forget();
    radii_.clear();
  }
  const FoamFrame& frame() const { return entries_.frame(); }

  /// How much thicker the sieve must make struts for rays of this error, foam units. No entry is
  /// farther from its strut than this beyond the radius, or before the ray comes that near.
  static float room(double error) { return static_cast<float>(8 * error); }

  /// The maximum radius in a cell; below 0 if there are no struts.
  float radius_in(CellIndex cell) {
    if (foam_.radius().is_constant()) return static_cast<float>(foam_.max_radius());
    const auto [found, is_new] = radii_.try_emplace(cell, 0.0f);
    if (is_new) found->second = static_cast<float>(foam_.max_radius(cell, ray_list_margin));
    return found->second;
  }

  /// The line of a strut of a list; valid until the next call.
  const StrutLine& line(uint32_t id) {
    return lines_.line(id, lists_.era(), [&] { return lists_.line(entries_, id); });
  }
  /// The entry into a strut of a list.
  StrutEntry entry(const FoamRay& ray, uint32_t id) { return entries_.find(ray, line(id)); }

  /// Tests the struts that a ray may meet by a list of a cell, each strut once, as far as they may
  /// come first. `near` begins at `in`. Updates the first of their entries and of those tested
  /// before.
  void ask(const FoamRay& ray, const CapsuleView& list, float radius, const CapsuleRay& near,
           double in, FirstEntry& first) {
    if (ids_.size() < list.count + capsule_padding) {
      ids_.resize(list.count + capsule_padding);
      from_.resize(list.count + capsule_padding);
    }
    size_t count = capsules_on_ray(list, radius + room(ray.error), near, ids_.data(), from_.data());
    for (; count > 0; --count) {
      size_t next = 0;
      for (size_t n = 1; n < count; ++n)
        if (from_[n] < from_[next]) next = n;
      if (first.entry.is_met && in + from_[next] > first.entry.t) return;
      const uint32_t id = ids_[next];
      ids_[next] = ids_[count - 1];
      from_[next] = from_[count - 1];
      // Cells share struts.
      if (std::find(first.queried.begin(), first.queried.end(), id) != first.queried.end())
        continue;
      first.queried.push_back(id);
      const StrutEntry found = entry(ray, id);
      if (comes_before(found, first.entry)) first.entry = found;
    }
  }

  /// Makes the entry the result of the search.
  void take(const StrutEntry& entry, RaySearch& search) const {
    search.found = true;
    search.t =
        entry.at_from ? search.from : std::clamp(entry.t * foam_.unit(), search.from, search.to);
    search.normal = entry.at_from ? Vec3{} : entry.normal;
    if (entry.by_ends) sharpen_entry(foam_, search);
  }

 private:
  const FoamData& foam_;
  const StrutEntries entries_;
  Struts& lists_;
  KnownLines& lines_;
  std::unordered_map<CellIndex, float, CellHash> radii_;  // if they vary
  std::vector<uint32_t> ids_;
  std::vector<float> from_;  // lower bounds of their entries
};

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// The struts in the way of rays: lists for cells, and exact entries into single ones.
#pragma once

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "cell/cell_hash.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeded_edges.h"
#include "structure/foam/strut_entry.h"
#include "structure/foam/strut_surface.h"
#include "strut/capsule_rays.h"

namespace msq {

/// Room for the rounding of places along rays in single precision, foam units.
constexpr float along_rounding = 4e-6f;

/// What a ray meets first of the struts that it was asked about.
struct FirstEntry {
  StrutEntry entry;
  std::vector<uint32_t> asked;

  void clear() {
    entry = {};
    asked.clear();
  }
};

/// `Struts`: lists of struts for cells: CellStruts, or as those.
template <class Struts>
class RayStruts {
 public:
  RayStruts(const Foam& foam, Struts& lists) : foam_(foam), entries_(foam), lists_(lists) {}

  Struts& lists() { return lists_; }
  /// All lists; to be called where they are full.
  void forget() {
    lists_.forget();
    radii_.clear();
  }
  FoamRay ray(const RaySearch& search) const { return entries_.ray(search); }

  /// No strut has a greater one in a cell; below 0 where there is none.
  float radius_in(CellIndex cell) {
    if (foam_.radius().is_constant()) return static_cast<float>(foam_.most_radius());
    const auto [found, is_new] = radii_.try_emplace(cell, 0.0f);
    if (is_new) found->second = static_cast<float>(foam_.most_radius(cell, ray_list_margin));
    return found->second;
  }

  /// Into a strut of a list.
  StrutEntry entry(const FoamRay& ray, uint32_t id) {
    // Rays that are close together meet few struts.
    Known& known = known_[id % std::size(known_)];
    if (known.id != id || known.era != lists_.era())
      known = {id, lists_.era(), lists_.line(entries_, id)};
    return entries_.find(ray, known.line);
  }

  /// Of those that a ray may meet by a list of a cell: the first of their entries and of those
  /// asked before, each strut once.
  void ask(const FoamRay& ray, const CapsuleView& list, float radius, const CapsuleRay& near,
           FirstEntry& first) {
    if (ids_.size() < list.count + capsule_padding) ids_.resize(list.count + capsule_padding);
    const size_t count = capsules_on_ray(list, radius, near, ids_.data());
    for (size_t n = 0; n < count; ++n) {
      // Cells have struts in common.
      if (std::find(first.asked.begin(), first.asked.end(), ids_[n]) != first.asked.end()) continue;
      first.asked.push_back(ids_[n]);
      const StrutEntry found = entry(ray, ids_[n]);
      if (comes_before(found, first.entry)) first.entry = found;
    }
  }

  /// The entry is what the ray meets.
  void take(const StrutEntry& entry, RaySearch& search) const {
    search.found = true;
    search.t =
        entry.at_from ? search.from : std::clamp(entry.t * foam_.unit(), search.from, search.to);
    search.normal = entry.at_from ? Vec3{} : entry.normal;
    if (entry.by_ends) sharpen_entry(foam_, search);
  }

 private:
  const Foam& foam_;
  const StrutEntries entries_;
  Struts& lists_;
  std::unordered_map<CellIndex, float, CellHash> radii_;  // where they vary
  struct Known {
    uint32_t id = UINT32_MAX;
    uint64_t era = 0;
    StrutLine line;
  };
  Known known_[256];
  std::vector<uint32_t> ids_;
};

}  // namespace msq

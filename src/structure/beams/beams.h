// SPDX-License-Identifier: Apache-2.0
// A list of beams: the union of their points. It has no grid, and its outside is empty.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/memory.h"
#include "structure/beams/beam_list.h"
#include "structure/beams/beam_tree.h"
#include "structure/structure.h"

namespace msq {

class Beams final : public Structure {
 public:
  /// At least one beam of the source must be kept. Lengths and coordinates are at most 1e75; radii
  /// are 0 or at least 1e-100. `length_scale`: the characteristic length; 0: the maximum length or
  /// diameter of a beam. The memory is taken from the budget.
  static Ref<Beams> make(const BeamSource& source, double length_scale, const Executor& executor,
                         const std::shared_ptr<MemoryBudget>& budget, Job* job);

  bool inside(Vec3 p) const override;
  /// Exact outside.
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override { return true; }
  double min_ray_step() const override { return ray_tolerance(); }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;

  /// In the order of the tree; each of equal beams once.
  const BeamList& beams() const { return beams_; }
  /// The number in the source of the beam at that place in the order of the tree.
  uint32_t number(size_t i) const { return numbers_[i]; }
  /// The others of equal beams, in the order of the places of those in beams().
  const std::vector<BeamRepeat>& repeats() const { return repeats_; }
  const BeamTree& tree() const { return tree_; }

 private:
  void describe(HashInput& input) const override;
  struct Parts;
  Beams(Parts&& parts, double length_scale);

  Reservation reservation_;
  std::vector<uint32_t> numbers_;
  std::vector<BeamRepeat> repeats_;
  BeamList beams_;
  BeamTree tree_;
};

}  // namespace msq

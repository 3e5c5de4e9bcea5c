// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/boolean_structure.h"

#include <algorithm>

#include "base/hash_input.h"
#include "base/infinity.h"
#include "structure/combined/member_lines.h"
#include "structure/combined/union_struts.h"
#include "structure/common/known_onset.h"
#include "structure/common/struts.h"

namespace msq {

bool BooleanStructure::inside(Vec3 p) const {
  for (size_t i = 0; i < members().size(); ++i)
    if (decides(i, members()[i]->inside(p))) return is_union();
  return !is_union();
}

template <class Distance>
std::pair<double, bool> BooleanStructure::combine(Distance&& distance) const {
  double bound = is_union() ? infinity : -infinity;
  bool is_decided = false;
  for (size_t i = 0; i < members().size(); ++i) {
    const double of_member = distance(i), own = is_wanted(i) ? of_member : 0.0 - of_member;
    bound = is_union() ? std::min(bound, own) : std::max(bound, own);
    is_decided = is_decided || decides(i, of_member <= 0);
  }
  return {std::abs(bound), is_decided == is_union()};
}

double BooleanStructure::distance_bound(Vec3 p) const {
  return combine([&](size_t i) { return distance_of_member(i, {}, p); }).first;
}

double BooleanStructure::distance_at_once(Vec3 p) const {
  const auto [bound, is_inside] = combine([&](size_t i) { return distance_of_member(i, {}, p); });
  return signed_distance(is_inside, bound);
}

// Once a member has taken distances, all do. Those before it do not decide.
CombinedStructure::Answer BooleanStructure::ask(Vec3 p) const {
  for (size_t m = 0; m < members().size(); ++m) {
    const Answer answer = ask_member(m, p);
    if (answer.distance) {
      const auto [bound, is_inside] = combine([&](size_t i) {
        std::optional<Answer> known;
        if (i < m) known = {is_wanted(i) != is_union()};
        if (i == m) known = answer;
        return distance_of_member(i, known, p);
      });
      return {is_inside, signed_distance(is_inside, bound)};
    }
    if (decides(m, answer.is_inside)) return {is_union()};
  }
  return {!is_union()};
}

// Kinds with struts and an onset have the radius of struts as their parameter.
bool BooleanStructure::has_onset() const {
  return is_union() &&
         std::all_of(members().begin(), members().end(), [](const Ref<const Structure>& member) {
           const Vec3 origin = member->neighbourhood().origin;
           return member->has_onset() && member->struts({{origin, origin}});
         });
}

// Beyond the least limit that of another member may be less.
double BooleanStructure::onset(Vec3 p) const {
  double onset = infinity;
  for (const Ref<const Structure>& member : members()) onset = std::min(onset, member->onset(p));
  return known_onset(*this, onset);
}

double BooleanStructure::parameter(Vec3 p) const {
  double least = infinity, difference = infinity, unknown_from = infinity;
  for (const Ref<const Structure>& member : members()) {
    const double onset = member->onset(p), own = member->parameter(p);
    least = std::min(least, onset);
    difference = std::min(difference, onset - own);
    if (!(onset < infinity)) unknown_from = std::min(unknown_from, member->onset_limit() - own);
  }
  // Where a member's onset is beyond its limit, the least difference may be its own.
  return difference <= unknown_from ? least - difference : -infinity;
}

double BooleanStructure::onset_limit() const {
  double limit = infinity;
  for (const Ref<const Structure>& member : members())
    limit = std::min(limit, member->onset_limit());
  return limit;
}

std::unique_ptr<StrutParts> BooleanStructure::struts(const StrutSelection& selection) const {
  return is_union() ? union_struts(members(), selection) : nullptr;
}

BoxClass BooleanStructure::classify(const Box3& box) const {
  const BoxClass deciding = is_union() ? BoxClass::inside : BoxClass::outside;
  bool is_mixed = false;
  for (size_t i = 0; i < members().size(); ++i) {
    BoxClass found = members()[i]->classify(box);
    if (!is_wanted(i) && found != BoxClass::mixed)
      found = found == BoxClass::inside ? BoxClass::outside : BoxClass::inside;
    if (found == deciding) return deciding;
    is_mixed = is_mixed || found == BoxClass::mixed;
  }
  if (is_mixed) return BoxClass::mixed;
  return is_union() ? BoxClass::outside : BoxClass::inside;
}

// Each member evaluates only what those before it leave open.
void BooleanStructure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (operation_ == Operation::intersected) {
    for (const Ref<const Structure>& member : members())
      keep_points_of(*member, points, alive, count);
    return;
  }
  std::vector<uint8_t> open(alive, alive + count), held;
  keep_points_of(*members()[0], points, alive, count);
  for (size_t m = 1; m < members().size(); ++m) {
    // Of a difference those that are inside so far, of a union those that are not.
    for (size_t i = 0; i < count; ++i)
      open[i] = static_cast<uint8_t>(is_union() ? open[i] & (alive[i] ^ 1) : alive[i]);
    held = open;
    keep_points_of(*members()[m], points, held.data(), count);
    for (size_t i = 0; i < count; ++i)
      alive[i] = static_cast<uint8_t>(is_union() ? alive[i] | held[i] : alive[i] & (held[i] ^ 1));
  }
}

void BooleanStructure::keep_rows(const RowBlock& block, const Job* job) const {
  if (operation_ == Operation::intersected) {
    for (const Ref<const Structure>& member : members()) member->keep_rows(block, job);
    return;
  }
  if (operation_ == Operation::subtracted) {
    members()[0]->keep_rows(block, job);
    for (size_t m = 1; m < members().size(); ++m) {
      const RowCopy held(block);
      members()[m]->keep_rows(held.block(), job);
      for_each_word(block, held.block(),
                    [](uint64_t& inside, uint64_t subtracted) { inside &= ~subtracted; });
    }
    return;
  }
  const RowCopy open(block);
  members()[0]->keep_rows(block, job);
  for (size_t m = 1; m < members().size(); ++m) {
    for_each_word(block, open.block(), [](uint64_t inside, uint64_t& left) { left &= ~inside; });
    if (m + 1 == members().size()) {
      members()[m]->keep_rows(open.block(), job);
      for_each_word(block, open.block(), [](uint64_t& inside, uint64_t held) { inside |= held; });
    } else {
      const RowCopy held(open.block());
      members()[m]->keep_rows(held.block(), job);
      for_each_word(block, held.block(), [](uint64_t& inside, uint64_t more) { inside |= more; });
    }
  }
}

unsigned BooleanStructure::row_copies() const {
  const unsigned own = operation_ == Operation::intersected || members().size() < 2 ? 0
                       : is_union() && members().size() > 2                         ? 2
                                                                                    : 1;
  return own + CombinedStructure::row_copies();
}

ThinWalls BooleanStructure::thin_walls() const {
  return walls_of_members(operation_, members());
}

LineGraph BooleanStructure::wall_lines(const WallSection& section) const {
  return lines_of_members(operation_, members(), section);
}

void BooleanStructure::describe(HashInput& input) const {
  input.kind("structure: boolean");
  input.integer(static_cast<uint64_t>(operation_));
  input.integer(members().size());
  for (const Ref<const Structure>& member : members()) input.object(*member);
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// What a part and its copies contain of a section of a row, as bits. Included once for each
// instruction set.
#if defined(MSQ_MARK_SECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_MARK_SECTION_INL_H
#undef MSQ_MARK_SECTION_INL_H
#else
#define MSQ_MARK_SECTION_INL_H
#endif

#include <algorithm>
#include <type_traits>

#include <hwy/highway.h>

#include "structure/lattice/rows/row_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// The columns of a section between the ends of a part, for the outer and the inner level.
struct SectionColumns {
  ColumnSets::Range outer, inner;

  HWY_INLINE SectionColumns(const RowTask& task, const RowWorkspace& workspace, size_t section,
                            size_t lane)
      : outer(task.columns->range(workspace.low[task.outer[section]][lane],
                                  workspace.high[task.outer[section]][lane] + 1)),
        inner(task.columns->range(workspace.low[task.inner[section]][lane] + 1,
                                  workspace.high[task.inner[section]][lane])) {}
};

/// Adds the samples within the inner level to the words of a section, which begin at the word
/// `first` of the row. `doubtful`: those that are within the outer level only, and not inside yet.
/// False if there are none. are_near: the levels are so near to each other that few sections have
/// any.
template <size_t section_words>
HWY_INLINE bool mark_section(const uint64_t* sets, const SectionColumns& columns, bool are_near,
                             size_t first, uint64_t* inside, uint64_t* doubtful) {
  const hn::CappedTag<uint64_t, section_words> d;
  const size_t part = first / ColumnSets::part_words, offset = first % ColumnSets::part_words;
  const ColumnSets::Range &outer = columns.outer, &inner = columns.inner;
  const auto set = [&](size_t number)
                       HWY_ATTR { return sets + number * ColumnSets::part_words + offset; };
  const uint64_t *const from = set(inner.from[part]), *const to = set(inner.to[part]);
  const auto flip = hn::Set(d, inner.flip);
  const auto least = [&](size_t word) HWY_ATTR {
    return hn::Xor(hn::Xor(hn::LoadU(d, from + word), hn::LoadU(d, to + word)), flip);
  };
  inside += first;
  if (are_near && HWY_LIKELY(outer.from[part] == inner.from[part] &&
                             outer.to[part] == inner.to[part] && outer.flip == inner.flip)) {
    for (size_t word = 0; word < section_words; word += hn::Lanes(d))
      hn::StoreU(hn::Or(hn::LoadU(d, inside + word), least(word)), d, inside + word);
    return false;
  }
  const uint64_t *const outer_from = set(outer.from[part]), *const outer_to = set(outer.to[part]);
  const auto outer_flip = hn::Set(d, outer.flip);
  auto any = hn::Zero(d);
  for (size_t word = 0; word < section_words; word += hn::Lanes(d)) {
    const auto most = hn::Xor(
        hn::Xor(hn::LoadU(d, outer_from + word), hn::LoadU(d, outer_to + word)), outer_flip);
    const auto now = hn::Or(hn::LoadU(d, inside + word), least(word));
    hn::StoreU(now, d, inside + word);
    const auto rest = hn::AndNot(now, most);
    hn::StoreU(rest, d, doubtful + word);
    any = hn::Or(any, rest);
  }
  return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
}

/// Draws a part into a row: the interval of a lane of the workspace. Calls visit(word, doubtful)
/// for the words of sections with samples in doubt, those that are alive.
template <size_t section_words, class Visit>
HWY_INLINE void mark_row(const RowTask& task, const RowWorkspace& workspace, bool is_even,
                         size_t lane, size_t row, const Visit& visit) {
  const uint64_t *const alive = task.alive[row], *const sets = task.columns->sets();
  uint64_t* const inside = task.inside + row * task.row_words();
  const size_t words = task.words;
  SectionColumns columns(task, workspace, 0, lane);
  for (size_t first = 0, section = 0; first < words; first += section_words, ++section) {
    if (!is_even) columns = SectionColumns(task, workspace, section, lane);
    HWY_ALIGN uint64_t doubtful[section_words];
    if (HWY_LIKELY(!mark_section<section_words>(sets, columns, is_even, first, inside, doubtful)))
      continue;
    const size_t end = std::min(section_words, words - first);
    for (size_t word = 0; word < end; ++word)
      visit(first + word, doubtful[word] & alive[first + word]);
  }
}

/// Calls the function with the number of words of a section as a constant.
template <class Function>
HWY_INLINE void with_section_words(size_t words, Function&& function) {
  if (words == 8)
    function(std::integral_constant<size_t, 8>());
  else if (words == 4)
    function(std::integral_constant<size_t, 4>());
  else
    function(std::integral_constant<size_t, 2>());
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif  // MSQ_MARK_SECTION_INL_H

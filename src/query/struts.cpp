// SPDX-License-Identifier: Apache-2.0
// Threads find the parts of a window in parallel. Then the caller takes them in order.
#include "query/struts.h"

#include <algorithm>

#include "query/strut_cuts.h"

namespace msq {

void for_each_strut(const Context& context, const StrutQuery& query, Job* job,
                    const std::function<void(const Strut* struts, size_t count)>& take) {
  const std::unique_ptr<StrutParts> parts = query.structure.struts(query.selection);
  if (!parts)
    fail(Status::unsupported,
         "the structure has no struts; lattices, foams with struts, beams, and unions of these "
         "have");
  const bool is_concurrent =
      query.structure.is_concurrent() && (!query.shape || query.shape->is_concurrent());
  const Executor& executor = context.executor_for(is_concurrent);
  struct Slot {
    StrutList found, cut;
  };
  std::vector<Slot> slots(executor.threads() == 1 ? 1 : 4 * executor.threads());
  const uint64_t count = parts->count();
  for (uint64_t first = 0; first < count; first += slots.size()) {
    const uint64_t here = std::min<uint64_t>(slots.size(), count - first);
    executor.for_each(here, [&](uint64_t i) {
      check_cancelled(job);
      Slot& slot = slots[i];
      slot.found.clear();
      parts->append(first + i, slot.found);
      if (!query.shape) return;
      slot.cut.clear();
      cut_struts(*query.shape, parts->radii_of(first + i), slot.found, slot.cut, job);
    });
    for (uint64_t i = 0; i < here; ++i) {
      const std::vector<Strut>& struts = query.shape ? slots[i].cut.struts : slots[i].found.struts;
      for (size_t at = 0; at < struts.size(); at += max_struts_at_once) {
        check_cancelled(job);
        take(struts.data() + at, std::min(max_struts_at_once, struts.size() - at));
      }
    }
    if (job)
      job->raise_progress(static_cast<double>(first + here) / static_cast<double>(count) *
                          (1 - 0x1p-20));
  }
}

}  // namespace msq

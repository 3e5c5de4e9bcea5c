// SPDX-License-Identifier: Apache-2.0
#include "printability/printability.h"

#include <cstddef>

#include "api/guard.h"
#include "api/host.h"
#include "api/warnings.h"

using namespace msq;
using namespace msq::api;

namespace {

// Findings are passed to the host without conversion.
static_assert(sizeof(Finding) == sizeof(msq_finding) && sizeof(msq_finding) == 112);
static_assert(offsetof(Finding, first_layer) == offsetof(msq_finding, first_layer));
static_assert(offsetof(Finding, sample_count) == offsetof(msq_finding, sample_count));
static_assert(offsetof(Finding, volume) == offsetof(msq_finding, volume));
static_assert(offsetof(Finding, point) == offsetof(msq_finding, point));
static_assert(offsetof(Finding, min) == offsetof(msq_finding, min));
static_assert(offsetof(Finding, max) == offsetof(msq_finding, max));
static_assert(static_cast<int>(FindingKind::island) == MSQ_FINDING_ISLAND);
static_assert(static_cast<int>(FindingKind::loose) == MSQ_FINDING_LOOSE);
static_assert(static_cast<int>(FindingKind::enclosed_void) == MSQ_FINDING_VOID);
static_assert(static_cast<int>(FindingKind::thin) == MSQ_FINDING_THIN);
static_assert(static_cast<int>(FindingKind::cup) == MSQ_FINDING_CUP);
static_assert(static_cast<int>(FindingKind::overhang) == MSQ_FINDING_OVERHANG);

msq_printability_def printability_defaults() {
  msq_printability_def def{};
  def.kinds = MSQ_FINDING_ISLAND | MSQ_FINDING_LOOSE | MSQ_FINDING_VOID;
  def.has_plate = 1;
  return def;
}

PrintabilityPlan read_plan(const msq_printability_def& def) {
  PrintabilityPlan plan;
  if (def.kinds == 0 || (def.kinds & ~all_finding_kinds))
    fail(Status::argument, "kinds is %u; it must be a sum of msq_finding_kind", def.kinds);
  plan.kinds = def.kinds;
  plan.has_plate = require_range(def.has_plate, 0, 1, "has_plate") != 0;
  require_reserved(def.reserved, "reserved");
  plan.width = require_not_negative(def.width, "width");
  if (plan.width != 0 && !(def.kinds & MSQ_FINDING_THIN))
    fail(Status::argument, "width is %g, and kinds does not contain MSQ_FINDING_THIN", def.width);
  plan.min_volume = require_not_negative(def.min_volume, "min_volume");
  plan.overhang = require_not_negative(def.overhang, "overhang");
  if (plan.overhang != 0 && !(def.kinds & MSQ_FINDING_OVERHANG))
    fail(Status::argument, "overhang is %g, and kinds does not contain MSQ_FINDING_OVERHANG",
         def.overhang);
  return plan;
}

}  // namespace

msq_status msq_printability_def_init(msq_printability_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, printability_defaults(), "msq_printability_def"); });
}

msq_status msq_printability(const msq_slicer* slicer, const msq_printability_def* def,
                            msq_findings_fn fn, void* user, msq_printability_report* report,
                            msq_job* job) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    // The callback may release the host's last references.
    const Ref<const Slicer> keep(&known);
    const Ref<Job> work(job ? &object(job, "job") : nullptr);
    const PrintabilityPlan plan =
        read_plan(def ? read_def(def, printability_defaults(), "def") : printability_defaults());
    check_struct_size<msq_printability_report>(require(report, "report").struct_size, "report");
    std::function<void(const Finding*, size_t)> take;
    if (fn)
      take = [&](const Finding* findings, size_t count) {
        check_code(
            call_host(fn, user, reinterpret_cast<const msq_finding*>(findings), uint64_t{count}),
            "of findings");
      };
    const PrintabilityCounts found = find_doubtful(known, plan, take, work.get());
    msq_printability_report written{};
    written.layer_count = found.layers;
    written.solid_count = found.solid_samples;
    written.solid_volume = found.solid_volume;
    written.island_count = found.counts[0];
    written.loose_count = found.counts[1];
    written.void_count = found.counts[2];
    written.thin_count = found.counts[3];
    written.island_volume = found.volumes[0];
    written.loose_volume = found.volumes[1];
    written.void_volume = found.volumes[2];
    written.thin_volume = found.volumes[3];
    written.cup_count = found.counts[4];
    written.overhang_count = found.counts[5];
    written.cup_volume = found.volumes[4];
    written.overhang_volume = found.volumes[5];
    warn_of_cache(known.model().context());
    write_report(report, written, "report");
  });
}

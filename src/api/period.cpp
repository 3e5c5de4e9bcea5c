// SPDX-License-Identifier: Apache-2.0
#include "api/period.h"

#include "api/guard.h"

namespace msq::api {

namespace {

msq_period_def period_defaults() {
  msq_period_def def{};
  def.axis = 2;
  return def;
}

}  // namespace

std::optional<GradedPeriod> read_period(const msq_period_def*& def, msq_period_def& known) {
  if (!def) return {};
  known = read_def(def, period_defaults(), "period");
  def = &known;
  require_range(known.axis, 0, 2, "period.axis");
  if (known.count < 1 || known.count > GradedPeriod::max_knots)
    fail(Status::argument, "period.count is %llu; it must be from 1 to %zu",
         static_cast<unsigned long long>(known.count), GradedPeriod::max_knots);
  if (!known.positions) fail(Status::argument, "period.positions is NULL");
  if (!known.cell_sizes) fail(Status::argument, "period.cell_sizes is NULL");
  std::vector<GradedPeriod::Knot> knots;
  for (uint64_t i = 0; i < known.count; ++i)
    knots.push_back({known.positions[i], known.cell_sizes[i]});
  return GradedPeriod(known.axis, knots);
}

}  // namespace msq::api

using namespace msq;
using namespace msq::api;

msq_status msq_period_def_init(msq_period_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, period_defaults(), "msq_period_def"); });
}

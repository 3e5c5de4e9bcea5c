// SPDX-License-Identifier: Apache-2.0
#include "api/host.h"
#include "field/host.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_host_field_def host_field_defaults() {
  msq_host_field_def def{};
  def.low = def.high = std::numeric_limits<double>::quiet_NaN();
  def.lipschitz = std::numeric_limits<double>::infinity();
  return def;
}

}  // namespace

msq_status msq_host_field_def_init(msq_host_field_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, host_field_defaults(), "msq_host_field_def"); });
}

msq_status msq_field_host(msq_context* context, const msq_host_field_def* def, msq_field** field) {
  return guard([&] {
    object(context, "context");
    require(field, "field");
    const msq_host_field_def known = read_def(def, host_field_defaults(), "def");
    const bool is_concurrent = require_range(known.concurrent, 0, 1, "concurrent") != 0;
    if (!known.evaluate) fail(Status::argument, "evaluate is NULL");
    const Interval range{require_finite(known.low, "low"), require_finite(known.high, "high")};
    if (range.low > range.high)
      fail(Status::argument, "low is %g and high is %g; low must not be greater", range.low,
           range.high);
    Ref<HostField> made = make_ref<HostField>(
        HostFieldCalls{values_call(known.evaluate, known.user, "evaluate"),
                       range_call(known.range, known.user, "range")},
        range, require_zero_or_more(known.lipschitz, "lipschitz"), is_concurrent);
    made->user().set_key(known.hash_key);
    made->user().own(known.user, known.release);
    *field = new_handle<msq_field>(Ref<Field>(std::move(made)));
  });
}

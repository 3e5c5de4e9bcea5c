// SPDX-License-Identifier: Apache-2.0
#include "api/host.h"
#include "api/shape_size.h"
#include "shape/host.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_host_shape_def host_shape_defaults() {
  msq_host_shape_def def{};
  for (int axis = 0; axis < 3; ++axis)
    def.min[axis] = def.max[axis] = std::numeric_limits<double>::quiet_NaN();
  return def;
}

}  // namespace

msq_status msq_host_shape_def_init(msq_host_shape_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, host_shape_defaults(), "msq_host_shape_def"); });
}

msq_status msq_shape_from_host(msq_context* context, const msq_host_shape_def* def,
                               msq_shape** shape) {
  return guard([&] {
    object(context, "context");
    require(shape, "shape");
    const msq_host_shape_def known = read_def(def, host_shape_defaults(), "def");
    const bool is_concurrent = require_range(known.concurrent, 0, 1, "concurrent") != 0;
    if (!known.inside) fail(Status::argument, "inside is NULL");
    HostShapeCalls calls;
    calls.inside = inside_call(known.inside, known.user, "inside");
    if (known.distance) calls.distance = values_call(known.distance, known.user, "distance");
    Ref<HostShape> made =
        make_ref<HostShape>(std::move(calls), read_box(known.min, known.max), is_concurrent);
    made->user().set_key(known.hash_key);
    made->user().own(known.user, known.release);
    *shape = new_handle<msq_shape>(Ref<Shape>(std::move(made)));
  });
}

// SPDX-License-Identifier: Apache-2.0
#include "api/defined_handle.h"
#include "api/expression.h"
#include "api/guard.h"
#include "api/image.h"
#include "field/expression.h"
#include "field/gradient.h"
#include "field/grid.h"
#include "field/map.h"
#include "field/radial.h"
#include "field/shape_distance.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t max_knots = 65536;
/// Maps within each other: calls through them go as deep.
constexpr unsigned max_maps = 64;

msq_radial_field_def radial_defaults() {
  msq_radial_field_def def{};
  def.to_radius = 1;
  return def;
}

msq_grid_field_def grid_defaults() {
  msq_grid_field_def def{};
  def.image = image_defaults();
  return def;
}

double require_difference(double from, double to, const char* name) {
  if (!std::isfinite(to - from))
    fail(Status::argument, "%s run from %g to %g; their difference must be finite", name, from, to);
  return to - from;
}

Curve read_curve(const double* curve, uint64_t count) {
  if (count < 1 || count > max_knots)
    fail(Status::argument, "curve_count is %llu; it must be from 1 to %llu",
         static_cast<unsigned long long>(count), static_cast<unsigned long long>(max_knots));
  require(curve, "curve");
  std::vector<Curve::Knot> knots(count);
  for (uint64_t i = 0; i < count; ++i) {
    const double at = curve[2 * i], value = curve[2 * i + 1];
    const auto number = static_cast<unsigned long long>(i);
    if (!std::isfinite(at) || !std::isfinite(value))
      fail(Status::argument, "pair %llu of curve is (%g, %g); it must be finite", number, at,
           value);
    if (i > 0) {
      const Curve::Knot& last = knots[i - 1];
      if (!(at > last.at))
        fail(Status::argument,
             "pair %llu of curve is at %g and the one before at %g; they must ascend", number, at,
             last.at);
      require_difference(last.at, at, "places of curve");
      require_difference(last.value, value, "values of curve");
    }
    knots[i] = {at, value};
  }
  return Curve(std::move(knots));
}

}  // namespace

msq_status msq_field_gradient(msq_context* context, const double from[3], double from_value,
                              const double to[3], double to_value, msq_field** field) {
  return guard([&] {
    object(context, "context");
    const Vec3 a = require_vector(from, "from"), b = require_vector(to, "to");
    require_finite(from_value, "from_value");
    require_finite(to_value, "to_value");
    require(field, "field");
    // Less squares to what has no 53 bits, more to what is not finite.
    constexpr double min_length = 1e-140;
    const double length_squared = dot(b - a, b - a);
    if (!(length_squared >= min_length * min_length) || !std::isfinite(length_squared))
      fail(Status::argument,
           "from (%g, %g, %g) and to (%g, %g, %g) are %g apart; they must be %g to 1.3e154 apart",
           a.x, a.y, a.z, b.x, b.y, b.z, std::hypot(b.x - a.x, b.y - a.y, b.z - a.z), min_length);
    require_difference(from_value, to_value, "values");
    *field = defined_handle<msq_field>(
        make_ref<GradientField>(a, from_value, b, to_value),
        GradientDef{{a.x, a.y, a.z}, from_value, {b.x, b.y, b.z}, to_value});
  });
}

void msq_field_retain(msq_field* field) {
  retain(field);
}
void msq_field_release(msq_field* field) {
  release(field);
}

msq_status msq_radial_field_def_init(msq_radial_field_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, radial_defaults(), "msq_radial_field_def"); });
}

msq_status msq_field_radial(msq_context* context, const msq_radial_field_def* def,
                            msq_field** field) {
  return guard([&] {
    object(context, "context");
    require(field, "field");
    const msq_radial_field_def known = read_def(def, radial_defaults(), "def");
    require_reserved(known.reserved, "reserved");
    const Vec3 centre = require_vector(known.center, "center");
    const Vec3 axis = require_vector(known.axis, "axis");
    RadialField::Ramp ramp{require_finite(known.from_radius, "from_radius"),
                           require_finite(known.from_value, "from_value"),
                           require_finite(known.to_radius, "to_radius"),
                           require_finite(known.to_value, "to_value")};
    if (!(ramp.from_radius >= 0 && ramp.from_radius < ramp.to_radius))
      fail(Status::argument,
           "from_radius is %g and to_radius is %g; they must ascend, from 0 or more",
           ramp.from_radius, ramp.to_radius);
    require_difference(ramp.from_value, ramp.to_value, "values");
    *field = defined_handle<msq_field>(make_ref<RadialField>(centre, axis, ramp), known);
  });
}

msq_status msq_grid_field_def_init(msq_grid_field_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, grid_defaults(), "msq_grid_field_def"); });
}

msq_status msq_field_grid(msq_context* context, const msq_grid_field_def* def, msq_field** field) {
  return guard([&] {
    const Context& owner = object(context, "context");
    require(field, "field");
    const msq_grid_field_def known = read_def(def, grid_defaults(), "def");
    require_reserved(known.reserved, "reserved");
    *field = defined_handle<msq_field>(
        make_ref<GridField>(read_image(known.image, 1, owner.budget)), GridDef{known, {}});
  });
}

msq_status msq_shape_distance_field_def_init(msq_shape_distance_field_def* def, size_t size) {
  return guard([&] {
    set_defaults(def, size, msq_shape_distance_field_def{}, "msq_shape_distance_field_def");
  });
}

msq_status msq_field_shape_distance(msq_context* context, const msq_shape_distance_field_def* def,
                                    msq_field** field, msq_job* job) {
  return guard([&] {
    const Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // callbacks may release the host's last reference
    require(field, "field");
    const msq_shape_distance_field_def known = read_def(def, msq_shape_distance_field_def{}, "def");
    require_reserved(known.reserved, "reserved");
    const Ref<const Shape> shape(&object(known.shape, "shape"));
    if (!shape->is_bounded())
      fail(Status::unsupported, "the shape is all space; it has no distance to a boundary");
    Curve curve = read_curve(known.curve, known.curve_count);
    if (!(known.step >= 0) || !std::isfinite(known.step))
      fail(Status::argument, "step is %g; it must be finite and not negative", known.step);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    Ref<const Field> distance;
    if (known.step > 0) {
      distance = make_ref<GridField>(sample_distance(
          *shape, known.step, owner.executor_for(shape->is_concurrent()), owner.budget, work));
    } else {
      shape->prepare_distance(work);  // queries are not to exceed the memory limit half-way
      distance = make_ref<ShapeDistanceField>(shape);
    }
    *field =
        defined_handle<msq_field>(make_ref<MapField>(std::move(distance), std::move(curve)), known);
    scope.done();
  });
}

msq_status msq_expression_field_def_init(msq_expression_field_def* def, size_t size) {
  return guard(
      [&] { set_defaults(def, size, msq_expression_field_def{}, "msq_expression_field_def"); });
}

msq_status msq_field_expression(msq_context* context, const msq_expression_field_def* def,
                                msq_field** field) {
  return guard([&] {
    object(context, "context");
    require(field, "field");
    const msq_expression_field_def known = read_def(def, msq_expression_field_def{}, "def");
    require_reserved(known.reserved, "reserved");
    Tape tape = read_expression(known.expression, known.parameters, known.parameter_count);
    const Interval range{require_finite(known.low, "low"), require_finite(known.high, "high")};
    if (!(range.low <= range.high))
      fail(Status::argument, "low is %g and high is %g; low must be no more", range.low,
           range.high);
    *field = defined_handle<msq_field>(make_ref<ExpressionField>(std::move(tape), range), known);
  });
}

msq_status msq_field_map(msq_context* context, const msq_field* argument, const double* curve,
                         uint64_t curve_count, msq_field** field) {
  return guard([&] {
    object(context, "context");
    const Field& known = object(argument, "argument");
    Curve read = read_curve(curve, curve_count);
    require(field, "field");
    if (known.depth() >= max_maps)
      fail(Status::limit, "%u maps would be within each other; the limit is %u", known.depth() + 1,
           max_maps);
    *field =
        defined_handle<msq_field>(make_ref<MapField>(Ref<const Field>(&known), std::move(read)),
                                  MapDef{argument, curve, curve_count});
  });
}

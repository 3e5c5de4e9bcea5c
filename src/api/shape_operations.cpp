// SPDX-License-Identifier: Apache-2.0
// Shapes made of other shapes.
#include "api/defined_handle.h"
#include "api/guard.h"
#include "api/members.h"
#include "api/shape_size.h"
#include "shape/boolean.h"
#include "shape/offset.h"
#include "shape/placed.h"

using namespace msq;
using namespace msq::api;

namespace {

/// A new shape made of others, if it is not too large and these not too deep within each other.
template <class Def>
msq_shape* made_of_shapes(const Ref<Shape>& shape, const Def& def) {
  require_small(*shape, "shapes");
  check_size(max_magnitude(shape->bounds().extent()), shape->bounds().min);
  return defined_handle<msq_shape>(shape, def);
}

/// Shapes of shapes need a box: all space is refused.
const Shape& require_bounded(const Shape& shape, const char* name) {
  if (!shape.is_bounded())
    fail(Status::unsupported, "%s is all space; it must be a shape with bounds", name);
  return shape;
}

}  // namespace

msq_status msq_shape_placed(const msq_shape* original, const double matrix[12], msq_shape** shape) {
  return guard([&] {
    const Shape& known = require_bounded(object(original, "original"), "original");
    if (!matrix) fail(Status::argument, "matrix is NULL");
    require(shape, "shape");
    std::array<double, 12> numbers;
    std::copy_n(matrix, numbers.size(), numbers.begin());
    PlacedDef def{original, {}};
    std::copy(numbers.begin(), numbers.end(), def.matrix);
    *shape =
        made_of_shapes(make_ref<PlacedShape>(Ref<const Shape>(&known), Placement(numbers)), def);
  });
}

msq_status msq_shape_boolean(int32_t operation, const msq_shape* const* shapes, uint64_t count,
                             msq_shape** shape) {
  return guard([&] {
    const auto known = static_cast<BooleanShape::Operation>(
        require_range(operation, MSQ_BOOLEAN_UNION, MSQ_BOOLEAN_DIFFERENCE, "operation"));
    require_members(shapes, count, "shapes");
    require(shape, "shape");
    std::vector<Ref<const Shape>> members = read_members<Shape>(
        shapes, count, "shapes", [](const Shape& member, uint64_t i) -> const Shape& {
          return require_bounded(member, ("shapes[" + std::to_string(i) + "]").c_str());
        });
    *shape = made_of_shapes(make_ref<BooleanShape>(known, std::move(members)),
                            BooleanDef{operation, shapes, count});
  });
}

msq_status msq_shape_offset(const msq_shape* original, double distance, msq_shape** shape) {
  return guard([&] {
    const Shape& known = require_bounded(object(original, "original"), "original");
    require(shape, "shape");
    if (require_finite(distance, "distance") == 0)
      fail(Status::argument, "distance is 0; it must be positive or negative");
    if (!(distance > 0 ? known.is_exact_outside() : known.is_exact_inside()))
      fail(Status::unsupported,
           "the distance is %g, and that of the original is a mere bound %s of it", distance,
           distance > 0 ? "outside" : "inside");
    check_size(std::abs(distance), known.bounds().min);
    *shape = made_of_shapes(make_ref<OffsetShape>(Ref<const Shape>(&known), distance),
                            OffsetDef{original, distance});
  });
}

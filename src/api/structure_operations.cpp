// SPDX-License-Identifier: Apache-2.0
// Structures made of other structures.
#include <limits>

#include "api/defined_handle.h"
#include "api/guard.h"
#include "api/level.h"
#include "api/members.h"
#include "structure/combined/blended_structure.h"
#include "structure/combined/boolean_structure.h"
#include "structure/combined/smooth_boolean.h"

using namespace msq;
using namespace msq::api;

namespace {

/// A new structure made of others, if these are not too many or too deep within each other.
template <class Def>
msq_structure* made_of_structures(const Ref<CombinedStructure>& structure, const Def& def) {
  require_small(*structure, "structures");
  return defined_handle<msq_structure>(structure, def);
}

BooleanStructure::Operation read_operation(int32_t operation) {
  return static_cast<BooleanStructure::Operation>(
      require_range(operation, MSQ_BOOLEAN_UNION, MSQ_BOOLEAN_DIFFERENCE, "operation"));
}

/// One of two structures that are joined by their distances.
Ref<const Structure> read_steady(const msq_structure* structure, const char* name) {
  const Structure& known = object(structure, name);
  if (!known.has_steady_distance())
    fail(Status::unsupported,
         "the distance of %s has no Lipschitz constant: its radius, level or thickness is a field "
         "without one, its function has no bounded slope, or the host gives no distance",
         name);
  return Ref<const Structure>(&known);
}

}  // namespace

msq_status msq_structure_boolean(int32_t operation, const msq_structure* const* structures,
                                 uint64_t count, msq_structure** structure) {
  return guard([&] {
    const auto known = read_operation(operation);
    require_members(structures, count, "structures");
    require(structure, "structure");
    StructureList members = read_members<Structure>(
        structures, count, "structures",
        [](const Structure& member, uint64_t) -> const Structure& { return member; });
    *structure = made_of_structures(make_ref<BooleanStructure>(known, std::move(members)),
                                    StructureBooleanDef{operation, structures, count});
  });
}

msq_status msq_structure_blend(const msq_structure* a, const msq_structure* b,
                               const msq_param* fraction, msq_structure** structure) {
  return guard([&] {
    const Ref<const Structure> first = read_steady(a, "a"), second = read_steady(b, "b");
    require(fraction, "fraction");
    require(structure, "structure");
    const Parameter part = read_parameter(*fraction, "fraction");
    const Interval range = part.range();
    if (!(range.low >= 0 && range.high <= 1))
      fail(Status::argument, "fraction is from %g to %g; it must be within 0 and 1", range.low,
           range.high);
    *structure = made_of_structures(make_ref<BlendedStructure>(first, second, part),
                                    StructureBlendDef{a, b, *fraction});
  });
}

msq_status msq_structure_smooth_boolean(int32_t operation, const msq_structure* a,
                                        const msq_structure* b, const msq_param* radius,
                                        msq_structure** structure) {
  return guard([&] {
    const auto known = read_operation(operation);
    const Ref<const Structure> first = read_steady(a, "a"), second = read_steady(b, "b");
    require(radius, "radius");
    require(structure, "structure");
    const Parameter size = read_parameter(*radius, "radius");
    const Interval range = size.range();
    if (!(range.low >= 0 && range.high <= std::numeric_limits<double>::max()))
      fail(Status::argument, "radius is from %g to %g; it must be finite and at least 0", range.low,
           range.high);
    *structure = made_of_structures(make_ref<SmoothBoolean>(known, first, second, size),
                                    StructureSmoothBooleanDef{operation, a, b, *radius});
  });
}

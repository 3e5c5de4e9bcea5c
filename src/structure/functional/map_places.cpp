// SPDX-License-Identifier: Apache-2.0
// The operations are those of Image::to_voxels() and Image::value(), in their order. Minima and
// maxima of samples may differ in the sign of a zero, which the position in the cell does not have.
#include "structure/functional/map_places.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/map_places.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/mask_bits-inl.h"
#include "base/pi.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Doubles = hn::ScalableTag<double>;
using Indices = hn::RebindToSigned<Doubles>;
using Vector = hn::Vec<Doubles>;

HWY_INLINE Vector gather(const double* values, hn::Vec<Indices> at) {
  return hn::GatherIndex(Doubles(), values, at);
}

HWY_INLINE Vector join(Vector a, Vector b, Vector f) {
  const Vector v = hn::Add(a, hn::Mul(f, hn::Sub(b, a)));
  return hn::Min(hn::Max(v, hn::Min(a, b)), hn::Max(a, b));
}

/// The voxel, a whole number, and the position in it along an axis.
struct LocatedLanes {
  Vector cell, fraction;
};
HWY_INLINE LocatedLanes located(Vector u, double top, uint64_t cells) {
  const Doubles d;
  const Vector zero = hn::Zero(d), most = hn::Set(d, top);
  const Vector within =
      hn::IfThenElse(hn::Gt(u, zero), hn::IfThenElse(hn::Lt(u, most), u, most), zero);
  const Vector cell = hn::Min(hn::Floor(within), hn::Set(d, static_cast<double>(cells - 1)));
  return {cell, hn::Sub(within, cell)};
}

void angles_by_map(const SampledMap& map, const double* const (&samples)[3], Values x, Values y,
                   Values z, size_t count, double* const (&angles)[3], uint64_t* in) {
  const Doubles d;
  const Indices i64;
  const Image& image = map.image(0);
  const Vec3 origin = image.frame().origin, scale = image.scale();
  const auto& m = image.frame().rotation.m;
  const uint64_t row = image.size(0), layer = row * image.size(1);
  const double top[3] = {static_cast<double>(image.size(0) - 1),
                         static_cast<double>(image.size(1) - 1),
                         static_cast<double>(image.size(2) - 1)};
  const auto load = [&](const Values& v, size_t i) HWY_ATTR {
    return v.is_uniform ? hn::Set(d, *v.data) : hn::LoadU(d, v.data + i);
  };
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Vector px = hn::Sub(load(x, i), hn::Set(d, origin.x)),
                 py = hn::Sub(load(y, i), hn::Set(d, origin.y)),
                 pz = hn::Sub(load(z, i), hn::Set(d, origin.z));
    const auto along = [&](size_t axis) HWY_ATTR {
      const auto g =
          hn::Add(hn::Add(hn::Mul(hn::Set(d, m[axis]), px), hn::Mul(hn::Set(d, m[3 + axis]), py)),
                  hn::Mul(hn::Set(d, m[6 + axis]), pz));
      return hn::Mul(g, hn::Set(d, scale[static_cast<int>(axis)]));
    };
    const Vector ux = along(0), uy = along(1), uz = along(2);
    if (in) {
      const auto within = [&](Vector u, double most) HWY_ATTR {
        return hn::And(hn::Ge(u, hn::Zero(d)), hn::Le(u, hn::Set(d, most)));
      };
      const uint64_t bits =
          bits_of(d, hn::And(hn::And(within(ux, top[0]), within(uy, top[1])), within(uz, top[2])));
      if (i % 64 == 0) in[i / 64] = 0;
      in[i / 64] |= bits << i % 64;
    }
    const LocatedLanes lx = located(ux, top[0], image.cells(0)),
                       ly = located(uy, top[1], image.cells(1)),
                       lz = located(uz, top[2], image.cells(2));
    // Whole numbers below 2^53.
    const auto number = hn::Add(hn::Add(hn::Mul(lz.cell, hn::Set(d, static_cast<double>(layer))),
                                        hn::Mul(ly.cell, hn::Set(d, static_cast<double>(row)))),
                                lx.cell);
    const auto at = hn::ConvertTo(i64, number);
    const auto next_row = hn::Set(i64, static_cast<int64_t>(row)),
               next_layer = hn::Set(i64, static_cast<int64_t>(layer));
    for (size_t c = 0; c < 3; ++c) {
      const auto edge = [&](auto first) HWY_ATTR {
        return join(gather(samples[c], first), gather(samples[c], hn::Add(first, next_layer)),
                    lz.fraction);
      };
      const auto face = [&](auto first) HWY_ATTR {
        return join(edge(first), edge(hn::Add(first, next_row)), ly.fraction);
      };
      const Vector value = join(face(at), face(hn::Add(at, hn::Set(i64, int64_t{1}))), lx.fraction);
      const Vector fraction = hn::Sub(value, hn::Floor(value));
      hn::StoreU(hn::Mul(fraction, hn::Set(d, two_pi)), d, angles[c] + i);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "structure/functional/row_kernels.h"

namespace msq {

HWY_EXPORT(angles_by_map);

void find_map_places(const SampledMap& map, Values x, Values y, Values z, size_t count,
                     double* const (&angles)[3], uint64_t* in) {
  const double* samples[3] = {};
  for (int c = 0; c < 3; ++c)
    samples[c] = map.image(c).visit([](const auto* values) -> const double* {
      if constexpr (std::is_same_v<decltype(values), const double*>)
        return values;
      else
        return nullptr;
    });
  if (samples[0] && samples[1] && samples[2])
    return HWY_DYNAMIC_DISPATCH(angles_by_map)(map, samples, x, y, z, count, angles, in);
  for (size_t i = 0; i < count; ++i) {
    const SampledMap::Place place = map.place({x[i], y[i], z[i]});
    for (int c = 0; c < 3; ++c) {
      const double u = place.cells[c];
      angles[c][i] = angle_of(u - std::floor(u));
    }
    if (!in) continue;
    if (i % 64 == 0) in[i / 64] = 0;
    in[i / 64] |= uint64_t{place.is_in_box} << i % 64;
  }
}

}  // namespace msq
#endif  // HWY_ONCE

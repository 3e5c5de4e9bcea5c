// SPDX-License-Identifier: Apache-2.0
// Colours: linear, as light adds up, and as bytes of sRGB.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

/// Linear, each part multiplied by the opacity.
struct Colour {
  float r = 0, g = 0, b = 0, opacity = 0;
};

inline Colour operator+(Colour a, Colour b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b, a.opacity + b.opacity};
}
inline Colour operator*(Colour a, float s) {
  return {a.r * s, a.g * s, a.b * s, a.opacity * s};
}

/// Opaque.
inline Colour colour_of(Vec3 rgb) {
  return {static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z), 1};
}

/// The byte nearest to a linear part, cut to 0 and 1, in sRGB (IEC 61966-2-1).
uint8_t srgb_byte(float linear);

/// Red, green, blue in sRGB and the opacity, none of them multiplied by it.
void write_rgba(Colour colour, uint8_t* rgba);

/// What things are coloured by where the host gives no colours.
const std::vector<Vec3>& palette();

}  // namespace msq

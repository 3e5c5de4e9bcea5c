// SPDX-License-Identifier: Apache-2.0
// Colours: linear, for the addition of light, and as bytes in sRGB.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

/// Linear; each component is multiplied by the opacity.
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

/// The byte nearest to a linear component, clamped to [0, 1], in sRGB (IEC 61966-2-1).
uint8_t srgb_byte(float linear);

/// Writes red, green and blue in sRGB and the opacity. The colours are not multiplied by the
/// opacity.
void write_rgba(Colour colour, uint8_t* rgba);

/// The colours used if the host gives none.
const std::vector<Vec3>& palette();

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "ray/colour.h"

#include <array>

namespace msq {

namespace {

double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// sRGB rises by at most 12.92 * 255 = 3295 bytes per unit, so that no step contains two borders
/// between bytes.
constexpr int table_steps = 4096;

struct SrgbTable {
  /// The start of byte b + 1.
  std::array<float, 256> next;
  /// The byte at the start of each step.
  std::array<uint8_t, table_steps + 1> first;

  SrgbTable() {
    for (int b = 0; b < 255; ++b)
      next[static_cast<size_t>(b)] = static_cast<float>(linear_of((b + 0.5) / 255));
    next[255] = 2;
    uint8_t byte = 0;
    for (size_t i = 0; i <= table_steps; ++i) {
      while (static_cast<float>(i) / table_steps >= next[byte]) ++byte;
      first[i] = byte;
    }
  }

  uint8_t byte(float linear) const {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const uint8_t byte = first[static_cast<size_t>(linear * table_steps)];
    return linear >= next[byte] ? static_cast<uint8_t>(byte + 1) : byte;
  }
};

const SrgbTable& srgb() {
  static const SrgbTable table;
  return table;
}

Vec3 from_bytes(int r, int g, int b) {
  return {linear_of(r / 255.0), linear_of(g / 255.0), linear_of(b / 255.0)};
}

}  // namespace

uint8_t srgb_byte(float linear) {
  return srgb().byte(linear);
}

void write_rgba(Colour colour, uint8_t* rgba) {
  const SrgbTable& table = srgb();
  const float part = colour.opacity > 0 ? 1 / colour.opacity : 0;
  rgba[0] = table.byte(colour.r * part);
  rgba[1] = table.byte(colour.g * part);
  rgba[2] = table.byte(colour.b * part);
  rgba[3] = static_cast<uint8_t>(std::min(colour.opacity, 1.0f) * 255 + 0.5f);
}

const std::vector<Vec3>& palette() {
  static const std::vector<Vec3> colours = {
      from_bytes(214, 209, 200), from_bytes(226, 164, 84),  from_bytes(84, 148, 190),
      from_bytes(116, 176, 112), from_bytes(202, 104, 92),  from_bytes(150, 128, 188),
      from_bytes(96, 180, 172),  from_bytes(206, 190, 104),
  };
  return colours;
}

}  // namespace msq

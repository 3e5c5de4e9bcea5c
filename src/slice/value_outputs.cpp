// SPDX-License-Identifier: Apache-2.0
// Signed distances and materials of pixels: set queries on the grid of a layer.
#include <cstring>
#include <vector>

#include "query/distance.h"
#include "query/grid_points.h"
#include "query/material.h"
#include "slice/layer_output.h"

namespace msq {

namespace {

/// So many rows are computed at once that the values of a strip take little memory.
constexpr uint64_t strip_pixels = uint64_t{1} << 18;

/// Writes the pixels of a layer from one value per point, strip by strip. query(points, values)
/// finds them; put(value, at) writes a pixel and returns whether it is inside.
template <class Value, class Query, class Put>
uint64_t write_values(const LayerSource& source, unsigned pixel_bytes, uint8_t* out, Query&& query,
                      Put&& put) {
  const SampleGrid& pixels = source.pixels;
  const uint64_t width = pixels.nx, stride = layer_stride(pixel_bytes, width);
  const uint64_t rows = std::max<uint64_t>(1, strip_pixels / width);
  std::vector<Value> values;
  uint64_t inside = 0;
  for (uint64_t first = 0; first < pixels.ny; first += rows) {
    SampleGrid strip = pixels;
    strip.ny = std::min(rows, pixels.ny - first);
    strip.first[1] += first;
    const GridPoints points(strip);
    values.resize(points.count());
    query(points, values.data());
    for (uint64_t j = 0; j < strip.ny; ++j) {
      uint8_t* row = out + (first + j) * stride;
      std::memset(row + stride - 8, 0, 8);
      for (uint64_t i = 0; i < width; ++i)
        inside += put(values[j * width + i], row + i * pixel_bytes);
    }
  }
  return inside;
}

class DistanceOutput final : public LayerOutput {
 public:
  unsigned pixel_bytes() const override { return sizeof(float); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    return write_values<double>(
        source, pixel_bytes(), out,
        [&](const GridPoints& points, double* distances) {
          set_distance(source.model, source.resolved, points, distances, source.job);
        },
        [](double distance, uint8_t* at) {
          const auto rounded = static_cast<float>(distance);
          std::memcpy(at, &rounded, sizeof rounded);
          return distance <= 0;
        });
  }
};

class MaterialOutput final : public LayerOutput {
 public:
  unsigned pixel_bytes() const override { return sizeof(uint32_t); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    return write_values<uint32_t>(
        source, pixel_bytes(), out,
        [&](const GridPoints& points, uint32_t* ids) {
          set_material(source.model, source.resolved, points, {}, {}, ids, nullptr, source.job);
        },
        [](uint32_t id, uint8_t* at) {
          std::memcpy(at, &id, sizeof id);
          return id != 0;
        });
  }
};

}  // namespace

std::unique_ptr<const LayerOutput> make_distance_output() {
  return std::make_unique<DistanceOutput>();
}

std::unique_ptr<const LayerOutput> make_material_output() {
  return std::make_unique<MaterialOutput>();
}

}  // namespace msq

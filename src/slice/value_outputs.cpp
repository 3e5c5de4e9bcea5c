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

/// Calls write_rows(points, first row, number of rows) for strips of a layer.
template <class WriteRows>
void for_each_strip(const SampleGrid& pixels, WriteRows&& write_rows) {
  const uint64_t rows = std::max<uint64_t>(1, strip_pixels / pixels.nx);
  for (uint64_t first = 0; first < pixels.ny; first += rows) {
    SampleGrid strip = pixels;
    strip.ny = std::min(rows, pixels.ny - first);
    strip.first[1] += first;
    write_rows(GridPoints(strip), first, strip.ny);
  }
}

class DistanceOutput final : public LayerOutput {
 public:
  unsigned pixel_bytes() const override { return sizeof(float); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    const uint64_t width = source.pixels.nx, stride = layer_stride(pixel_bytes(), width);
    std::vector<double> distances;
    uint64_t inside = 0;
    for_each_strip(source.pixels, [&](const GridPoints& points, uint64_t first, uint64_t rows) {
      distances.resize(points.count());
      set_distance(source.model, source.resolved, points, distances.data(), source.job);
      for (uint64_t j = 0; j < rows; ++j) {
        uint8_t* row = out + (first + j) * stride;
        std::memset(row + stride - 8, 0, 8);
        for (uint64_t i = 0; i < width; ++i) {
          const double distance = distances[j * width + i];
          inside += distance <= 0;
          const auto rounded = static_cast<float>(distance);
          std::memcpy(row + i * sizeof rounded, &rounded, sizeof rounded);
        }
      }
    });
    return inside;
  }
};

class MaterialOutput final : public LayerOutput {
 public:
  unsigned pixel_bytes() const override { return sizeof(uint32_t); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    const uint64_t width = source.pixels.nx, stride = layer_stride(pixel_bytes(), width);
    std::vector<uint32_t> ids;
    uint64_t inside = 0;
    for_each_strip(source.pixels, [&](const GridPoints& points, uint64_t first, uint64_t rows) {
      ids.resize(points.count());
      set_material(source.model, source.resolved, points, {}, {}, ids.data(), nullptr, source.job);
      for (uint64_t j = 0; j < rows; ++j) {
        uint8_t* row = out + (first + j) * stride;
        std::memset(row + stride - 8, 0, 8);
        std::memcpy(row, &ids[j * width], width * sizeof(uint32_t));
      }
      for (const uint32_t id : ids) inside += id != 0;
    });
    return inside;
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

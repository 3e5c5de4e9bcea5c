// SPDX-License-Identifier: Apache-2.0
// Signed distances, materials, channels and onsets of pixels: set queries on the grid of a layer.
#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "query/array_points.h"
#include "query/distance.h"
#include "query/grid_points.h"
#include "query/material.h"
#include "query/reach.h"
#include "query/values.h"
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
  std::vector<Vec3> mapped;
  uint64_t inside = 0;
  for (uint64_t first = 0; first < pixels.ny; first += rows) {
    SampleGrid strip = pixels;
    strip.ny = std::min(rows, pixels.ny - first);
    strip.first[1] += first;
    const GridPoints points(strip);
    values.resize(points.count());
    if (source.frame.is_that_of_model()) {
      query(points, values.data());
    } else {
      mapped.resize(points.count());
      points.read(0, points.count(), mapped.data());
      for (Vec3& p : mapped) p = source.frame.to_model(p);
      PointArray array;
      array.data = reinterpret_cast<const unsigned char*>(mapped.data());
      array.count = mapped.size();
      array.stride = sizeof(Vec3);
      query(ArrayPoints(array), values.data());
    }
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
        [&](const PointSet& points, double* distances) {
          set_distance(source.model, source.resolved, points, distances, source.job);
        },
        [](double distance, uint8_t* at) {
          auto rounded = static_cast<float>(distance);
          // The sign is that of membership, also where the distance is the least double above 0.
          if (distance > 0) rounded = std::max(rounded, std::numeric_limits<float>::min());
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
        [&](const PointSet& points, uint32_t* ids) {
          set_material(source.model, source.resolved, points, {}, {}, ids, nullptr, source.job);
        },
        [](uint32_t id, uint8_t* at) {
          std::memcpy(at, &id, sizeof id);
          return id != 0;
        });
  }
};

class ChannelOutput final : public LayerOutput {
 public:
  explicit ChannelOutput(std::string channel) : channel_(std::move(channel)) {}
  unsigned pixel_bytes() const override { return sizeof(float); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    std::vector<uint32_t> ids;
    uint64_t inside = 0;
    write_values<double>(
        source, pixel_bytes(), out,
        [&](const PointSet& points, double* values) {
          ids.resize(points.count());
          set_material(source.model, source.resolved, points, {}, {channel_}, ids.data(), values,
                       source.job);
          for (const uint32_t id : ids) inside += id != 0;
        },
        [](double value, uint8_t* at) {
          const auto rounded = static_cast<float>(value);
          std::memcpy(at, &rounded, sizeof rounded);
          return false;
        });
    return inside;
  }

 private:
  const std::string channel_;
};

class OnsetOutput final : public LayerOutput {
 public:
  OnsetOutput(const Structure& structure, bool is_signed)
      : structure_(structure), is_signed_(is_signed) {}
  unsigned pixel_bytes() const override { return sizeof(float); }
  unsigned samples_across() const override { return 0; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    const Context& context = source.model.context();
    return write_values<double>(
        source, pixel_bytes(), out,
        [&](const PointSet& points, double* onsets) {
          require_reach(structure_, context.executor, points, 0);
          OnsetPlan plan;
          plan.is_signed = is_signed_;
          plan.onsets = onsets;
          set_onset(structure_, points, plan, context.executor_for(structure_.is_concurrent()),
                    source.job);
        },
        [](double onset, uint8_t* at) {
          const auto rounded = static_cast<float>(onset);
          std::memcpy(at, &rounded, sizeof rounded);
          return false;
        });
  }

 private:
  const Structure& structure_;  // of a scale of the slicer's model
  const bool is_signed_;
};

}  // namespace

std::unique_ptr<const LayerOutput> make_distance_output() {
  return std::make_unique<DistanceOutput>();
}

std::unique_ptr<const LayerOutput> make_material_output() {
  return std::make_unique<MaterialOutput>();
}

std::unique_ptr<const LayerOutput> make_channel_output(const std::string& channel) {
  return std::make_unique<ChannelOutput>(channel);
}

std::unique_ptr<const LayerOutput> make_onset_output(const Structure& structure, bool is_signed) {
  return std::make_unique<OnsetOutput>(structure, is_signed);
}

}  // namespace msq

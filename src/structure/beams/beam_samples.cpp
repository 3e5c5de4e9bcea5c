// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_samples.h"

#include <algorithm>
#include <cmath>

#include "structure/beams/beam_distance.h"

namespace msq {

namespace {

constexpr uint64_t tile_rows = 16, tile_layers = 8;
/// Beams that a sample may look at before boxes pay; and so few that boxes do not.
constexpr uint64_t looks_to_a_sample = 64, few_beams = 4;

}  // namespace

BeamSamples::BeamSamples(const Beams& beams, const RowBlock& block, const Job* job)
    : structure_(beams), block_(block), job_(job) {}

void BeamSamples::keep() {
  for (uint64_t z = block_.z0; z < block_.z1; z += tile_layers)
    for (uint64_t y = block_.y0; y < block_.y1; y += tile_rows)
      for (uint64_t x = 0; x < block_.grid->nx; x += bits_per_word)
        keep_tile({{x, y, z},
                   {std::min(x + bits_per_word, block_.grid->nx),
                    std::min(y + tile_rows, block_.y1), std::min(z + tile_layers, block_.z1)}});
}

template <class Holds>
void BeamSamples::keep_alive(const Box& box, Holds&& holds) {
  for (uint64_t k = box.first[2]; k < box.end[2]; ++k)
    for (uint64_t j = box.first[1]; j < box.end[1]; ++j) {
      uint64_t& word = block_.row(j, k)[box.first[0] / bits_per_word];
      for (uint64_t i = box.first[0]; i < box.end[0]; ++i) {
        const uint64_t bit = uint64_t{1} << (i % bits_per_word);
        if ((word & bit) && !holds(block_.grid->at(i, j, k))) word &= ~bit;
      }
    }
}

bool BeamSamples::is_in_a_beam(Vec3 p) {
  return !structure_.tree().find_overlapping({p, p}, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (++looks_ % 65536 == 0) check_cancelled(job_);
      if (structure_.beams().at(i).holds(p)) return false;
    }
    return true;
  });
}

// The boxes of a tile look at each beam in its box a few times. So they pay once as many beams were
// looked at one by one as there are.
void BeamSamples::keep_tile(const Box& tile) {
  check_cancelled(job_);
  const uint64_t most = looks_ + structure_.beams().size() + looks_to_a_sample * tile.samples();
  keep_alive(tile, [&](Vec3 p) { return looks_ > most || is_in_a_beam(p); });
  if (looks_ <= most) return;
  // Samples that were not queried are alive. Those that are inside are queried again, which changes
  // nothing.
  beams_.clear();
  structure_.tree().find_overlapping(bounds(tile), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) beams_.push_back(static_cast<uint32_t>(i));
    return true;
  });
  halve(tile, 0);
}

Box3 BeamSamples::bounds(const Box& box) const {
  const SampleGrid& grid = *block_.grid;
  return {grid.at(box.first[0], box.first[1], box.first[2]),
          grid.at(box.end[0] - 1, box.end[1] - 1, box.end[2] - 1)};
}

bool BeamSamples::select(const Box3& box, size_t begin, size_t end) {
  // Any sample is within `reach` of the middle: half of the diagonal, and what rounding adds.
  const Vec3 middle = box.min + (box.max - box.min) * 0.5;
  const double reach = 0.5 * length(box.extent()) * (1 + 0x1p-40) + block_.grid->rounding() +
                       0x1p-44 * std::max(max_magnitude(box.min), max_magnitude(box.max));
  CancelPoll poll(job_);
  for (size_t n = begin; n < end; ++n) {
    poll();
    ++looks_;
    const Beam beam = structure_.beams().at(beams_[n]);
    const Vec3 ab = beam.b - beam.a, to = middle - beam.a;
    const double squared = dot(ab, ab);
    const double t = squared > 0 ? std::clamp(dot(to, ab) / squared, 0.0, 1.0) : 0;
    const Vec3 away = to - ab * t;
    const double from_axis2 = dot(away, away), thick = std::max(beam.radius_a, beam.radius_b);
    // A beam is within the capsule of its thicker end.
    const double far = thick + reach + 2 * beam.rounding();
    if (from_axis2 > far * far * (1 + 0x1p-40)) continue;
    const double near = thick - reach;
    if (near > 0 && from_axis2 <= near * near &&
        depth_in_beam(beam, middle) > reach + 2 * beam.rounding())
      return true;
    beams_.push_back(beams_[n]);
  }
  return false;
}

void BeamSamples::halve(const Box& box, size_t begin) {
  bool is_empty = true;
  keep_alive(box, [&](Vec3) {
    is_empty = false;
    return true;
  });
  if (is_empty) return;
  const Box3 around = bounds(box);
  const size_t end = beams_.size();
  if (end - begin > few_beams && box.samples() > 1) {
    const bool is_within = select(around, begin, end);
    int axis = -1;
    for (int n = 0; n < 3; ++n)
      if (box.end[n] - box.first[n] > 1 && (axis < 0 || around.extent()[n] > around.extent()[axis]))
        axis = n;
    if (!is_within) {
      Box low = box, high = box;
      low.end[axis] = high.first[axis] = (box.first[axis] + box.end[axis]) / 2;
      halve(low, end);
      halve(high, end);
    }
    beams_.resize(end);
    return;
  }
  CancelPoll poll(job_);
  keep_alive(box, [&](Vec3 p) {
    return std::any_of(beams_.begin() + static_cast<std::ptrdiff_t>(begin), beams_.end(),
                       [&](uint32_t i) {
                         poll();
                         ++looks_;
                         return structure_.beams().at(i).holds(p);
                       });
  });
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_rows.h"

namespace msq {

namespace {

/// Beams drawn at once; and the number of beams per sample above which samples are evaluated one by
/// one: a sample costs about as much as a beam of few rows.
constexpr size_t batch = StrutBatch::capacity;
constexpr double max_beams_to_a_sample = 1;

}  // namespace

BeamRows::BeamRows(const Beams& beams, const RowBlock& block, const Job* job)
    : beams_(beams),
      job_(job),
      raster_(block),
      capsules_(batches_->capsules),
      frusta_(batches_->frusta),
      balls_(batches_->balls) {
  capsules_.count = frusta_.count = balls_.count = 0;
  const Box3 box = raster_.box();
  // The error of sample positions is a few units of 2^-53 of the largest magnitude.
  margin_ =
      0x1p-44 * std::max(max_magnitude(box.min), max_magnitude(box.max)) + block.grid->rounding();
  reach_ = box.grown(margin_);
  of_capsules_.reserve(batch);
  others_.reserve(batch);
}

bool BeamRows::find() {
  const double most = max_beams_to_a_sample * raster_.samples();
  double count = 0;
  return beams_.tree().find_overlapping(reach_, [&](size_t begin, size_t end) {
    found_.push_back({static_cast<uint32_t>(begin), static_cast<uint32_t>(end)});
    count += static_cast<double>(end - begin);
    return count <= most;
  });
}

void BeamRows::keep() {
  constexpr size_t ahead = 8;
  for (size_t n = 0; n < found_.size(); ++n) {
    if (n + ahead < found_.size())
      beams_.beams().prefetch(found_[n + ahead].begin, found_[n + ahead].end);
    for (size_t i = found_[n].begin; i < found_[n].end; ++i) {
      const Beam beam = beams_.beams().at(i);
      if (beam.box().overlaps(reach_)) add(beam);
    }
  }
  draw_capsules();
  draw_others();
  raster_.finish(job_, [](Vec3) { return false; });
}

void BeamRows::add(const Beam& beam) {
  if (!beam.is_capsule()) {
    const auto number = static_cast<uint32_t>(others_.size());
    if (beam.has_length()) frusta_.push(beam, number);
    if (beam.cap_a != BeamCap::butt) balls_.push(beam, false, number);
    if (beam.cap_b != BeamCap::butt) balls_.push(beam, true, number);
    others_.push_back(beam);
    other_rounding_ = std::max(other_rounding_, beam.rounding());
    if (others_.size() == batch) draw_others();
    return;
  }
  capsules_.low[capsules_.count] = capsules_.high[capsules_.count] = beam.radius_a;
  capsules_.push(beam.a, beam.b);
  of_capsules_.push_back(beam);
  capsule_rounding_ = std::max(capsule_rounding_, beam.rounding());
  if (capsules_.full()) draw_capsules();
}

void BeamRows::draw_capsules() {
  check_cancelled(job_);
  raster_.add_solids(capsules_, margin_ + capsule_rounding_,
                     [&](uint32_t n, Vec3 p) { return of_capsules_[n].holds(p); });
  capsules_.count = 0;
  of_capsules_.clear();
  capsule_rounding_ = 0;
}

void BeamRows::draw_others() {
  check_cancelled(job_);
  raster_.add_solids(
      margin_ + other_rounding_,
      [&](const RasterTarget& target, DoubtfulSpans& doubts) {
        draw_frusta(target, frusta_, others_.data(), doubts);
        draw_balls(target, balls_, others_.data(), doubts);
      },
      [&](uint32_t n, Vec3 p) { return others_[n].holds(p); });
  frusta_.count = balls_.count = 0;
  others_.clear();
  other_rounding_ = 0;
}

}  // namespace msq

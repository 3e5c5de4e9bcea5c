// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_struts.h"

#include <algorithm>

#include "base/job.h"

namespace msq {

namespace {

constexpr size_t beams_in_part = 4096;

Id node_at(Vec3 p) {
  IdHash hash(1);
  hash.add(p);
  return hash.id();
}

class BeamStruts final : public StrutsOfOne {
 public:
  BeamStruts(const Beams& beams, const StrutSelection& selection)
      : beams_(beams), selection_(selection) {
    // A beam's box contains its middle; if the beam is near the box, then its own box, grown by its
    // greatest radius, meets it.
    const Box3 around = selection.around(beams.cell_length());
    beams.tree().find_overlapping(around, [&](size_t begin, size_t end) {
      check_cancelled();
      add({begin, end, false});
      if (beams.repeats().empty()) return true;
      const size_t first = first_repeat(begin), last = first_repeat(end);
      if (first < last) add({first, last, true});
      return true;
    });
    parts_.push_back(ranges_.size());
  }

  uint64_t count() const override { return parts_.size() - 1; }

  void append(uint64_t part, StrutList& list) const override {
    for (size_t r = parts_[part]; r < parts_[part + 1]; ++r) {
      check_cancelled();
      for (size_t i = ranges_[r].begin; i < ranges_[r].end; ++i) {
        if (ranges_[r].is_of_repeats) {
          const BeamRepeat& repeat = beams_.repeats()[i];
          append(beams_.beams().at(repeat.place), repeat.number, list);
        } else {
          append(beams_.beams().at(i), beams_.number(i), list);
        }
      }
    }
  }

  double radius_at(const Strut& strut, double, double t, Vec3) const override {
    return strut.radii[0] * (1 - t) + strut.radii[1] * t;
  }

 private:
  struct Range {
    size_t begin, end;
    bool is_of_repeats;
  };

  /// Parts have at most beams_in_part beams, because there may be any number of repeats.
  void add(Range range) {
    while (range.begin < range.end) {
      if (in_part_ >= beams_in_part) {
        parts_.push_back(ranges_.size());
        in_part_ = 0;
      }
      const size_t end = std::min(range.end, range.begin + (beams_in_part - in_part_));
      in_part_ += end - range.begin;
      // A range may go on with the next one, but not beyond its part.
      if (parts_.back() < ranges_.size() && ranges_.back().end == range.begin &&
          ranges_.back().is_of_repeats == range.is_of_repeats)
        ranges_.back().end = end;
      else
        ranges_.push_back({range.begin, end, range.is_of_repeats});
      range.begin = end;
    }
  }

  /// The first repeat of a beam from that place on.
  size_t first_repeat(size_t place) const {
    const std::vector<BeamRepeat>& repeats = beams_.repeats();
    const auto found =
        std::lower_bound(repeats.begin(), repeats.end(), place,
                         [](const BeamRepeat& repeat, size_t p) { return repeat.place < p; });
    return static_cast<size_t>(found - repeats.begin());
  }

  void append(const Beam& beam, uint32_t number, StrutList& list) const {
    if (!selection_.selects(beam.a, beam.b, std::max(beam.radius_a, beam.radius_b))) return;
    Strut strut;
    strut.id = {number, 0};
    strut.nodes[0] = node_at(beam.a);
    strut.nodes[1] = node_at(beam.b);
    strut.a = beam.a;
    strut.b = beam.b;
    strut.radii[0] = beam.radius_a;
    strut.radii[1] = beam.radius_b;
    strut.caps[0] = static_cast<uint8_t>(beam.cap_a);
    strut.caps[1] = static_cast<uint8_t>(beam.cap_b);
    list.add(strut, 1);
  }

  const Beams& beams_;
  const StrutSelection selection_;
  size_t in_part_ = beams_in_part;
  std::vector<Range> ranges_;
  std::vector<size_t> parts_;  // first range of each part, and the number of ranges
};

}  // namespace

std::unique_ptr<StrutParts> beam_struts(const Beams& beams, const StrutSelection& selection) {
  return std::make_unique<BeamStruts>(beams, selection);
}

}  // namespace msq

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
    size_t in_part = beams_in_part;
    beams.tree().find_overlapping(around, [&](size_t begin, size_t end) {
      check_cancelled();
      if (in_part >= beams_in_part) {
        parts_.push_back(ranges_.size());
        in_part = 0;
      }
      // A range may go on with the leaf after it, but not beyond its part.
      const bool goes_on = in_part > 0 && ranges_.back().end == begin;
      if (goes_on)
        ranges_.back().end = end;
      else
        ranges_.push_back({begin, end});
      in_part += end - begin;
      return true;
    });
    parts_.push_back(ranges_.size());
  }

  uint64_t count() const override { return parts_.size() - 1; }

  void append(uint64_t part, StrutList& list) const override {
    for (size_t r = parts_[part]; r < parts_[part + 1]; ++r) {
      check_cancelled();
      for (size_t i = ranges_[r].begin; i < ranges_[r].end; ++i) {
        const Beam beam = beams_.beams().at(i);
        if (!selection_.selects(beam.a, beam.b, std::max(beam.radius_a, beam.radius_b))) continue;
        Strut strut;
        strut.id = {beams_.number(i), 0};
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
    }
  }

  double radius_at(const Strut& strut, double, double t, Vec3) const override {
    return strut.radii[0] * (1 - t) + strut.radii[1] * t;
  }

 private:
  struct Range {
    size_t begin, end;
  };

  const Beams& beams_;
  const StrutSelection selection_;
  std::vector<Range> ranges_;
  std::vector<size_t> parts_;  // first range of each part, and the number of ranges
};

}  // namespace

std::unique_ptr<StrutParts> beam_struts(const Beams& beams, const StrutSelection& selection) {
  return std::make_unique<BeamStruts>(beams, selection);
}

}  // namespace msq

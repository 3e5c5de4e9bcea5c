// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/shell/shelled_struts.h"

#include <algorithm>

namespace msq {

namespace {

class ShelledStruts final : public StrutParts {
 public:
  ShelledStruts(std::unique_ptr<StrutParts> all, const Warp& warp)
      : all_(std::move(all)), warp_(warp) {}

  uint64_t count() const override { return all_->count(); }

  void append(uint64_t part, StrutList& list) const override {
    size_t kept = list.struts.size();
    all_->append(part, list);
    for (size_t i = kept; i < list.struts.size(); ++i) {
      if (!meets_shell(list.struts[i])) continue;
      list.struts[kept] = list.struts[i];
      list.factors[kept++] = list.factors[i];
    }
    list.struts.resize(kept);
    list.factors.resize(kept);
  }

  const StrutRadii& radii_of(uint64_t part) const override { return all_->radii_of(part); }

 private:
  // The radius is continuous along a strut, so it takes all values between its least and greatest.
  bool meets_shell(const Strut& strut) const {
    Vec3 a = warp_.grid().to_grid(strut.a), b = warp_.grid().to_grid(strut.b);
    if (warp_.kind() == Warp::Kind::cylindrical) a.z = b.z = 0;
    const double most = std::max(length(a), length(b));
    const Vec3 way = b - a;
    const double squared = dot(way, way);
    const double t = squared > 0 ? std::clamp(-dot(a, way) / squared, 0.0, 1.0) : 0;
    return most >= warp_.shell().inner && length(a + way * t) <= warp_.outer();
  }

  const std::unique_ptr<StrutParts> all_;
  const Warp& warp_;
};

}  // namespace

std::unique_ptr<StrutParts> shelled_struts(std::unique_ptr<StrutParts> struts, const Warp& warp) {
  if (!struts) return nullptr;
  return std::make_unique<ShelledStruts>(std::move(struts), warp);
}

}  // namespace msq

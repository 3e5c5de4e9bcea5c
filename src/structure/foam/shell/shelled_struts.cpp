// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/shell/shelled_struts.h"

namespace msq {

namespace {

class ShelledStruts final : public StrutParts {
 public:
  ShelledStruts(std::unique_ptr<StrutParts> all, const CellShell& shell)
      : all_(std::move(all)), shell_(shell) {}

  uint64_t count() const override { return all_->count(); }

  void append(uint64_t part, StrutList& list) const override {
    size_t kept = list.struts.size();
    all_->append(part, list);
    for (size_t i = kept; i < list.struts.size(); ++i) {
      if (!shell_.meets(list.struts[i].a, list.struts[i].b)) continue;
      list.struts[kept] = list.struts[i];
      list.factors[kept++] = list.factors[i];
    }
    list.struts.resize(kept);
    list.factors.resize(kept);
  }

  const StrutRadii& radii_of(uint64_t part) const override { return all_->radii_of(part); }

 private:
  const std::unique_ptr<StrutParts> all_;
  const CellShell& shell_;
};

}  // namespace

std::unique_ptr<StrutParts> shelled_struts(std::unique_ptr<StrutParts> struts,
                                           const CellShell& shell) {
  if (!struts) return nullptr;
  return std::make_unique<ShelledStruts>(std::move(struts), shell);
}

}  // namespace msq

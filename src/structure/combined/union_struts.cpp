// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/union_struts.h"

#include <algorithm>

#include "structure/common/struts.h"

namespace msq {

namespace {

class UnionStruts final : public StrutParts {
 public:
  explicit UnionStruts(std::vector<std::unique_ptr<StrutParts>> members)
      : members_(std::move(members)) {
    for (const std::unique_ptr<StrutParts>& member : members_) {
      firsts_.push_back(count_);
      count_ += member->count();
    }
  }

  uint64_t count() const override { return count_; }

  void append(uint64_t part, StrutList& list) const override {
    const size_t member = member_of(part), from = list.struts.size();
    members_[member]->append(part - firsts_[member], list);
    for (size_t i = from; i < list.struts.size(); ++i) {
      Strut& strut = list.struts[i];
      for (Id* id : {&strut.id, &strut.nodes[0], &strut.nodes[1]}) {
        IdHash hash(6);
        hash.add(uint64_t{member});
        hash.add(id->low);
        hash.add(id->high);
        *id = hash.id();
      }
    }
  }

  const StrutRadii& radii_of(uint64_t part) const override {
    const size_t member = member_of(part);
    return members_[member]->radii_of(part - firsts_[member]);
  }

 private:
  size_t member_of(uint64_t part) const {
    return static_cast<size_t>(std::upper_bound(firsts_.begin(), firsts_.end(), part) -
                               firsts_.begin()) -
           1;
  }

  const std::vector<std::unique_ptr<StrutParts>> members_;
  std::vector<uint64_t> firsts_;  // number of each member's first part
  uint64_t count_ = 0;
};

}  // namespace

std::unique_ptr<StrutParts> union_struts(const StructureList& members,
                                         const StrutSelection& selection) {
  std::vector<std::unique_ptr<StrutParts>> parts;
  for (const Ref<const Structure>& member : members) {
    parts.push_back(member->struts(selection));
    if (!parts.back()) return nullptr;
  }
  return std::make_unique<UnionStruts>(std::move(parts));
}

}  // namespace msq

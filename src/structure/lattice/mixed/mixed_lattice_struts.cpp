// SPDX-License-Identifier: Apache-2.0
// The struts of a lattice with a library of unit cells. A cell owns struts of its own unit cell and
// of those of the cells before it, on the faces between them.
#include "structure/lattice/mixed/mixed_lattice.h"

namespace msq {

namespace {

class MixedStruts final : public LatticeStruts {
 public:
  MixedStruts(const MixedLattice& lattice, const LatticeGraph& graph, const Parameter& radius,
              const StrutSelection& selection)
      : LatticeStruts(graph, lattice.neighbourhood(), radius, selection), lattice_(lattice) {}

 private:
  class Types final : public Finder {
   public:
    Types(const MixedLattice& lattice, const LatticeGraph& graph, const Block& block)
        : graph_(graph),
          width_(static_cast<size_t>(block.size[0]) + 1),
          height_(static_cast<size_t>(block.size[1]) + 1) {
      for (int32_t z = -1; z < block.size[2]; ++z)
        for (int32_t y = -1; y < block.size[1]; ++y)
          for (int32_t x = -1; x < block.size[0]; ++x)
            types_.push_back(
                lattice.type_of({block.first.x + x, block.first.y + y, block.first.z + z}));
    }
    const std::vector<LatticeGraph::Use>& find(int32_t x, int32_t y, int32_t z) override {
      uses_.clear();
      for (uint32_t back = 0; back < 8; ++back) {
        const auto i = [&](int32_t at, uint32_t axis) {
          return static_cast<size_t>(at + 1) - (back >> axis & 1);
        };
        const size_t type = types_[(i(z, 2) * height_ + i(y, 1)) * width_ + i(x, 0)];
        const std::vector<LatticeGraph::Use>& uses = graph_.uses(type, back);
        uses_.insert(uses_.end(), uses.begin(), uses.end());
      }
      LatticeGraph::merge(uses_);
      return uses_;
    }

   private:
    const LatticeGraph& graph_;
    const size_t width_, height_;
    std::vector<size_t> types_;  // of the block's cells and those just before
    std::vector<LatticeGraph::Use> uses_;
  };

  std::unique_ptr<Finder> finder(const Block& block) const override {
    return std::make_unique<Types>(lattice_, graph_, block);
  }

  const MixedLattice& lattice_;
};

}  // namespace

std::unique_ptr<StrutParts> MixedLattice::struts(const StrutSelection& selection) const {
  return std::make_unique<MixedStruts>(*this, graph_, radius_, selection);
}

}  // namespace msq

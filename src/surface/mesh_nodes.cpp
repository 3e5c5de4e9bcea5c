// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_nodes.h"

#include <algorithm>

#include "query/membership.h"

namespace msq {

uint64_t MeshNodes::bytes(uint64_t layers) const {
  const SampleGrid& samples = grid_.samples();
  return ((layers + 1) * layer_words_ + layers * words_for(samples.nx) * samples.ny +
          fill_slab_scratch_words(model_, resolved_, samples, layers)) *
         sizeof(uint64_t);
}

void MeshNodes::load(uint32_t first, uint32_t last, const Job* job) {
  const uint32_t begin = std::max(first, std::min(end_, last + 1));  // the first that is not known
  if (begin > first)
    std::copy(bits_.begin() + static_cast<ptrdiff_t>((first - first_) * layer_words_),
              bits_.begin() + static_cast<ptrdiff_t>((begin - first_) * layer_words_),
              bits_.begin());
  bits_.resize((last + 1 - first) * layer_words_);
  std::fill(bits_.begin() + static_cast<ptrdiff_t>((begin - first) * layer_words_), bits_.end(), 0);
  first_ = first;
  end_ = last + 1;

  const SampleGrid& samples = grid_.samples();
  const uint64_t z0 = std::max<uint64_t>(begin, 1) - 1, z1 = std::min<uint64_t>(last, samples.nz);
  if (z0 >= z1) return;
  const size_t raw_words = words_for(samples.nx);
  raw_.resize((z1 - z0) * samples.ny * raw_words);
  fill_slab(model_, resolved_, samples, z0, z1, raw_.data(), job);
  // One node on, for the one beyond the box.
  model_.executor().for_each(z1 - z0, [&](uint64_t layer) {
    for (uint64_t j = 0; j < samples.ny; ++j) {
      const uint64_t* in = raw_.data() + (layer * samples.ny + j) * raw_words;
      uint64_t* out =
          bits_.data() + (z0 + layer + 1 - first_) * layer_words_ + (j + 1) * row_words_;
      for (size_t w = 0; w < row_words_; ++w)
        out[w] = (w < raw_words ? in[w] << 1 : 0) | (w > 0 ? in[w - 1] >> 63 : 0);
    }
  });
}

}  // namespace msq

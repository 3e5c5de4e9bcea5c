// SPDX-License-Identifier: Apache-2.0
// Models of shapes, fields, structures, skins and materials of every kind, with parameters of all
// sizes: whatever msq accepts answers alike by points, arrays, grids, layers, distances and rays,
// in bounded time.
#include "objects.h"

namespace msq::fuzz {

void run_definitions(const uint8_t* data, size_t size) {
  Input input(data, size);
  const Owner<msq_context> context = make_context(1 + (input.chance(32) ? 1 : 0));
  const Job job;
  Maker maker(input, context.get(), job);
  const Owner<msq_model> model = maker.model();
  if (model && !job.is_cancelled())
    check_model(input, context.get(), model.get(), maker.sight(), job);
}

}  // namespace msq::fuzz

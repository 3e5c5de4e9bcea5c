// SPDX-License-Identifier: Apache-2.0
#include "api/file_def.h"

namespace msq::api {

msq_file_def file_defaults() {
  const MeshFileOptions options;
  msq_file_def def{};
  def.winding_rule = MSQ_WINDING_AUTO;
  def.unit_mm = options.unit_mm;
  def.max_bytes = options.max_bytes;
  def.max_triangles = options.max_triangles;
  return def;
}

WindingRule winding_rule(int32_t rule) {
  return static_cast<WindingRule>(
      require_range(rule, MSQ_WINDING_NONZERO, MSQ_WINDING_AUTO, "winding_rule"));
}

FileRequest file_request(const msq_file_def* def, const Context& owner) {
  const msq_file_def known = def ? read_def(def, file_defaults(), "def") : file_defaults();
  require_reserved(known.reserved, "reserved");
  FileRequest request;
  request.options.format = static_cast<MeshFormat>(
      require_range(known.format, MSQ_FORMAT_AUTO, MSQ_FORMAT_GLTF, "format"));
  request.options.unit_mm = require_positive(known.unit_mm, "unit_mm");
  const MeshFileOptions defaults;
  request.options.max_bytes = known.max_bytes ? known.max_bytes : defaults.max_bytes;
  request.options.max_triangles =
      known.max_triangles ? known.max_triangles : defaults.max_triangles;
  request.options.budget = owner.budget;
  request.rule = winding_rule(known.winding_rule);
  return request;
}

}  // namespace msq::api

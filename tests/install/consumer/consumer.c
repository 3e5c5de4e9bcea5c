/* SPDX-License-Identifier: Apache-2.0
 * The least that a host does: the library is the one of the header, and answers a point. */
#include <msq.h>
#include <stdio.h>

int main(void) {
  const double min[3] = {0, 0, 0}, max[3] = {1, 1, 1}, point[3] = {0.5, 0.5, 0.5};
  msq_context* context = NULL;
  msq_shape* box = NULL;
  msq_model* model = NULL;
  msq_scale_def scale = {0};
  msq_model_def def;
  int32_t inside = 0;

  if (msq_version() != MSQ_VERSION) return 1;
  if (msq_context_create(NULL, &context) != MSQ_OK) goto failed;
  if (msq_shape_from_box(context, min, max, &box) != MSQ_OK) goto failed;
  if (msq_model_def_init(&def, sizeof def) != MSQ_OK) goto failed;
  scale.shape = box;
  def.scales = &scale;
  def.scale_count = 1;
  def.scale_size = sizeof scale;
  if (msq_model_create(context, &def, &model) != MSQ_OK) goto failed;
  if (msq_point_membership(model, point, NULL, &inside) != MSQ_OK) goto failed;
  msq_model_release(model);
  msq_shape_release(box);
  msq_context_release(context);
  printf("msq %u: %s\n", (unsigned)msq_version(), inside ? "inside" : "outside");
  return inside == 1 ? 0 : 1;

failed:
  fprintf(stderr, "%s\n", msq_error_message());
  return 1;
}

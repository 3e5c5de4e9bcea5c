/* SPDX-License-Identifier: Apache-2.0
 * A ball with a solid skin of 1.5 mm over a foam. Prints the layer through its middle. */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "skin: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double center[3] = {0, 0, 0};
  msq_shape* ball;
  check(msq_shape_from_sphere(context, center, 15, &ball));

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 6;
  foam_def.radius.value = 0.7;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  /* The scale of the foam leaves the skin. A field in skin.field makes it thick where it must be.
   */
  const msq_scale_def scales[2] = {{.shape = ball}, {.structure = foam, .skin = {.value = 1.5}}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  msq_slicer_def plan; /* 64 x 32 pixels, twice as high as wide, like characters */
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.output = MSQ_LAYER_BYTES;
  plan.resolution[0] = 64;
  plan.resolution[1] = 32;
  plan.layer_height = 1;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  static uint8_t pixels[32][64];
  check(msq_slice_layer(slicer, 15, &pixels[0][0], sizeof pixels, NULL));
  int wrong = 0, empty = 0;
  for (int y = 32; y-- > 0; putchar('\n'))
    for (int x = 0; x < 64; ++x) {
      /* z = 0.5: the ball ends at r = 15, the skin at r = 13.5 */
      const double u = (x + 0.5) * 30 / 64 - 15, v = (y + 0.5) * 30 / 32 - 15,
                   r2 = u * u + v * v + 0.25;
      if (r2 > 15 * 15) wrong += pixels[y][x] != 0;
      if (r2 < 14.99 * 14.99 && r2 > 13.51 * 13.51) wrong += pixels[y][x] == 0;
      if (r2 < 13.5 * 13.5) empty += pixels[y][x] == 0;
      putchar(pixels[y][x] ? '#' : ' ');
    }
  printf("%d pixels within the skin are empty\n", empty);

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_structure_release(foam);
  msq_shape_release(ball);
  msq_context_release(context);
  return wrong != 0 || empty == 0;
}

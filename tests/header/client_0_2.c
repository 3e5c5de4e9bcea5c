/* SPDX-License-Identifier: Apache-2.0
 * A client of msq 0.2: compiled with the header of that version, run with the library of today.
 * Its definitions and reports have the sizes of 0.2, so of those that have grown since, it passes
 * short ones.
 *
 * usage: client_0_2 [--write] defaults_0_2.txt
 * --write writes the defaults of all definitions, when a version is frozen. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "msq_0_2.h"

static void fail(const char* what) {
  fprintf(stderr, "%s\n", what);
  exit(1);
}

static void check(msq_status status) {
  if (status != MSQ_OK) fail(msq_error_message());
}

/* ---- the defaults of definitions, as bytes
 * --------------------------------------------------------- */

typedef msq_status (*init_fn)(void* def, size_t size);

/* clang-format off */
#define DEFINITIONS(DO) \
  DO(context_def) DO(file_def) DO(mesh_def) DO(host_shape_def) DO(voxels_def) \
  DO(radial_field_def) DO(host_field_def) DO(grid_field_def) DO(expression_field_def) \
  DO(shape_distance_field_def) DO(unit_cell_def) DO(lattice_def) DO(foam_def) \
  DO(functional_def) DO(period_def) DO(beams_def) DO(struts_def) DO(host_structure_def) \
  DO(host_function_def) DO(material_def) DO(model_def) DO(query_def) DO(points_def) \
  DO(segments_def) DO(slicer_def) DO(output_def) DO(contours_def) DO(printability_def) \
  DO(fill_def) DO(surface_def) DO(rays_def) DO(camera) DO(render_def) DO(frame) \
  DO(document_def) DO(json_def)
/* clang-format on */

#define DEFINE_INIT(name)                                 \
  static msq_status init_##name(void* def, size_t size) { \
    return msq_##name##_init((msq_##name*)def, size);     \
  }
DEFINITIONS(DEFINE_INIT)

#define ROW(name) {"msq_" #name, init_##name, sizeof(msq_##name)},
static const struct {
  const char* name;
  init_fn init;
  size_t size;
} definitions[] = {DEFINITIONS(ROW)};

enum { room = 1024, pattern = 0xa5 };
typedef union struct_bytes {
  uint8_t bytes[room];
  double aligned[room / sizeof(double)];
} struct_bytes;

/* Nothing is written beyond the size that the caller gave. */
static void check_rest(const char* name, const uint8_t* bytes, size_t size) {
  for (size_t i = size; i < room; ++i) {
    if (bytes[i] == pattern) continue;
    fprintf(stderr, "%s: byte %zu was written, beyond its %zu bytes\n", name, i, size);
    exit(1);
  }
}

static void check_defaults(const char* path, int is_written) {
  FILE* const file = fopen(path, is_written ? "w" : "r");
  char line[2 * room + 128];
  if (file == NULL) fail(path);
  for (size_t i = 0; i < sizeof definitions / sizeof *definitions; ++i) {
    const size_t size = definitions[i].size;
    struct_bytes def;
    char text[2 * room + 128];
    int end;
    if (size >= room) fail(definitions[i].name);
    memset(&def, pattern, sizeof def);
    check(definitions[i].init(&def, size));
    check_rest(definitions[i].name, def.bytes, size);
    end = snprintf(text, sizeof text, "%s ", definitions[i].name);
    for (size_t at = 0; at < size; ++at) end += snprintf(text + end, 3, "%02x", def.bytes[at]);
    text[end++] = '\n', text[end] = '\0';
    if (is_written) {
      fputs(text, file);
    } else if (fgets(line, sizeof line, file) == NULL || strcmp(line, text) != 0) {
      fprintf(stderr, "other defaults than those of 0.2:\n%swere\n%s", text, line);
      exit(1);
    }
  }
  fclose(file);
}

/* ---- a program of its time
 * ------------------------------------------------------------------------- */

enum { pixels = 48, layers = 12 };
static const double low[3] = {0, 0, 0}, high[3] = {4, 4, 1};

static int32_t in_ball(void* user, const double* points, uint64_t count, uint8_t* inside) {
  ++*(int*)user;
  for (uint64_t i = 0; i < count; ++i) {
    const double x = points[3 * i] - 2, y = points[3 * i + 1] - 2, z = points[3 * i + 2] - 0.5;
    inside[i] = x * x + y * y + z * z < 3;
  }
  return 0;
}

static void ball_released(void* user) {
  *(int*)user = -1;
}

struct taken {
  uint64_t inside, bits, layers;
};

static int32_t take(void* user, const msq_layer* layer) {
  struct taken* const taken = (struct taken*)user;
  if (layer->struct_size < sizeof *layer || layer->output != MSQ_LAYER_BITS ||
      layer->width != pixels || layer->height != pixels || layer->index != taken->layers++)
    return 1;
  taken->inside += layer->inside_count;
  for (uint32_t y = 0; y < layer->height; ++y)
    for (uint32_t x = 0; x < layer->width; ++x)
      taken->bits += layer->data[y * layer->stride + x / 8] >> (x % 8) & 1;
  return 0;
}

static msq_model* model_of(msq_context* context, msq_shape* shape, msq_structure* structure) {
  msq_scale_def scales[2];
  msq_model_def def;
  msq_model* model;
  memset(scales, 0, sizeof scales);
  scales[0].shape = shape;
  scales[1].structure = structure;
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales, def.scale_count = 2, def.scale_size = sizeof scales[0];
  check(msq_model_create(context, &def, &model));
  return model;
}

/* Foams, lattices and gyroids in cells of 1/2, with the radius or level of a field. */
static msq_structure* structure_of(msq_context* context, int kind, msq_field* field) {
  msq_structure* structure;
  if (kind == 0) {
    msq_foam_def def;
    check(msq_foam_def_init(&def, sizeof def));
    def.radius.field = field;
    for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 0.5;
    check(msq_structure_foam(context, &def, &structure));
  } else if (kind == 1) {
    msq_lattice_def def;
    check(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell = MSQ_UNIT_CELL_OCTET;
    def.radius.field = field;
    for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 0.5;
    check(msq_structure_lattice(context, &def, &structure));
  } else {
    msq_functional_def def;
    check(msq_functional_def_init(&def, sizeof def));
    def.function = MSQ_FUNCTION_GYROID;
    def.kind = MSQ_FUNCTIONAL_NETWORK;
    def.level.field = field;
    for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 0.5;
    check(msq_structure_functional(context, &def, &structure));
  }
  return structure;
}

/* Layers as bits: samples inside, which agree with a set query at the centres of the samples. */
static uint64_t sliced(msq_model* model) {
  static uint8_t inside[pixels * pixels * layers];
  struct_bytes report;
  msq_slicer_report* const known = (msq_slicer_report*)&report;
  msq_slicer_def def;
  msq_points_def points;
  msq_slicer* slicer;
  struct taken taken = {0, 0, 0};
  uint64_t sum = 0;
  check(msq_slicer_def_init(&def, sizeof def));
  def.has_region = 1;
  memcpy(def.region_min, low, sizeof low), memcpy(def.region_max, high, sizeof high);
  def.resolution[0] = def.resolution[1] = pixels;
  def.layer_count = layers;
  def.layer_height = 1.0 / layers;
  check(msq_slicer_create(model, &def, &slicer));
  memset(&report, pattern, sizeof report);
  known->struct_size = sizeof *known;
  check(msq_slicer_info(slicer, known));
  check_rest("msq_slicer_report", report.bytes, sizeof *known);
  if (known->width != pixels || known->layer_count != layers)
    fail("msq_slicer_report: other layers");
  check(msq_slicer_run(slicer, 0, UINT64_MAX, take, &taken, NULL));
  msq_slicer_release(slicer);
  if (taken.layers != layers || taken.bits != taken.inside)
    fail("inside_count is not that of the bits");

  check(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    points.counts[axis] = axis < 2 ? pixels : layers;
    points.spacing[axis] = (high[axis] - low[axis]) / (double)points.counts[axis];
    points.origin[axis] = low[axis] + points.spacing[axis] / 2;
  }
  check(msq_set_membership(model, &points, NULL, inside, sizeof inside, NULL));
  for (size_t i = 0; i < sizeof inside; ++i) sum += inside[i];
  if (sum != taken.inside) fail("layers and the set query differ");
  return taken.inside;
}

static void cast(msq_model* model) {
  const double origins[6] = {2, 2, 5, 2.2, 1.9, 5}, directions[6] = {0, 0, -1, 0, 0, -2};
  msq_ray_hit hits[2];
  msq_rays_def def;
  check(msq_rays_def_init(&def, sizeof def));
  def.count = 2, def.origins = origins, def.directions = directions;
  check(msq_ray_cast(model, &def, NULL, hits, 2, NULL));
  for (int i = 0; i < 2; ++i) {
    const double* const n = hits[i].normal;
    if (hits[i].starts_inside ||
        (isfinite(hits[i].t) && fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) > 1e-6))
      fail("msq_ray_hit");
  }
}

int main(int count, char** arguments) {
  /* Samples inside, as 0.2 counted them: a foam, a lattice, a gyroid, in a box and in a ball. */
  static const uint64_t expected[2][3] = {{4629, 10320, 14336}, {3098, 6384, 8212}};
  const int is_written = count == 3 && strcmp(arguments[1], "--write") == 0;
  struct_bytes report;
  int calls = 0;
  msq_context_def context_def;
  msq_context* context;
  msq_shape* shapes[2];
  msq_host_shape_def ball;
  msq_field* field;
  msq_radial_field_def radial;
  if (count != 2 + is_written) fail("usage: client_0_2 [--write] defaults_0_2.txt");
  if (msq_version() < MSQ_VERSION) fail("the library is older than 0.2");
  check_defaults(arguments[1 + is_written], is_written);

  check(msq_context_def_init(&context_def, sizeof context_def));
  context_def.threads = 2;
  check(msq_context_create(&context_def, &context));
  check(msq_shape_from_box(context, low, high, &shapes[0]));
  check(msq_host_shape_def_init(&ball, sizeof ball));
  ball.inside = in_ball, ball.user = &calls, ball.release = ball_released;
  memcpy(ball.min, low, sizeof low), memcpy(ball.max, high, sizeof high);
  check(msq_shape_from_host(context, &ball, &shapes[1]));
  check(msq_radial_field_def_init(&radial, sizeof radial));
  for (int axis = 0; axis < 3; ++axis) radial.center[axis] = 2;
  radial.from_value = 0.1, radial.to_radius = 3, radial.to_value = 0.04;
  check(msq_field_radial(context, &radial, &field));

  for (int shape = 0; shape < 2; ++shape)
    for (int kind = 0; kind < 3; ++kind) {
      msq_structure* const structure = structure_of(context, kind, field);
      msq_model* const model = model_of(context, shapes[shape], structure);
      const uint64_t inside = sliced(model);
      if (inside != expected[shape][kind]) {
        fprintf(stderr, "shape %d, structure %d: %llu samples inside, %llu with 0.2\n", shape, kind,
                (unsigned long long)inside, (unsigned long long)expected[shape][kind]);
        return 1;
      }
      cast(model);
      msq_model_release(model);
      msq_structure_release(structure);
    }

  memset(&report, pattern, sizeof report);
  ((msq_cache_report*)&report)->struct_size = sizeof(msq_cache_report);
  check(msq_cache_stats(context, (msq_cache_report*)&report));
  check_rest("msq_cache_report", report.bytes, sizeof(msq_cache_report));
  if (msq_context_create(NULL, NULL) != MSQ_E_ARGUMENT ||
      strstr(msq_error_message(), "NULL") == NULL)
    fail("no refusal of NULL");

  msq_field_release(field);
  msq_shape_release(shapes[1]);
  if (calls != -1) fail("the host's shape was not released");
  msq_shape_release(shapes[0]);
  msq_context_release(context);
  return 0;
}

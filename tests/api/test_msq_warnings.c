/* SPDX-License-Identifier: Apache-2.0
 * Warnings of a context (msq_context_def.warning). */
#include <pthread.h>

#include "definitions.h"
#include "soups.h"

enum { max_warnings = 16 };

typedef struct warning_list {
  int32_t codes[max_warnings];
  char messages[max_warnings][512];
  int count;
  pthread_t thread;
  int is_on_other_thread;
  msq_context* context; /* asked about itself and released, if given */
} warning_list;

static warning_list list;

static void take_warning(void* user, int32_t code, const char* message) {
  warning_list* to = (warning_list*)user;
  if (!pthread_equal(pthread_self(), to->thread)) to->is_on_other_thread = 1;
  if (to->count < max_warnings) {
    to->codes[to->count] = code;
    snprintf(to->messages[to->count], sizeof to->messages[0], "%s", message);
    ++to->count;
  }
  if (to->context) { /* no lock is held, and msq keeps what it uses */
    msq_context* context = to->context;
    to->context = NULL;
    memory_of(context);
    cache_of(context);
    assert_ok(msq_cache_clear(context));
    msq_context_release(context);
  }
}

static msq_context* make_warned(uint32_t threads, uint64_t cache_bytes) {
  msq_context_def def;
  msq_context* context;
  memset(&list, 0, sizeof list);
  list.thread = pthread_self();
  assert_ok(msq_context_def_init(&def, sizeof def));
  assert_null(def.warning);
  assert_null(def.warning_user);
  def.threads = threads;
  def.cache_bytes = cache_bytes;
  def.warning = take_warning;
  def.warning_user = &list;
  assert_ok(msq_context_create(&def, &context));
  return context;
}

static void assert_warned(int32_t code, const char* words) {
  assert_int_equal(list.count, 1);
  assert_int_equal(list.codes[0], code);
  if (!strstr(list.messages[0], words)) fail_msg("\"%s\" lacks \"%s\"", list.messages[0], words);
  assert_false(list.is_on_other_thread);
  list.count = 0;
}

static void open_meshes(void** state) {
  msq_context* context = make_warned(2, 1 << 20);
  soup mesh = unit_cube();
  msq_mesh_def def;
  msq_shape* shape;
  (void)state;
  msq_shape_release(make_soup(context, &mesh));
  assert_int_equal(list.count, 0);
  mesh.triangle_count -= 1;
  shape = make_soup(context, &mesh);
  assert_warned(MSQ_WARNING_OPEN_MESH, "11 triangles is not closed (3 open edges)");
  msq_shape_release(shape);
  def = mesh_def((const double(*)[3])mesh.vertices, mesh.vertex_count,
                 (const uint32_t(*)[3])mesh.triangles, mesh.triangle_count);
  def.winding_rule = MSQ_WINDING_NONZERO; /* which reads it as it is */
  msq_shape_release(make_mesh(context, &def));
  assert_int_equal(list.count, 0);
  def.triangle_count = 0;
  assert_status(msq_shape_from_mesh(context, &def, &shape), MSQ_E_MESH);
  assert_int_equal(list.count, 0);
  msq_context_release(context);
}

static void open_meshes_of_files(void** state) {
  const char text[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  msq_context* context = make_warned(2, 1 << 20);
  msq_file_def def;
  msq_shape* shape;
  (void)state;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = MSQ_FORMAT_OFF;
  assert_ok(msq_shape_from_memory(context, text, sizeof text - 1, &def, &shape, NULL));
  assert_warned(MSQ_WARNING_OPEN_MESH, "1 triangles is not closed (3 open edges)");
  msq_shape_release(shape);
  msq_context_release(context);
}

/* The callback uses the context and drops its last reference. */
static void callbacks_may_call_msq(void** state) {
  msq_context* context = make_warned(2, 1 << 20);
  soup mesh = unit_cube();
  msq_shape* shape;
  (void)state;
  mesh.triangle_count -= 2;
  list.context = context;
  shape = make_soup(context, &mesh);
  assert_int_equal(list.count, 1);
  assert_null(list.context);
  msq_shape_release(shape);
}

static void coarse_pitches(void** state) {
  const double pitches[] = {0.2, 0.3};
  msq_context* context = make_warned(2, 1 << 20);
  msq_model* model = make_lattice_model(context);
  (void)state;
  assert_int_equal(list.count, 0);
  for (int i = 0; i < 2; ++i)
    for (int in_z = 0; in_z < 2; ++in_z) {
      msq_slicer_def def;
      msq_slicer* slicer;
      assert_ok(msq_slicer_def_init(&def, sizeof def));
      def.pitch[0] = def.pitch[1] = in_z ? 0.1 : pitches[i];
      def.layer_height = in_z ? pitches[i] : 0.1;
      slicer = make_slicer(model, &def);
      if (i == 0)
        assert_int_equal(list.count, 0);
      else
        assert_warned(MSQ_WARNING_COARSE_PITCH,
                      in_z ? "scale 1 have a size of 1: 3.33 layers of 0.3"
                           : "scale 1 have a size of 1: 3.33 pixels along x of 0.3");
      def.length_scale = 2; /* the lattice is not resolved */
      msq_slicer_release(slicer);
      slicer = make_slicer(model, &def);
      assert_int_equal(list.count, 0);
      msq_slicer_release(slicer);
    }
  msq_model_release(model);
  msq_context_release(context);
}

static void small_caches(void** state) {
  const uint64_t sizes[] = {1000, 0, 1 << 28};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    msq_context* context = make_warned(2, sizes[i]);
    msq_model* model = make_foam_model(context, MSQ_FOAM_AUTO);
    const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 64, 64, 0.1);
    msq_slicer* slicer = make_slicer(model, &def);
    uint8_t layer[64 * 8];
    assert_int_equal(list.count, 0);
    assert_ok(msq_slice_layer(slicer, 3, layer, sizeof layer, NULL));
    if (i == 0) assert_warned(MSQ_WARNING_SMALL_CACHE, "the cache of 1000 bytes had no room");
    assert_ok(msq_slice_layer(slicer, 4, layer, sizeof layer, NULL));
    assert_int_equal(list.count, 0); /* never twice */
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void unmatched_cells(void** state) {
  const double nodes[2][3] = {{0, 0.5, 0.5}, {1, 0.5, 0.25}};
  const uint32_t struts[2] = {0, 1};
  msq_context* context = make_warned(2, 1 << 20);
  msq_unit_cell_def library[2];
  msq_lattice_def def;
  msq_structure* lattice;
  (void)state;
  for (int32_t cell = MSQ_UNIT_CELL_CUBIC; cell <= MSQ_UNIT_CELL_REENTRANT; ++cell)
    msq_structure_release(make_lattice_of(context, cell, 1, 0.1));
  assert_int_equal(list.count, 0);

  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.radius.value = 0.1;
  def.nodes = nodes[0];
  def.node_count = 2;
  def.struts = struts;
  def.strut_count = 1;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  assert_warned(MSQ_WARNING_UNMATCHED_CELLS,
                "2 nodes on the face between unit cell 0 and, along "
                "axis 0, unit cell 0");
  msq_structure_release(lattice);

  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  library[0] = named_cell(MSQ_UNIT_CELL_CUBIC);
  library[1] = named_cell(MSQ_UNIT_CELL_BCC); /* both have nodes in the corners */
  def.cells = library;
  def.cell_count = 2;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  assert_int_equal(list.count, 0);
  msq_structure_release(lattice);
  library[1] = named_cell(MSQ_UNIT_CELL_OCTET); /* and in the middles of faces */
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  assert_warned(MSQ_WARNING_UNMATCHED_CELLS, "unit cell 1");
  msq_structure_release(lattice);
  msq_context_release(context);
}

static int released;

static void count_release(void* user) {
  assert_ptr_equal(user, &list);
  ++released;
}

static void hooks_live_as_long_as_the_context(void** state) {
  msq_context_def def;
  msq_context* context;
  msq_structure* lattice;
  msq_model* model;
  (void)state;
  memset(&list, 0, sizeof list);
  list.thread = pthread_self();
  released = 0;
  assert_ok(msq_context_def_init(&def, sizeof def));
  assert_true(def.warning_release == NULL);
  def.warning = take_warning;
  def.warning_user = &list;
  def.warning_release = count_release;
  def.cache_policy = 7;
  assert_int_equal(msq_context_create(&def, &context), MSQ_E_ARGUMENT);
  assert_int_equal(released, 0); /* the host still owns it */
  def.cache_policy = MSQ_CACHE_FIFO;
  assert_ok(msq_context_create(&def, &context));
  lattice = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.1);
  model = make_model(context, make_box(context), lattice, NULL);
  msq_context_release(context);
  assert_int_equal(released, 0);
  msq_model_release(model);
  assert_int_equal(released, 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(open_meshes),
      cmocka_unit_test(open_meshes_of_files),
      cmocka_unit_test(callbacks_may_call_msq),
      cmocka_unit_test(coarse_pitches),
      cmocka_unit_test(small_caches),
      cmocka_unit_test(unmatched_cells),
      cmocka_unit_test(hooks_live_as_long_as_the_context),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

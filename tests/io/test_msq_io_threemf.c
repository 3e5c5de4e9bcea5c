/* SPDX-License-Identifier: Apache-2.0
 * msq_io_beams_save and msq_io_slices_create. What they write is read by msq and, if it is there,
 * by lib3mf; and msq reads what lib3mf writes. */
#define _DEFAULT_SOURCE
#include "io_test.h"

#include "beams.h"
#include "lib3mf_files.h"
#include "struts.h"

#ifdef __SANITIZE_ADDRESS__
/* What libzip leaks in lib3mf is not msq's. */
const char* __lsan_default_suppressions(void);
const char* __lsan_default_suppressions(void) {
  return "leak:libzip.so";
}
#endif

static msq_beam_file* open_beams(msq_context* context, const char* path) {
  msq_beam_file* file;
  if (msq_beam_file_open(context, path, NULL, &file, NULL) != MSQ_OK)
    fail_msg("%s cannot be opened", path);
  return file;
}

static msq_beams_def beams_of(const msq_beam_file* file) {
  msq_beams_def def;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  assert_ok(msq_beam_file_beams(file, 0, &def));
  return def;
}

static msq_strut_graph* graph_of(msq_context* context, const msq_structure* structure, double low,
                                 double high, const msq_shape* part) {
  msq_struts_def def = struts_def(low, high);
  msq_strut_graph* graph;
  def.selection = MSQ_STRUTS_NEAR;
  def.shape = part;
  assert_ok(msq_structure_strut_graph(context, structure, &def, &graph, NULL));
  return graph;
}

static msq_strut_graph_report report_of(const msq_strut_graph* graph) {
  msq_strut_graph_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_strut_graph_info(graph, &report));
  return report;
}

/* Points of a cube, of which `count` are in the one or the other. */
static void assert_same_members(msq_context* context, const msq_beams_def* one,
                                const msq_beams_def* other, double low, double high, size_t count) {
  double* points = (double*)malloc(count * 3 * sizeof(double));
  uint8_t* inside[2];
  uint64_t seed = 88172645463325252u, members = 0;
  const msq_beams_def* defs[2] = {one, other};
  for (size_t i = 0; i < 3 * count; ++i) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    points[i] = low + (high - low) * (double)(seed >> 11) * 0x1p-53;
  }
  for (int k = 0; k < 2; ++k) {
    msq_model* model = model_of(context, defs[k]);
    msq_points_def cloud;
    assert_ok(msq_points_def_init(&cloud, sizeof cloud));
    cloud.kind = MSQ_POINTS_ARRAY;
    cloud.coordinates = points;
    cloud.count = count;
    inside[k] = (uint8_t*)malloc(count);
    assert_ok(msq_set_membership(model, &cloud, NULL, inside[k], count, NULL));
    msq_model_release(model);
  }
  for (size_t i = 0; i < count; ++i) members += inside[0][i];
  assert_true(members > count / 100 && members < count);
  assert_memory_equal(inside[0], inside[1], count);
  free(inside[0]);
  free(inside[1]);
  free(points);
}

#if MSQ_HAS_LIB3MF
static void release_lattice(lib3mf_lattice* lattice) {
  free(lattice->nodes);
  free(lattice->radii);
  free(lattice->beams);
  free(lattice->caps);
}

/* lib3mf has the nodes as float32, and the radii as they are. */
static void assert_lib3mf_reads(msq_context* context, const char* path,
                                const msq_strut_graph_report* graph, double low, double high) {
  lib3mf_lattice read;
  double* rounded = (double*)malloc(graph->node_count * 3 * sizeof(double));
  msq_beams_def ours, theirs;
  const int line = lib3mf_read_lattice(path, &read);
  if (line) fail_msg("lib3mf refuses %s in line %d", path, line);
  assert_int_equal(read.warnings, 0);
  assert_int_equal(read.node_count, graph->node_count);
  assert_int_equal(read.beam_count, graph->strut_count);
  for (uint64_t i = 0; i < 3 * graph->node_count; ++i) {
    rounded[i] = (double)(float)graph->nodes[i];
    if (rounded[i] != read.nodes[i])
      fail_msg("coordinate %d is %.17g, not %.17g", (int)i, read.nodes[i], rounded[i]);
  }
  assert_memory_equal(read.beams, graph->struts, graph->strut_count * 8);
  assert_memory_equal(read.radii, graph->radii, graph->strut_count * 16);
  assert_memory_equal(read.caps, graph->caps, graph->strut_count * 2);
  assert_ok(msq_beams_def_init(&ours, sizeof ours));
  ours.nodes = rounded;
  ours.node_count = graph->node_count;
  ours.beams = graph->struts;
  ours.beam_count = graph->strut_count;
  ours.radii = graph->radii;
  ours.caps = graph->caps;
  theirs = ours;
  theirs.nodes = read.nodes;
  theirs.beams = read.beams;
  theirs.radii = read.radii;
  theirs.caps = read.caps;
  assert_same_members(context, &ours, &theirs, low, high, test_count(100000));
  free(rounded);
  release_lattice(&read);
}

static void msq_reads_what_lib3mf_writes(void** state) {
  msq_context* context = make_context();
  lib3mf_lattice sent, read;
  msq_beam_file* file;
  msq_beams_def def;
  msq_beam_file_report report;
  double positions[node_count * 3];
  (void)state;
  memset(&sent, 0, sizeof sent);
  for (int i = 0; i < node_count * 3; ++i) positions[i] = nodes[i / 3][i % 3];
  sent.node_count = node_count;
  sent.nodes = positions;
  sent.beam_count = beam_count - 1; /* without the one of no length */
  sent.beams = (uint32_t*)beams;
  sent.radii = (double*)radii;
  sent.caps = (uint8_t*)caps;
  const char* path = in_folder("theirs.3mf");
  sent.clipping = MSQ_CLIPPING_OUTSIDE;
  assert_int_equal(lib3mf_write_lattice(path, &sent), 0);
  assert_int_equal(lib3mf_read_lattice(path, &read), 0);
  file = open_beams(context, path);
  def = beams_of(file);
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_beam_file_info(file, 0, &report));
  assert_int_equal(report.clipping, MSQ_CLIPPING_OUTSIDE);
  assert_int_equal(report.clipping_triangle_count, 4);
  assert_int_equal(def.beam_count, beam_count - 1);
  for (uint64_t i = 0; i < 2 * def.beam_count; ++i) {
    const double* p = (const double*)def.nodes + 3 * def.beams[i];
    for (int axis = 0; axis < 3; ++axis)
      assert_true(p[axis] == read.nodes[3 * read.beams[i] + (uint32_t)axis]);
    assert_true(((const double*)def.radii)[i] == ((const double*)radii)[i]);
    assert_int_equal(def.caps[i], ((const uint8_t*)caps)[i]);
  }
  release_lattice(&read);
  msq_beam_file_release(file);
  remove(path);
  msq_context_release(context);
}
#endif

static void struts_are_read_back_bit_for_bit(void** state) {
  msq_context* context = make_context();
  const double center[3] = {1.5, 1.5, 1.5};
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 1.4, &ball));
  for (int kind = 0; kind < 4; ++kind) {
    const msq_beams_def truss = frame_def();
    msq_structure* structure;
    if (kind < 2)
      structure = make_foam_with(context, 0.1, 0);
    else if (kind == 2)
      structure = make_lattice(context);
    else
      assert_ok(msq_structure_beams(context, &truss, &structure, NULL));
    msq_strut_graph* graph =
        graph_of(context, structure, kind == 3 ? -3 : 0, 3, kind == 1 ? ball : NULL);
    const msq_strut_graph_report known = report_of(graph);
    const char* path = in_folder("struts.3mf");
    assert_ok(msq_io_beams_save(graph, NULL, path, 0));
    msq_beam_file* file = open_beams(context, path);
    const msq_beams_def def = beams_of(file);
    if (kind < 3) {
      assert_int_equal(def.node_count, known.node_count);
      assert_int_equal(def.beam_count, known.strut_count);
      assert_int_equal(def.ball_count, 0);
      assert_memory_equal(def.nodes, known.nodes, known.node_count * 24);
      assert_memory_equal(def.beams, known.struts, known.strut_count * 8);
      assert_memory_equal(def.radii, known.radii, known.strut_count * 16);
      assert_memory_equal(def.caps, known.caps, known.strut_count * 2);
#if MSQ_HAS_LIB3MF
      assert_lib3mf_reads(context, path, &known, 0, 3);
#endif
    } else {
      /* Beams of all forms, and balls. */
      assert_true(def.ball_count >= 3);
      assert_same_members(context, &truss, &def, -3, 3, test_count(100000));
    }
    msq_beam_file_release(file);
    /* An existing file stays unless it is to be replaced; the bytes are the same at any time. */
    assert_refused(msq_io_beams_save(graph, NULL, path, 0), MSQ_E_IO, "struts.3mf");
    assert_ok(msq_io_beams_save(graph, NULL, in_folder("again.3mf"), 0));
    assert_same_files(path, in_folder("again.3mf"));
    assert_ok(msq_io_beams_save(graph, NULL, path, 1));
    assert_int_equal(count_files(folder), 2);
    remove(path);
    remove(in_folder("again.3mf"));
    msq_strut_graph_release(graph);
    msq_structure_release(structure);
  }
  msq_shape_release(ball);
  msq_context_release(context);
}

static void meshes_clip_or_are_united(void** state) {
  static const float vertices[4][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  static const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice(context);
  msq_strut_graph* graph = graph_of(context, lattice, 0, 3, NULL);
  const char* path = in_folder("clipped.3mf");
  msq_mesh_def mesh;
  msq_io_beams_def def;
  (void)state;
  assert_ok(msq_mesh_def_init(&mesh, sizeof mesh));
  mesh.coordinate_type = MSQ_FLOAT32;
  mesh.vertices = vertices;
  mesh.vertex_count = 4;
  mesh.triangles = triangles[0];
  mesh.triangle_count = 4;
  assert_ok(msq_io_beams_def_init(&def, sizeof def));
  def.mesh = &mesh;
  for (int32_t clipping = MSQ_CLIPPING_NONE; clipping <= MSQ_CLIPPING_OUTSIDE; ++clipping) {
    msq_beam_file_report report;
    msq_shape* shape;
    msq_shape_report info;
    const int is_solid = clipping == MSQ_CLIPPING_NONE;
    memset(&report, 0, sizeof report);
    memset(&info, 0, sizeof info);
    report.struct_size = sizeof report;
    info.struct_size = sizeof info;
    def.clipping = clipping;
    assert_ok(msq_io_beams_save(graph, &def, path, 0));
    msq_beam_file* file = open_beams(context, path);
    assert_ok(msq_beam_file_info(file, 0, &report));
    assert_int_equal(report.clipping, clipping);
    assert_int_equal(report.mesh_triangle_count, is_solid ? 4 : 0);
    assert_int_equal(report.clipping_triangle_count, is_solid ? 0 : 4);
    assert_ok(msq_beam_file_shape(context, file, 0,
                                  is_solid ? MSQ_BEAM_FILE_SOLID : MSQ_BEAM_FILE_CLIPPING,
                                  MSQ_WINDING_AUTO, &shape));
    assert_ok(msq_shape_info(shape, &info));
    assert_true(info.volume == 4.5 && info.closed);
#if MSQ_HAS_LIB3MF
    {
      lib3mf_lattice read;
      assert_int_equal(lib3mf_read_lattice(path, &read), 0);
      /* lib3mf 1.8.1 knows clippingmode by the name that it had in drafts, and warns. */
      assert_int_equal(read.warnings, is_solid ? 0 : 1);
      assert_int_equal(read.clipping_triangles, is_solid ? 0 : 4);
      release_lattice(&read);
    }
#endif
    msq_shape_release(shape);
    msq_beam_file_release(file);
    remove(path);
  }
  msq_strut_graph_release(graph);
  msq_structure_release(lattice);
  msq_context_release(context);
}

typedef struct sums {
  uint64_t layers, rings, points;
  double area;
} sums;

static int32_t add_rings(void* user, const msq_layer* layer) {
  sums* all = (sums*)user;
  msq_contours_report rings;
  memset(&rings, 0, sizeof rings);
  rings.struct_size = sizeof rings;
  if (msq_contours_info(layer->outputs[0]->contours, &rings) != MSQ_OK) return -1;
  const double* p = (const double*)rings.points;
  ++all->layers;
  all->rings += rings.ring_count;
  all->points += rings.point_count;
  for (uint64_t ring = 0; ring < rings.ring_count; ++ring)
    for (uint64_t i = rings.starts[ring]; i < rings.starts[ring + 1]; ++i) {
      const uint64_t next = i + 1 < rings.starts[ring + 1] ? i + 1 : rings.starts[ring];
      all->area += 0.5 * (p[2 * i] * p[2 * next + 1] - p[2 * i + 1] * p[2 * next]);
    }
  return 0;
}

static void slices_are_read_by_lib3mf(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const char* path = in_folder("slices.3mf");
  msq_output_def output;
  msq_contours_def contours;
  msq_slicer_def plan;
  msq_slicer* slicer;
  msq_io_writer* writer;
  msq_io_writer_def threads;
  sums ours;
  (void)state;
  memset(&ours, 0, sizeof ours);
  assert_ok(msq_contours_def_init(&contours, sizeof contours));
  contours.tolerance = 0.01;
  assert_ok(msq_output_def_init(&output, sizeof output));
  output.output = MSQ_LAYER_CONTOURS;
  output.contours = &contours;
  assert_ok(msq_slicer_def_init(&plan, sizeof plan));
  plan.outputs = &output;
  plan.output_count = 1;
  plan.resolution[0] = plan.resolution[1] = 40;
  plan.layer_height = 0.25;
  plan.layer_count = 12;
  assert_ok(msq_slicer_create(model, &plan, &slicer));
  assert_ok(msq_io_slices_create(slicer, path, NULL, NULL, &writer));
  write_all(slicer, writer);
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, add_rings, &ours, NULL));
  assert_true(ours.points > 1000 && ours.area > 0.1);
#if MSQ_HAS_LIB3MF
  {
    lib3mf_stack read;
    const int line = lib3mf_read_stack(path, &read);
    if (line) fail_msg("lib3mf refuses the slices in line %d", line);
    assert_int_equal(read.warnings, 0);
    assert_int_equal(read.slice_count, ours.layers);
    assert_int_equal(read.polygon_count, ours.rings);
    assert_int_equal(read.vertex_count, ours.points);
    assert_true(fabs(read.area - ours.area) < 1e-5 * ours.area);
    assert_true(fabs(read.top - 3) < 1e-6);
  }
#endif
  /* The same bytes by one thread. */
  assert_ok(msq_io_writer_def_init(&threads, sizeof threads));
  threads.threads = 1;
  assert_ok(msq_io_slices_create(slicer, in_folder("again.3mf"), &threads, NULL, &writer));
  write_all(slicer, writer);
  assert_same_files(path, in_folder("again.3mf"));
  remove(path);
  remove(in_folder("again.3mf"));
  /* A writer that is not finished leaves nothing. */
  assert_ok(msq_io_slices_create(slicer, path, NULL, NULL, &writer));
  assert_ok(msq_slicer_run(slicer, 0, 3, msq_io_writer_layer, writer, NULL));
  msq_io_writer_release(writer);
  assert_int_equal(count_files(folder), 0);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(struts_are_read_back_bit_for_bit),
    cmocka_unit_test(meshes_clip_or_are_united),
    cmocka_unit_test(slices_are_read_by_lib3mf),
#if MSQ_HAS_LIB3MF
    cmocka_unit_test(msq_reads_what_lib3mf_writes),
#endif
  };
#if !MSQ_HAS_LIB3MF
  print_message("lib3mf is not there: files are read by msq alone\n");
#endif
  return cmocka_run_group_tests_name("msq_io_threemf", tests, make_folder, end_folder);
}

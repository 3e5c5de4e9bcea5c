/* SPDX-License-Identifier: Apache-2.0
 * What functions of shapes refuse. */
#include "hosts.h" /* before headers of the system */

#include <unistd.h>

#include "images.h"
#include "stl.h"
#include "wrong_values.h"

static msq_context* context;

static void primitives(void** state) {
  (void)state;
  REFUSALS("msq_shape_from_box") {
    msq_context* in = context;
    double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    const double *min = low, *max = high;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "min is NULL", min = NULL);
    WRONG(ARGUMENT, "max is NULL", max = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    wrong_vector(table, low, "min");
    wrong_vector(table, high, "max");
    WRONG(ARGUMENT, "too large", low[0] = -1.5e308; high[0] = 1.5e308);
    for (int axis = 0; axis < 3; ++axis) {
      WRONG(ARGUMENT, words_of("min[%d]|is 1 ", axis), low[axis] = 1);
      WRONG(ARGUMENT, words_of("min[%d]|2.75", axis), low[axis] = 2.75);
      RIGHT(low[axis] = -1e75; high[axis] = 0);
      RIGHT(low[axis] = 1e75; high[axis] = 2e75);
      WRONG(ARGUMENT, "the limit is 1e+75|1.0002e+75", low[axis] = -0.5e75; high[axis] = 0.5002e75);
      WRONG(ARGUMENT, "-1.0001e+75", low[axis] = -1.0001e75; high[axis] = -1e75);
    }
    if (TRY(msq_shape_from_box(in, min, max, shape))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_from_sphere") {
    const double radii[] = {0, -1, NAN, INFINITY, -INFINITY, 1e200};
    const char* texts[] = {"is 0;", "is -1;", "nan", "inf", "-inf", "1e+200"};
    msq_context* in = context;
    double at[3] = {1, 2, 3}, radius = 1;
    const double* center = at;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "center is NULL", center = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    for (int i = 0; i < 6; ++i) WRONG(ARGUMENT, words_of("radius|%s", texts[i]), radius = radii[i]);
    for (int axis = 0; axis < 3; ++axis)
      for (int which = 0; which < 3; ++which)
        WRONG(ARGUMENT, "center|finite", at[axis] = not_finite(which));
    RIGHT(at[1] = -1e75; at[2] = 1e75; radius = 1e75);
    WRONG(ARGUMENT, "the limit is 1e+75", radius = 1.0001e75);
    WRONG(ARGUMENT, "the limit is 1e+75", at[2] = -1.0001e75);
    if (TRY(msq_shape_from_sphere(in, center, radius, shape))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_from_cylinder") {
    const double radii[] = {0, -2, NAN, INFINITY, 1e200};
    const char* texts[] = {"is 0;", "is -2;", "nan", "inf", "1e+200"};
    msq_context* in = context;
    double a[3] = {1, 2, 3}, b[3] = {4, 5, 6}, radius = 1;
    const double *from = a, *to = b;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "from is NULL", from = NULL);
    WRONG(ARGUMENT, "to is NULL", to = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    for (int i = 0; i < 5; ++i) WRONG(ARGUMENT, words_of("radius|%s", texts[i]), radius = radii[i]);
    WRONG(ARGUMENT, "(1, 2, 3)|differ", to = a);
    wrong_vector(table, a, "from is (");
    wrong_vector(table, b, "to is (");
    RIGHT(a[1] = -0.6e75; b[1] = 0.4e75; radius = 1e75);
    RIGHT(a[0] = 1e75; b[1] = 0.4e75);
    WRONG(ARGUMENT, "1.2e+75", a[1] = -0.6e75; b[1] = 0.6e75);
    WRONG(ARGUMENT, "the limit is 1e+75", radius = 1.0001e75);
    WRONG(ARGUMENT, "the limit is 1e+75", a[2] = 1.0001e75; b[0] = 1e75);
    if (TRY(msq_shape_from_cylinder(in, from, to, radius, shape))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_all_space") {
    msq_context* in = context;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    if (TRY(msq_shape_all_space(in, shape))) msq_shape_release(*shape);
  }
}

static void meshes(void** state) {
  (void)state;
  REFUSALS("msq_shape_from_mesh") {
    static const uint32_t flat[2][3] = {{0, 0, 1}, {2, 3, 3}};
    msq_context* in = context;
    double corners[8][3];
    uint32_t triangles[12][3];
    msq_mesh_def* def = (msq_mesh_def*)definition(0);
    msq_shape** shape = (msq_shape**)output(0);
    cube_corners(0, 4, corners);
    memcpy(triangles, cube_triangles(), sizeof triangles);
    *def = mesh_def((const double(*)[3])corners, 8, (const uint32_t(*)[3])triangles, 12);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "vertices is NULL", def->vertices = NULL);
    WRONG(ARGUMENT, "triangles is NULL", def->triangles = NULL);
    wrong_enum(table, &def->winding_rule, "winding_rule", 0, 3);
    WRONG(ARGUMENT, "coordinate_type|from 1 to 2", def->coordinate_type = 0);
    WRONG(ARGUMENT, "coordinate_type|from 1 to 2", def->coordinate_type = 3);
    WRONG(ARGUMENT, "coordinate_type|from 1 to 2", def->coordinate_type = -1);
    WRONG(ARGUMENT, "reserved is 17", def->reserved = 17);
    WRONG(ARGUMENT, "23|24", def->vertex_stride = 23);
    WRONG(ARGUMENT, "11|12", def->coordinate_type = MSQ_FLOAT32; def->vertex_stride = 11);
    WRONG(LIMIT, "vertices|9223372036854775807", def->vertex_count = UINT64_MAX / 2);
    WRONG(LIMIT, "vertices", def->vertex_stride = UINT64_MAX / 4);
    WRONG(LIMIT, "4294967296|4294967295", def->triangle_count = (uint64_t)UINT32_MAX + 1);
    WRONG(LIMIT, "4294967296", def->vertex_count = (uint64_t)UINT32_MAX + 1);
    WRONG(MESH, "no triangles", def->triangle_count = 0);
    WRONG(MESH, "all 2 triangles", def->triangles = flat[0]; def->triangle_count = 2);
    WRONG(MESH, "triangle 7|8 vertices", triangles[7][2] = 8);
    WRONG(MESH, "triangle 7|4294967295|8 vertices", triangles[7][2] = UINT32_MAX);
    WRONG(MESH, "0 vertices", def->vertex_count = 0; def->vertices = NULL);
    for (int axis = 0; axis < 3; ++axis)
      for (int which = 0; which < 3; ++which)
        WRONG(MESH, words_of("vertex 5|%s", which ? "inf" : "nan"),
              corners[5][axis] = not_finite(which));
    RIGHT(corners[5][1] = -1e100; corners[7][2] = 1e100);
    WRONG(MESH, "vertex 5|at most 1e100", corners[5][1] = -1.0001e100);
    WRONG(LIMIT, "300|memory_limit|336", in = small_context());
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_shape_from_mesh(in, def, shape))) msq_shape_release(*shape);
    assert_int_equal(memory_of(context).bytes, 0);
    assert_int_equal(memory_of(small_context()).bytes, 0);
  }
  msq_shape* mesh = make_cube_mesh(context);
  REFUSALS("msq_shape_info") {
    const msq_shape* shape = mesh;
    msq_shape_report* report = (msq_shape_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_shape_info(shape, report));
  }
#if MSQ_WITH_CGAL
  REFUSALS("msq_shape_self_intersections") {
    const msq_shape* shape = mesh;
    uint64_t* pairs = (uint64_t*)output(0);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "pairs is NULL", pairs = NULL);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    TRY(msq_shape_self_intersections(shape, pairs, job));
  }
#endif
  msq_shape_release(mesh);
}

#if MSQ_WITH_ASSIMP
static void wrong_file(refusals* table, msq_file_def* def) {
  const double units[] = {0, -1, NAN, INFINITY};
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  wrong_enum(table, &def->format, "format", 0, 7);
  wrong_enum(table, &def->winding_rule, "winding_rule", 0, 3);
  for (int i = 0; i < 4; ++i) WRONG(ARGUMENT, "unit_mm is ", def->unit_mm = units[i]);
  WRONG(ARGUMENT, "reserved is 9", def->reserved = 9);
}

static void files(void** state) {
  const char* path_of_none = "/no such folder/part.stl";
  (void)state;
  REFUSALS("msq_shape_from_memory") {
    static uint8_t file[stl_bytes];
    msq_context* in = context;
    const void* data = file;
    uint64_t bytes = stl_bytes;
    msq_file_def* def = (msq_file_def*)definition(0);
    msq_shape** shape = (msq_shape**)output(0);
    msq_job* job = NULL;
    make_stl(file);
    assert_ok(msq_file_def_init(def, sizeof *def));
    def->format = MSQ_FORMAT_STL;
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "data is NULL", data = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "format", def->format = MSQ_FORMAT_AUTO);
    wrong_file(table, def);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(def->max_bytes = stl_bytes; def->max_triangles = 12);
    WRONG(LIMIT, "max_bytes|683|684", def->max_bytes = stl_bytes - 1);
    WRONG(LIMIT, "max_triangles is 11|12", def->max_triangles = 11);
    WRONG(MESH, "no triangles", put_little_endian(file + 80, 0); bytes = 84);
    WRONG(MESH, "finite", put_float(file + 84 + 12, NAN));
    WRONG(ARGUMENT, "format", def = NULL);
    if (TRY(msq_shape_from_memory(in, data, bytes, def, shape, job))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_from_file") {
    msq_context* in = context;
    char path[512];
    const char *parent = getenv("TMPDIR"), *name = path;
    uint8_t file[stl_bytes];
    size_t bytes = stl_bytes;
    msq_file_def* def = (msq_file_def*)definition(0);
    msq_shape** shape = (msq_shape**)output(0);
    msq_job* job = NULL;
    make_stl(file);
    assert_ok(msq_file_def_init(def, sizeof *def));
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "path is NULL", name = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    wrong_file(table, def);
    WRONG(IO, path_of_none, name = path_of_none);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(def->max_bytes = stl_bytes; def->max_triangles = 12);
    WRONG(LIMIT, "max_bytes|683|684", def->max_bytes = stl_bytes - 1);
    WRONG(LIMIT, "max_triangles is 11|12", def->max_triangles = 11);
    WRONG(MESH, "no triangles", put_little_endian(file + 80, 0); bytes = 84);
    WRONG(MESH, "finite", put_float(file + 84 + 12, NAN));
    snprintf(path, sizeof path, "%s/msq-refusals-%d.stl", parent && *parent ? parent : "/tmp",
             (int)getpid());
    FILE* stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(file, 1, bytes, stream), bytes);
    assert_int_equal(fclose(stream), 0);
    RIGHT(def = NULL);
    if (TRY(msq_shape_from_file(in, name, def, shape, job))) msq_shape_release(*shape);
    unlink(path);
  }
}

#endif

static int32_t all_inside(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)points;
  memset(inside, 1, count);
  return note_call((host_log*)user, count);
}

static void host_shapes(void** state) {
  (void)state;
  REFUSALS("msq_shape_from_host") {
    msq_context* in = context;
    host_log log = make_log();
    msq_host_shape_def* def = (msq_host_shape_def*)definition(0);
    msq_shape** shape = (msq_shape**)output(0);
    assert_ok(msq_host_shape_def_init(def, sizeof *def));
    def->inside = all_inside;
    def->user = &log;
    def->release = note_release;
    for (int axis = 0; axis < 3; ++axis) {
      def->min[axis] = 0;
      def->max[axis] = 4;
    }
    wrong_sizes(table, def, offsetof(msq_host_shape_def, hash_key), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "inside is NULL", def->inside = NULL);
    WRONG(ARGUMENT, "concurrent is -1", def->concurrent = -1);
    WRONG(ARGUMENT, "concurrent is 2", def->concurrent = 2);
    for (int axis = 0; axis < 3; ++axis) {
      WRONG(ARGUMENT, words_of("min[%d]", axis), def->min[axis] = def->max[axis]);
      for (int which = 0; which < 3; ++which) {
        WRONG(ARGUMENT, "finite", def->min[axis] = not_finite(which));
        WRONG(ARGUMENT, "finite", def->max[axis] = not_finite(which));
      }
    }
    WRONG(ARGUMENT, "1e+75", def->max[0] = 1e76);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    const int is_made = TRY(msq_shape_from_host(in, def, shape));
    if (is_made) msq_shape_release(*shape);
    assert_int_equal(log.released, is_made); /* what is refused is not released */
    assert_int_equal(log.calls, 0);
  }
}

static void images(void** state) {
  msq_context* tiny = make_context_of(1, 0, 20);
  (void)state;
  REFUSALS("msq_shape_from_voxels") {
    msq_context* in = context;
    msq_voxels_def* def = (msq_voxels_def*)definition(0);
    msq_shape** shape = (msq_shape**)output(0);
    assert_ok(msq_voxels_def_init(def, sizeof *def));
    def->image = small_image();
    def->threshold = 100;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    wrong_enum(table, &def->solid, "solid", 0, 1);
    wrong_number(table, &def->threshold, "threshold");
    WRONG(ARGUMENT, "from 0 to 234", def->threshold = 234.5);
    WRONG(ARGUMENT, "no value of the image is solid", def->solid = MSQ_SOLID_BELOW;
          def->threshold = -0.5);
    WRONG(ARGUMENT, "too large", def->image.grid.origin[2] = 1e80);
    wrong_image(table, &def->image, 2);
    WRONG(LIMIT, "an image of", in = tiny);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_shape_from_voxels(in, def, shape))) msq_shape_release(*shape);
    assert_int_equal(memory_of(context).bytes, 0);
    assert_int_equal(memory_of(tiny).bytes, 0);
  }
  msq_context_release(tiny);
}

static void shapes_of_shapes(void** state) {
  const double center[3] = {4, 2, 2}, stretch[12] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0};
  const double singular[12] = {1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0};
  const double flat[12] = {1, 1, 0, 0, 1, 1 + 1e-9, 0, 0, 0, 0, 1, 0};
  const double exact[12] = {0, -2, 0, 5, 2, 0, 0, 6, 0, 0, 2, 7};
  msq_shape *box = make_box(context), *far = make_box_of(context, 5, 6), *ball, *both, *stretched;
  msq_shape* space;
  msq_shape* nested[65];
  (void)state;
  assert_ok(msq_shape_all_space(context, &space));
  assert_ok(msq_shape_from_sphere(context, center, 2, &ball));
  const msq_shape* const pair[2] = {box, ball};
  assert_ok(msq_shape_boolean(MSQ_BOOLEAN_UNION, pair, 2, &both));
  assert_ok(msq_shape_placed(ball, stretch, &stretched));
  msq_shape_retain(nested[0] = box);
  for (int i = 1; i < 65; ++i) assert_ok(msq_shape_placed(nested[i - 1], exact, &nested[i]));

  REFUSALS("msq_shape_placed") {
    const msq_shape* original = box;
    double numbers[12], *matrix = numbers;
    msq_shape** shape = (msq_shape**)output(0);
    memcpy(numbers, exact, sizeof numbers);
    WRONG(ARGUMENT, "original is NULL", original = NULL);
    WRONG(ARGUMENT, "matrix is NULL", matrix = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    for (int i = 0; i < 12; ++i) wrong_number(table, numbers + i, words_of("matrix[%d] is ", i));
    WRONG(ARGUMENT, "singular", memcpy(numbers, singular, sizeof numbers));
    WRONG(ARGUMENT, "the limit is 1e+06", memcpy(numbers, flat, sizeof numbers));
    WRONG(ARGUMENT, "singular", memset(numbers, 0, sizeof numbers));
    WRONG(ARGUMENT, "1e+75", numbers[3] = 2e75);
    WRONG(ARGUMENT, "1e+76", memset(numbers, 0, sizeof numbers);
          numbers[0] = numbers[5] = numbers[10] = 1e76);
    WRONG(ARGUMENT, "1e-76", memset(numbers, 0, sizeof numbers);
          numbers[0] = numbers[5] = numbers[10] = 1e-76);
    WRONG(ARGUMENT, "up to 1e+308|1e+75", memset(numbers, 0, sizeof numbers);
          numbers[0] = numbers[5] = numbers[10] = 1e308);
    WRONG(ARGUMENT, "up to 9.9|e-321|1e-75", memset(numbers, 0, sizeof numbers);
          numbers[0] = numbers[5] = numbers[10] = 1e-320);
    RIGHT(original = nested[63]);
    WRONG(LIMIT, "64", original = nested[64]);
    WRONG(UNSUPPORTED, "original is all space", original = space);
    if (TRY(msq_shape_placed(original, matrix, shape))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_boolean") {
    const msq_shape* list[2] = {box, ball};
    const msq_shape* const* shapes = list;
    int32_t operation = MSQ_BOOLEAN_UNION;
    uint64_t count = 2;
    msq_shape** shape = (msq_shape**)output(0);
    wrong_enum(table, &operation, "operation", 1, 3);
    WRONG(ARGUMENT, "shapes is NULL", shapes = NULL);
    WRONG(ARGUMENT, "count is 0", count = 0);
    WRONG(ARGUMENT, "4097|4096", count = 4097);
    WRONG(ARGUMENT, "shapes[0] is NULL", list[0] = NULL);
    WRONG(ARGUMENT, "shapes[1] is NULL", list[1] = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(UNSUPPORTED, "shapes|all space", list[1] = space);
    WRONG(ARGUMENT, "do not meet", operation = MSQ_BOOLEAN_INTERSECTION; list[1] = far);
    RIGHT(operation = MSQ_BOOLEAN_INTERSECTION);
    if (TRY(msq_shape_boolean(operation, shapes, count, shape))) msq_shape_release(*shape);
  }
  REFUSALS("msq_shape_offset") {
    const msq_shape* original = box;
    double distance = 0.5;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "original is NULL", original = NULL);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    WRONG(ARGUMENT, "distance is 0", distance = 0);
    wrong_number(table, &distance, "distance is ");
    WRONG(ARGUMENT, "-2.5", distance = -2.5);
    WRONG(ARGUMENT, "2e+75", distance = 2e75);
    WRONG(UNSUPPORTED, "-0.5", original = both; distance = -0.5);
    WRONG(UNSUPPORTED, "bound", original = stretched);
    WRONG(UNSUPPORTED, "original is all space", original = space);
    RIGHT(distance = -0.5);
    if (TRY(msq_shape_offset(original, distance, shape))) msq_shape_release(*shape);
  }
  for (int i = 0; i < 65; ++i) msq_shape_release(nested[i]);
  msq_shape_release(space);
  msq_shape_release(stretched);
  msq_shape_release(both);
  msq_shape_release(ball);
  msq_shape_release(far);
  msq_shape_release(box);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(primitives),
    cmocka_unit_test(meshes),
#if MSQ_WITH_ASSIMP
    cmocka_unit_test(files),
#endif
    cmocka_unit_test(host_shapes),
    cmocka_unit_test(images),
    cmocka_unit_test(shapes_of_shapes),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(small_context());
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}

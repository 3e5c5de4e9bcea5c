/* SPDX-License-Identifier: Apache-2.0 */
#include "hashes.h"

static msq_context* context;

static void hash_and_release(msq_shape* shape, uint8_t hash[hash_bytes]) {
  assert_ok(msq_shape_hash(shape, hash));
  msq_shape_release(shape);
}

/* ---- primitives ------------------------------------------------------------------------------ */

typedef struct primitive {
  double a[3], b[3], radius;
} primitive;

static const primitive unit_primitive = {{0, 0, 0}, {1, 1, 1}, 0.5};

static void hash_box(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const primitive* p = (const primitive*)def;
  msq_shape* shape;
  assert_ok(msq_shape_from_box(in, p->a, p->b, &shape));
  hash_and_release(shape, hash);
}

static void hash_sphere(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const primitive* p = (const primitive*)def;
  msq_shape* shape;
  assert_ok(msq_shape_from_sphere(in, p->a, p->radius, &shape));
  hash_and_release(shape, hash);
}

static void hash_cylinder(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const primitive* p = (const primitive*)def;
  msq_shape* shape;
  assert_ok(msq_shape_from_cylinder(in, p->a, p->b, p->radius, &shape));
  hash_and_release(shape, hash);
}

static void primitives_hash_their_numbers(void** state) {
  primitive def = unit_primitive;
  (void)state;
  HASHES(context, "box", &def, sizeof def, hash_box) {
    for (int axis = 0; axis < 3; ++axis) {
      CHANGES(def.a[axis], def.a[axis] = 0.25);
      KEEPS(def.a[axis], def.a[axis] = -0.0);
      CHANGES(def.b[axis], def.b[axis] = 2);
    }
    NOT_HASHED(def.radius);
  }
  HASHES(context, "sphere", &def, sizeof def, hash_sphere) {
    for (int axis = 0; axis < 3; ++axis) CHANGES(def.a[axis], def.a[axis] = 0.25);
    NOT_HASHED(def.b);
    CHANGES(def.radius, def.radius = 1);
    CHANGES(def.radius, def.radius = nextafter(0.5, 1));
  }
  HASHES(context, "cylinder", &def, sizeof def, hash_cylinder) {
    for (int axis = 0; axis < 3; ++axis) {
      CHANGES(def.a[axis], def.a[axis] = 0.25);
      CHANGES(def.b[axis], def.b[axis] = 2);
    }
    CHANGES(def.radius, def.radius = 1);
  }
}

/* ---- meshes ---------------------------------------------------------------------------------- */

static void hash_mesh(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  hash_and_release(make_mesh(in, (const msq_mesh_def*)def), hash);
}

static void meshes_hash_vertices_and_triangles(void** state) {
  static double corners[8][3], spread[9][4], more[9][3];
  static float single[8][3];
  static uint32_t triangles[12][3], turned[12][3], dropped[13][3];
  (void)state;
  cube_corners(0, 4, corners);
  memcpy(triangles, cube_triangles(), sizeof triangles);
  /* After one of two vertices, which no other numbers go by. */
  memcpy(dropped + 1, cube_triangles(), sizeof triangles);
  dropped[0][0] = dropped[0][2] = 6;
  dropped[0][1] = 5;
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 3; ++k) turned[i][k] = triangles[i][(k + 1) % 3];
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      spread[i][axis] = more[i][axis] = corners[i][axis];
      single[i][axis] = (float)corners[i][axis];
    }
  msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, (const uint32_t(*)[3])triangles, 12);
  HASHES(context, "msq_mesh_def", &def, sizeof def, hash_mesh) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.reserved);
    /* What becomes the same mesh. */
    KEEPS(def.coordinate_type, def.coordinate_type = MSQ_FLOAT32; def.vertices = single);
    KEEPS(def.vertex_stride, def.vertices = spread; def.vertex_stride = sizeof spread[0]);
    KEEPS(def.vertex_count, def.vertices = more; def.vertex_count = 9);
    KEEPS(def.triangle_count, def.triangles = dropped[0]; def.triangle_count = 13);
    /* A closed mesh has one winding number everywhere, so AUTO is NONZERO. */
    KEEPS(def.winding_rule, def.winding_rule = MSQ_WINDING_NONZERO);
    CHANGES(def.winding_rule, def.winding_rule = MSQ_WINDING_EVEN_ODD);
    CHANGES(def.winding_rule, def.winding_rule = MSQ_WINDING_POSITIVE);
    CHANGES(def.triangle_count, def.triangle_count = 11);
    CHANGES(def.triangle_count, def.triangle_count = 11; def.winding_rule = MSQ_WINDING_NONZERO);
    CHANGES(def.triangles, def.triangles = turned[0]);
    NOT_HASHED(def.vertices);
    for (int i = 0; i < 8; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        CHANGES_BEHIND(double, corners[i][axis], corners[i][axis] + 0x1p-40);
        if (corners[i][axis] != 0) continue;
        corners[i][axis] = -0.0;
        KEEPS(def.vertices, (void)0);
        corners[i][axis] = 0;
      }
    CHANGES_BEHIND(uint32_t, triangles[11][2], 4);
  }
}

static const char ascii[] =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 0.5\n"
    "endloop\nendfacet\nendsolid\n";

static void hash_text(const char* text, int32_t format, double unit_mm, uint8_t hash[hash_bytes]) {
  msq_file_def def;
  msq_shape* shape;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = format;
  def.unit_mm = unit_mm;
  assert_ok(msq_shape_from_memory(context, text, strlen(text), &def, &shape, NULL));
  hash_and_release(shape, hash);
}

static void hash_file(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_shape* shape;
  assert_ok(
      msq_shape_from_memory(in, ascii, sizeof ascii - 1, (const msq_file_def*)def, &shape, NULL));
  hash_and_release(shape, hash);
}

static void files_hash_the_mesh_alone(void** state) {
  static const char renamed[] =
      "solid two\n facet normal 0 0 1\n outer loop\n vertex 0.0 0 0\n vertex 1e0 0 0\n"
      " vertex 0 2 .5\n endloop\n endfacet\nendsolid two\n";
  static const char obj[] = "# A comment\nv 0 0 0\nv 1 0 0\nv 0 2 0.5\nf 1 2 3\n";
  static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0.5}};
  static const uint32_t triangle[1][3] = {{0, 1, 2}};
  const msq_mesh_def mesh = mesh_def(corners, 3, triangle, 1);
  uint8_t one[hash_bytes], other[hash_bytes];
  msq_file_def def;
  (void)state;
  hash_text(ascii, MSQ_FORMAT_STL, 1, one);
  hash_text(renamed, MSQ_FORMAT_STL, 1, other);
  assert_memory_equal(one, other, hash_bytes);
  hash_text(obj, MSQ_FORMAT_OBJ, 1, other);
  assert_memory_equal(one, other, hash_bytes);
  hash_mesh(context, &mesh, other);
  assert_memory_equal(one, other, hash_bytes);
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = MSQ_FORMAT_STL;
  HASHES(context, "msq_file_def", &def, sizeof def, hash_file) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.format);
    NOT_HASHED(def.reserved);
    CHANGES(def.unit_mm, def.unit_mm = 25.4);
    CHANGES(def.winding_rule, def.winding_rule = MSQ_WINDING_NONZERO);
    KEEPS(def.max_bytes, def.max_bytes = 100000);
    KEEPS(def.max_triangles, def.max_triangles = 10);
  }
}

/* ---- voxels ---------------------------------------------------------------------------------- */

static void hash_voxels(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_shape* shape;
  assert_ok(msq_shape_from_voxels(in, (const msq_voxels_def*)def, &shape));
  hash_and_release(shape, hash);
}

static void voxels_hash_the_image(void** state) {
  static uint8_t values[36], spread[36];
  static uint16_t wide[27];
  static float real[27];
  msq_voxels_def def;
  (void)state;
  for (int i = 0; i < 36; ++i) values[i] = (uint8_t)(9 * (i % 27));
  for (int i = 0; i < 27; ++i) {
    real[i] = wide[i] = values[i];
    spread[4 * (i / 3) + i % 3] = values[i];
  }
  assert_ok(msq_voxels_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_UINT8;
  for (int axis = 0; axis < 3; ++axis) def.image.size[axis] = 3;
  def.threshold = 100;
  HASHES(context, "msq_voxels_def", &def, sizeof def, hash_voxels) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.image.reserved);
    NOT_HASHED(def.image.values);
    CHANGES(def.solid, def.solid = MSQ_SOLID_BELOW);
    CHANGES(def.threshold, def.threshold = 101);
    CHANGES(def.image.value_type, def.image.values = wide; def.image.value_type = MSQ_UINT16);
    CHANGES(def.image.value_type, def.image.values = real; def.image.value_type = MSQ_FLOAT32);
    CHANGES(def.image.size[0], def.image.size[0] = 2; def.image.size[1] = 4);
    CHANGES(def.image.size[1], def.image.size[1] = 4);
    CHANGES(def.image.size[2], def.image.size[2] = 2);
    KEEPS(def.image.row_stride, def.image.values = spread; def.image.row_stride = 4);
    CHANGES(def.image.layer_stride, def.image.layer_stride = 10);
    KEEPS(def.image.layer_stride, def.image.layer_stride = 9);
    GRID_CHANGES(def.image.grid);
    for (int i = 0; i < 27; ++i) CHANGES_BEHIND(uint8_t, values[i], 250);
  }
  def.image.values = real;
  def.image.value_type = MSQ_FLOAT32;
  HASHES(context, "msq_voxels_def of float", &def, sizeof def, hash_voxels) {
    NOT_HASHED(def);
    for (int i = 0; i < 27; ++i) CHANGES_BEHIND(float, real[i], nextafterf(real[i], 1000));
    assert_true(real[0] == 0);
    real[0] = -0.0f;
    KEEPS(def.image.values, (void)0);
  }
}

/* ---- shapes made of shapes ------------------------------------------------------------------- */

typedef struct made_def {
  const msq_shape* shapes[2];
  double matrix[12];
  double distance;
  int32_t operation, count;
} made_def;

static void hash_placed(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const made_def* made = (const made_def*)def;
  msq_shape* shape;
  (void)in;
  assert_ok(msq_shape_placed(made->shapes[0], made->matrix, &shape));
  hash_and_release(shape, hash);
}

static void hash_boolean(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const made_def* made = (const made_def*)def;
  msq_shape* shape;
  (void)in;
  assert_ok(msq_shape_boolean(made->operation, made->shapes, (uint64_t)made->count, &shape));
  hash_and_release(shape, hash);
}

static void hash_offset(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  const made_def* made = (const made_def*)def;
  msq_shape* shape;
  (void)in;
  assert_ok(msq_shape_offset(made->shapes[0], made->distance, &shape));
  hash_and_release(shape, hash);
}

static void shapes_of_shapes_hash_their_members(void** state) {
  msq_shape *small = make_box_of(context, 0, 2), *large = make_box_of(context, 0, 3),
            *same = make_box_of(context, 0, 2);
  made_def def = {{small, large}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0.25, 1, 2};
  (void)state;
  HASHES(context, "placed", &def, sizeof def, hash_placed) {
    CHANGES(def.shapes[0], def.shapes[0] = large);
    KEEPS(def.shapes[0], def.shapes[0] = same);
    for (int i = 0; i < 12; ++i) CHANGES(def.matrix[i], def.matrix[i] += 0.5);
    NOT_HASHED(def);
  }
  HASHES(context, "boolean", &def, sizeof def, hash_boolean) {
    CHANGES(def.shapes[0], def.shapes[0] = large);
    CHANGES(def.shapes[1], def.shapes[1] = small);
    KEEPS(def.shapes[0], def.shapes[0] = same);
    CHANGES(def.shapes, def.shapes[0] = large; def.shapes[1] = small);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_INTERSECTION);
    CHANGES(def.operation, def.operation = MSQ_BOOLEAN_DIFFERENCE);
    CHANGES(def.count, def.count = 1);
    NOT_HASHED(def);
  }
  HASHES(context, "offset", &def, sizeof def, hash_offset) {
    CHANGES(def.shapes[0], def.shapes[0] = large);
    KEEPS(def.shapes[0], def.shapes[0] = same);
    CHANGES(def.distance, def.distance = -0.25);
    CHANGES(def.distance, def.distance = 0.5);
    NOT_HASHED(def);
  }
  msq_shape_release(same);
  msq_shape_release(large);
  msq_shape_release(small);
}

/* ---- shapes of the host ---------------------------------------------------------------------- */

static int32_t all_inside(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)user;
  (void)points;
  memset(inside, 1, count);
  return 0;
}

static int32_t no_distance(void* user, const double* points, uint64_t count, double* distances) {
  (void)user;
  (void)points;
  for (uint64_t i = 0; i < count; ++i) distances[i] = 0;
  return 0;
}

static msq_host_shape_def host_def(void) {
  msq_host_shape_def def;
  assert_ok(msq_host_shape_def_init(&def, sizeof def));
  assert_int_equal(def.hash_key[0] | def.hash_key[1], 0);
  def.inside = all_inside;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 0;
    def.max[axis] = 1;
  }
  def.hash_key[0] = def.hash_key[1] = 7;
  return def;
}

static void hash_host(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_shape* shape;
  assert_ok(msq_shape_from_host(in, (const msq_host_shape_def*)def, &shape));
  hash_and_release(shape, hash);
}

static void host_shapes_hash_their_key(void** state) {
  msq_host_shape_def def = host_def();
  (void)state;
  HASHES(context, "msq_host_shape_def", &def, sizeof def, hash_host) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.inside);
    KEEPS(def.concurrent, def.concurrent = 1);
    HOST_ROWS(def);
    CHANGES(def.distance, def.distance = no_distance);
    for (int axis = 0; axis < 3; ++axis) {
      CHANGES(def.min[axis], def.min[axis] = -1);
      CHANGES(def.max[axis], def.max[axis] = 2);
    }
    CHANGES(def.hash_key[0], def.hash_key[0] = 0);
    CHANGES(def.hash_key[1], def.hash_key[1] = 0);
  }
}

static void a_shape_within_a_shape_needs_its_key(void** state) {
  static const double matrix[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  msq_host_shape_def def = host_def();
  msq_shape *host, *placed;
  uint8_t hash[hash_bytes];
  (void)state;
  memset(hash, 0x5a, sizeof hash);
  def.hash_key[0] = def.hash_key[1] = 0;
  assert_ok(msq_shape_from_host(context, &def, &host));
  assert_ok(msq_shape_placed(host, matrix, &placed));
  for (int again = 0; again < 2; ++again)
    assert_refused(msq_shape_hash(placed, hash), MSQ_E_UNSUPPORTED, "hash_key");
  assert_filled(hash, sizeof hash, 0x5a);
  msq_shape_release(placed);
  msq_shape_release(host);
}

/* ---- all ------------------------------------------------------------------------------------- */

static void the_context_does_not_count(void** state) {
  msq_context* other = make_context_of(1, 0, (uint64_t)1 << 30);
  uint8_t one[hash_bytes], two[hash_bytes];
  (void)state;
  hash_and_release(make_cube_mesh(context), one);
  hash_and_release(make_cube_mesh(other), two);
  assert_memory_equal(one, two, hash_bytes);
  msq_context_release(other);
}

static void hashes_are_those_of_every_machine(void** state) {
  const primitive p = {{1, -2, 0.5}, {4, 5, 6}, 0.75};
  uint8_t hash[hash_bytes];
  msq_shape* space;
  (void)state;
  hash_sphere(context, &p, hash);
  assert_hash(hash, "749ebad2d2a549af798e6855ff5d1004");
  hash_and_release(make_cube_mesh(context), hash);
  assert_hash(hash, "cdd28918f60bb250982b5c643a613674");
  assert_ok(msq_shape_all_space(context, &space));
  hash_and_release(space, hash);
  assert_hash(hash, "f5efa24f3c40ce20c1e3181f6e7c7be0");
}

static void a_build_without_xxhash_refuses(void** state) {
  msq_shape* box = make_box(context);
  uint8_t hash[hash_bytes];
  (void)state;
  memset(hash, 0x5a, sizeof hash);
  assert_refused(msq_shape_hash(box, hash), MSQ_E_UNSUPPORTED, "MSQ_WITH_XXHASH");
  assert_filled(hash, sizeof hash, 0x5a);
  msq_shape_release(box);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(primitives_hash_their_numbers),
      cmocka_unit_test(meshes_hash_vertices_and_triangles),
      cmocka_unit_test(files_hash_the_mesh_alone),
      cmocka_unit_test(voxels_hash_the_image),
      cmocka_unit_test(shapes_of_shapes_hash_their_members),
      cmocka_unit_test(host_shapes_hash_their_key),
      cmocka_unit_test(a_shape_within_a_shape_needs_its_key),
      cmocka_unit_test(the_context_does_not_count),
      cmocka_unit_test(hashes_are_those_of_every_machine),
  };
  const struct CMUnitTest refused[] = {cmocka_unit_test(a_build_without_xxhash_refuses)};
  context = make_context();
  const int failed = MSQ_WITH_XXHASH ? cmocka_run_group_tests(tests, NULL, NULL)
                                     : cmocka_run_group_tests(refused, NULL, NULL);
  msq_context_release(context);
  return failed;
}

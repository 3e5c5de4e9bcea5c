/* SPDX-License-Identifier: Apache-2.0
 * msq_ray_cast. That hits are where membership changes, on every shape and structure:
 * contract/test_rays.cpp, contract/test_shape_rays.cpp. */
#include "materials.h"

enum { few = 4 };

static const double (*few_origins(void))[3] {
  static const double origins[few][3] = {{-2, 0.5, 0.5}, {0.5, 0.5, 0.5}, {9, 9, 9}, {0.5, 0.5, 4}};
  return origins;
}

static const double (*few_directions(void))[3] {
  static const double directions[few][3] = {{2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, -0.5}};
  return directions;
}

static msq_rays_def few_rays(void) {
  msq_rays_def def;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = few;
  def.origins = few_origins();
  def.directions = few_directions();
  return def;
}

static msq_model* make_unit_box_model(msq_context* context, msq_structure* structure) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  msq_shape* box;
  assert_ok(msq_shape_from_box(context, low, high, &box));
  return make_model(context, box, structure, NULL);
}

/* A cubic lattice: struts of radius 0.125 along the edges of cells of size 1. */
static msq_model* make_struts_model(msq_context* context) {
  msq_lattice_def def;
  msq_structure* lattice;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  def.radius.value = 0.125;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  return make_unit_box_model(context, lattice);
}

static void hits_a_box(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_unit_box_model(context, NULL);
  msq_rays_def def = few_rays();
  msq_ray_hit hits[few];
  (void)state;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, few, NULL));
  assert_near(hits[0].t, 1, 1e-10); /* in units of the direction */
  assert_int_equal(hits[0].scale, 0);
  assert_int_equal(hits[0].starts_inside, 0);
  assert_true(hits[0].normal[0] == -1 && hits[0].normal[1] == 0 && hits[0].normal[2] == 0);
  assert_true(hits[1].t == 0);
  assert_int_equal(hits[1].starts_inside, 1);
  assert_int_equal(hits[2].scale, -1);
  assert_true(isinf(hits[2].t));
  assert_near(hits[3].t, 6, 1e-10);
  assert_true(hits[3].normal[2] == 1);

  /* From behind the box, and no farther than before it. */
  const double from[few] = {4, 0.25, 0, 0}, to[few] = {5, 1, 1, 5.5};
  def.t_min = from;
  def.t_max = to;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, few, NULL));
  assert_int_equal(hits[0].scale, -1);
  assert_true(hits[1].starts_inside == 1 && hits[1].t == 0.25);
  assert_int_equal(hits[3].scale, -1);
  msq_model_release(model);
  msq_context_release(context);
}

/* Along the axis, with an end short of the cylinder: no hit; and with one that reaches it. */
static void hits_a_cylinder_along_its_axis(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 1, 0};
  const double origins[2][3] = {{-0.3, -0.3, 0}, {-0.3, -0.3, 0}};
  const double directions[2][3] = {{1, 1, 0}, {1, 1, 0}}, t_max[2] = {0.2, 0.4};
  msq_context* context = make_context();
  msq_shape* cylinder;
  msq_rays_def def;
  msq_ray_hit hits[2];
  (void)state;
  assert_ok(msq_shape_from_cylinder(context, from, to, 0.5, &cylinder));
  msq_model* model = make_model(context, cylinder, NULL, NULL);
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = 2;
  def.origins = origins;
  def.directions = directions;
  def.t_max = t_max;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, 2, NULL));
  assert_int_equal(hits[0].scale, -1);
  assert_int_equal(hits[1].scale, 0);
  assert_near(hits[1].t, 0.3, 1e-10);
  msq_model_release(model);
  msq_context_release(context);
}

/* Rays that end just before, at and just behind what the same ray without an end meets. */
static void hits_nothing_past_the_end(void** state) {
  enum { rays = 240, ends = 9 };
  const double middle[3] = {0.3, 0.1, 0.2};
  static double origins[rays * ends][3], directions[rays * ends][3], t_max[rays * ends];
  static msq_ray_hit hits[rays * ends];
  msq_context* context = make_context();
  msq_shape* ball;
  msq_rays_def def;
  size_t i, met = 0;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, middle, 0.7, &ball));
  msq_model* model = make_model(context, ball, NULL, NULL);
  for (i = 0; i < rays * ends; ++i) {
    const double a = 0.7 * (double)(i / ends), b = 1.3 * (double)(i / ends);
    const double origin[3] = {3 * cos(a), 3 * sin(a), sin(b)};
    for (int axis = 0; axis < 3; ++axis) {
      origins[i][axis] = origin[axis];
      directions[i][axis] = 0.6 * sin(b + axis) + middle[axis] - origin[axis];
    }
    t_max[i] = INFINITY;
  }
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = rays * ends;
  def.origins = origins;
  def.directions = directions;
  def.t_max = t_max;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, def.count, NULL));
  for (i = 0; i < rays * ends; ++i)
    if (hits[i].scale >= 0) t_max[i] = hits[i].t + ((double)(i % ends) - 4) * 4e-12;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, def.count, NULL));
  for (i = 0; i < rays * ends; ++i)
    if (hits[i].scale >= 0) {
      assert_true(hits[i].t <= t_max[i]);
      ++met;
    }
  assert_true(met > rays);
  msq_model_release(model);
  msq_context_release(context);
}

/* A ray that ends on a boundary, which is inside, hits there; one that ends a number before does
 * not; one that begins there, too, starts inside. */
static void hits_what_begins_at_its_end(void** state) {
  /* Box and struts: a face, the side of a strut, and again with directions of other lengths. */
  const double origins[][3] = {{-1, 0.5, 0.5}, {0.5, 0.25, 3}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  const double directions[][3] = {{1, 0, 0}, {0, 0, -0.5}, {-1, 0, 0}, {0, -0.25, 0}};
  const double ends[][4] = {{1, 4, 0.375, 1.5}, {1, 4, 0, 0}};
  const int32_t scales[] = {0, 0, 1, 1};
  enum { rays = 4 };
  (void)state;
  for (int has_struts = 0; has_struts < 2; ++has_struts) {
    msq_context* context = make_context();
    msq_model* model = has_struts ? make_struts_model(context) : make_unit_box_model(context, NULL);
    double t_min[rays], t_max[rays];
    msq_rays_def def;
    msq_ray_hit hits[rays];
    assert_ok(msq_rays_def_init(&def, sizeof def));
    def.count = rays;
    def.origins = origins;
    def.directions = directions;
    def.t_max = t_max;
    for (int by = -1; by <= 1; ++by) {
      for (int i = 0; i < rays; ++i)
        t_max[i] =
            by ? nextafter(ends[!has_struts][i], (float)by * INFINITY) : ends[!has_struts][i];
      assert_ok(msq_ray_cast(model, &def, NULL, hits, rays, NULL));
      for (int i = 0; i < rays; ++i) {
        /* With struts, the first two rays meet none at the face. */
        if (has_struts && scales[i] == 0) {
          assert_int_equal(hits[i].scale, -1);
          continue;
        }
        if (!has_struts && scales[i] == 1) continue;
        assert_int_equal(hits[i].scale, by < 0 ? -1 : scales[i]);
        if (by == 0) assert_true(hits[i].t == t_max[i]);
        if (by >= 0) assert_near(hits[i].t, ends[!has_struts][i], 1e-10);
        if (by >= 0) assert_int_equal(hits[i].starts_inside, 0);
        if (by >= 0) assert_true(hits[i].normal[i == 0 || i == 2 ? 0 : i == 1 ? 2 : 1] != 0);
      }
    }
    memcpy(t_min, ends[!has_struts], sizeof t_min);
    memcpy(t_max, ends[!has_struts], sizeof t_max);
    def.t_min = t_min;
    assert_ok(msq_ray_cast(model, &def, NULL, hits, rays, NULL));
    for (int i = has_struts ? 2 : 0; i < rays; ++i) {
      assert_int_equal(hits[i].starts_inside, 1);
      assert_true(hits[i].t == t_min[i]);
    }
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* A scale that is the complement of the coarser one, and a strut along a face on the far side of
 * it: boundaries meet, but nothing is within both. */
static void hits_nothing_where_only_boundaries_meet(void** state) {
  enum { rays = 200 };
  static double origins[rays][3], directions[rays][3];
  static msq_ray_hit hits[rays];
  const double low[3] = {0, 1e-300, 0}, high[3] = {1, 1, 1};
  uint64_t seed = 3;
  (void)state;
  for (int is_thin = 0; is_thin < 2; ++is_thin) {
    msq_context* context = make_context();
    msq_model* model;
    msq_rays_def def;
    if (is_thin) {
      /* Struts along all edges of the cells; their axes lie outside of the box, in its faces. */
      msq_lattice_def lattice_def;
      msq_structure* lattice;
      msq_shape* box;
      assert_ok(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
      lattice_def.unit_cell = MSQ_UNIT_CELL_CUBIC;
      lattice_def.radius.value = 1e-200;
      assert_ok(msq_structure_lattice(context, &lattice_def, &lattice));
      assert_ok(msq_shape_from_box(context, low, high, &box));
      model = make_model(context, box, lattice, NULL);
    } else {
      msq_functional_def gyroid_def;
      msq_lattice_def lattice_def;
      msq_structure *parts[2], *rest;
      assert_ok(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
      lattice_def.radius.value = 0.3;
      lattice_def.unit_cell = MSQ_UNIT_CELL_BCC;
      assert_ok(msq_structure_lattice(context, &lattice_def, &parts[0]));
      assert_ok(msq_functional_def_init(&gyroid_def, sizeof gyroid_def));
      gyroid_def.kind = MSQ_FUNCTIONAL_NETWORK;
      assert_ok(msq_structure_functional(context, &gyroid_def, &parts[1]));
      assert_ok(msq_structure_boolean(MSQ_BOOLEAN_DIFFERENCE, (const msq_structure* const*)parts, 2,
                                      &rest));
      msq_structure_release(parts[0]);
      model = make_model(context, make_box_of(context, -1, 1), rest, parts[1]);
    }
    for (int i = 0; i < rays; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        origins[i][axis] = (double)(seed >> 11) * 0x1p-53;
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        directions[i][axis] = (double)(seed >> 11) * 0x1p-53 - 0.5;
        if (!is_thin) continue;
        /* To the strut along x. */
        const double to_strut[3] = {0, -0.5, 0}, from[3] = {0.1 + 0.004 * i, 0.5, 0};
        origins[i][axis] = from[axis];
        directions[i][axis] = to_strut[axis];
      }
    assert_ok(msq_rays_def_init(&def, sizeof def));
    def.count = rays;
    def.origins = origins;
    def.directions = directions;
    assert_ok(msq_ray_cast(model, &def, NULL, hits, rays, NULL));
    for (int i = 0; i < rays; ++i)
      if (hits[i].scale != -1) fail_msg("ray %d hits at %.17g", i, hits[i].t);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void hits_struts_within_a_box(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_struts_model(context);
  /* Through the middle of the box: past the struts on its edges. Along x at y = 0: the strut of the
   * edge, cut by the box. From the middle towards an edge along z: its strut. */
  const float origins[4][3] = {
      {-1, 0.5f, 0.5f}, {-1, 0, 0.5f}, {0.5f, 0.5f, 0.5f}, {-1, 0.0625f, 0}};
  const float directions[4][3] = {{1, 0, 0}, {1, 0, 0}, {-1, -1, 0}, {1, 0, 0}};
  msq_rays_def def;
  msq_ray_hit hits[4];
  (void)state;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.coordinate_type = MSQ_FLOAT32;
  def.count = 4;
  def.origins = origins;
  def.directions = directions;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, 4, NULL));
  assert_int_equal(hits[0].scale, -1);
  assert_near(hits[1].t, 1, 1e-10); /* the strut's axis lies in the face */
  assert_int_equal(hits[1].scale, 0);
  assert_near(hits[2].t, 0.5 - 0.125 / sqrt(2), 1e-10);
  assert_int_equal(hits[2].scale, 1);
  assert_true(fabs(hits[2].normal[0] - sqrt(0.5)) < 0.1 && fabs(hits[2].normal[2]) < 0.1);
  assert_true(hits[2].cell[0] == 0 && hits[2].cell[1] == 0 && hits[2].cell[2] == 0);
  assert_near(hits[3].t, 1, 1e-10);

  msq_query_def coarse;
  assert_ok(msq_query_def_init(&coarse, sizeof coarse));
  coarse.length_scale = INFINITY;
  assert_ok(msq_ray_cast(model, &def, &coarse, hits, 4, NULL));
  assert_near(hits[0].t, 1, 1e-10);
  assert_int_equal(hits[2].starts_inside, 1);
  msq_model_release(model);
  msq_context_release(context);
}

/* Seeds in the middle of cells: struts along all edges of the cells. A ray as far beside one of
 * them as it is thick meets the next one across. */
static void meets_struts_beside_others_along_the_ray(void** state) {
  const double low[3] = {0, 0, 0}, high[3] = {4, 4, 4};
  const double beside[] = {0.1, 0.1 + 5e-9, 0.1 - 5e-9, 0.1 + 1e-6, 0.06};
  msq_context* context = make_context();
  msq_foam_def foam_def;
  msq_structure* foam;
  msq_shape* box;
  (void)state;
  assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.jitter = 0;
  foam_def.radius.value = 0.1;
  assert_ok(msq_structure_foam(context, &foam_def, &foam));
  assert_ok(msq_shape_from_box(context, low, high, &box));
  msq_model* model = make_model(context, box, foam, NULL);
  for (int axis = 0; axis < 3; ++axis)
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; ++i) {
      double origin[3] = {2, 2, 2}, direction[3] = {0, 0, 0};
      msq_rays_def def;
      msq_ray_hit hit;
      origin[axis] = 1.5;
      origin[(axis + 1) % 3] += beside[i];
      direction[axis] = 1;
      assert_ok(msq_rays_def_init(&def, sizeof def));
      def.count = 1;
      def.origins = origin;
      def.directions = direction;
      assert_ok(msq_ray_cast(model, &def, NULL, &hit, 1, NULL));
      assert_int_equal(hit.scale, 1);
      if (beside[i] == 0.1) continue; /* rounding says whether it is in the strut along it */
      assert_int_equal(hit.starts_inside, beside[i] < 0.1);
      assert_near(hit.t, beside[i] < 0.1 ? 0 : 0.4, 1e-10);
    }
  msq_model_release(model);
  msq_context_release(context);
}

/* The id at a hit is that of msq_point_material a little inside, through skin, struts and nothing.
 */
static void tells_the_material(void** state) {
  enum { count = 400 };
  double origins[count][3], directions[count][3];
  msq_ray_hit hits[count];
  uint64_t random = 5;
  msq_rays_def def;
  (void)state;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = count;
  def.origins = origins;
  def.directions = directions;
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      /* Half of the rays from within the box, many of these in voids. */
      origins[i][axis] = i % 2 ? random_between(&random, 0.5, 3.5) : random_between(&random, -1, 9);
      directions[i][axis] = random_between(&random, 1, 3) - origins[i][axis];
    }
  for (int has_skin = 0; has_skin < 2; ++has_skin)
    for (int has_fine = 0; has_fine < 2; ++has_fine) {
      msq_context* context = make_context();
      msq_model* model = make_material_model(context, 1, has_fine, has_skin);
      uint32_t ids = 0;
      assert_ok(msq_ray_cast(model, &def, NULL, hits, count, NULL));
      for (int i = 0; i < count; ++i) {
        uint32_t id = 0;
        double point[3];
        ids |= 1u << hits[i].material;
        if (hits[i].scale < 0) {
          assert_int_equal(hits[i].material, MSQ_MATERIAL_VOID);
          continue;
        }
        for (int axis = 0; axis < 3; ++axis)
          point[axis] =
              origins[i][axis] + hits[i].t * directions[i][axis] - 1e-7 * hits[i].normal[axis];
        assert_ok(msq_point_material(model, point, NULL, NULL, 0, &id, NULL));
        if (id != MSQ_MATERIAL_VOID) assert_int_equal(hits[i].material, id);
      }
      assert_int_equal(ids & ~1u, 1u << (has_fine ? 2 : 1) | (has_skin ? 1u << 3 : 0));
      msq_model_release(model);
      msq_context_release(context);
    }
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  assert_ok(msq_ray_cast(model, &def, NULL, hits, count, NULL));
  for (int i = 0; i < count; ++i) assert_int_equal(hits[i].material, MSQ_MATERIAL_VOID);
  msq_model_release(model);
  msq_context_release(context);
}

enum { tile_side = 96, many = tile_side * tile_side };

/* Hits of rays of a picture of a foam, cast in an order: ray order[n] goes to place n. */
static void cast_in_order(const msq_model* model, const uint32_t* order, msq_ray_hit* hits) {
  static double origins[many][3], directions[many][3], t_max[many];
  static msq_ray_hit found[many];
  msq_rays_def rays;
  for (uint32_t n = 0; n < many; ++n) {
    const uint32_t i = order[n], x = i % tile_side, y = i / tile_side;
    const double origin[3] = {-1, 9.0 * x / tile_side - 0.5, 5.0 * y / tile_side - 0.5};
    const double direction[3] = {1, 0.002 * (i % 7), i % 5 == 0 ? -0.1 : 0.01};
    memcpy(origins[n], origin, sizeof origin);
    memcpy(directions[n], direction, sizeof direction);
    t_max[n] = i % 11 == 0 ? 3 : i % 13 == 0 ? -5 : 20; /* some end early or before they begin */
  }
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = many;
  rays.origins = origins;
  rays.directions = directions;
  rays.t_max = t_max;
  memset(found, 0, sizeof found);
  assert_ok(msq_ray_cast(model, &rays, NULL, found, many, NULL));
  for (uint32_t n = 0; n < many; ++n) hits[order[n]] = found[n];
}

static void hits_do_not_depend_on_the_order_of_rays(void** state) {
  static msq_ray_hit wanted[many], got[many];
  static uint32_t order[many];
  /* One with room to sort rays, one without. */
  const uint64_t limits[] = {0, 40000};
  (void)state;
  for (size_t i = 0; i < 2; ++i) {
    msq_context* context = make_context_of(2, 1 << 20, limits[i]);
    const double low[3] = {0, 0, 0}, high[3] = {8, 8, 4};
    msq_shape* box;
    assert_ok(msq_shape_from_box(context, low, high, &box));
    msq_model* model = make_model(context, box, make_foam(context, MSQ_FOAM_AUTO), NULL);
    for (uint32_t n = 0; n < many; ++n) order[n] = n;
    cast_in_order(model, order, i == 0 ? wanted : got);
    if (i > 0) assert_memory_equal(got, wanted, sizeof got);
    size_t missed = 0;
    for (uint32_t n = 0; n < many; ++n) missed += wanted[n].scale < 0;
    assert_in_range(missed, many / 10, many * 3 / 4);
    uint64_t random = 1;
    for (uint32_t n = many - 1; n > 0; --n) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      const uint32_t other = (uint32_t)((random >> 33) % (n + 1)), kept = order[n];
      order[n] = order[other];
      order[other] = kept;
    }
    cast_in_order(model, order, got);
    assert_memory_equal(got, wanted, sizeof got);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* Rays through the bounding box of a triangle, along no axis. */
static void ends_in_a_mesh_of_one_triangle(void** state) {
  const double corners[3][3] = {{0, 0, 0}, {2, 0, 1}, {0, 2, 1}};
  const uint32_t triangle[1][3] = {{0, 1, 2}};
  msq_context* context = make_context();
  (void)state;
  for (int32_t rule = MSQ_WINDING_NONZERO; rule <= MSQ_WINDING_AUTO; ++rule) {
    msq_mesh_def mesh = mesh_def(corners, 3, triangle, 1);
    mesh.winding_rule = rule;
    msq_model* model = make_model(context, make_mesh(context, &mesh), NULL, NULL);
    const double origins[2][3] = {{0.2, 0.3, -1}, {-1, 0.4, 0.1}};
    const double directions[2][3] = {{0.1, 0.2, 1}, {1, 0.1, 0.2}};
    msq_rays_def def;
    msq_ray_hit hits[2];
    assert_ok(msq_rays_def_init(&def, sizeof def));
    def.count = 2;
    def.origins = origins;
    def.directions = directions;
    assert_ok(msq_ray_cast(model, &def, NULL, hits, 2, NULL));
    for (int i = 0; i < 2; ++i) {
      assert_int_equal(hits[i].starts_inside, 0);
      if (hits[i].scale < 0) continue;
      double beyond[3];
      int32_t inside;
      for (int axis = 0; axis < 3; ++axis)
        beyond[axis] = origins[i][axis] + (hits[i].t + 1e-9) * directions[i][axis];
      assert_ok(msq_point_membership(model, beyond, NULL, &inside));
      assert_int_equal(inside, 1);
    }
    /* Along +x from the second origin a part is inside, except by the generalised winding number.
     */
    assert_int_equal(hits[1].scale,
                     rule == MSQ_WINDING_NONZERO || rule == MSQ_WINDING_EVEN_ODD ? 0 : -1);
    msq_model_release(model);
  }
  msq_context_release(context);
}

static void can_be_cancelled(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_unit_box_model(context, NULL);
  const msq_rays_def def = few_rays();
  msq_ray_hit hits[few];
  msq_job* job;
  double progress = 0;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_ray_cast(model, &def, NULL, hits, few, job));
  assert_ok(msq_job_progress(job, &progress));
  assert_true(progress == 1);
  assert_ok(msq_job_cancel(job));
  assert_status(msq_ray_cast(model, &def, NULL, hits, few, job), MSQ_E_CANCELLED);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hits_a_box),
      cmocka_unit_test(hits_a_cylinder_along_its_axis),
      cmocka_unit_test(hits_nothing_past_the_end),
      cmocka_unit_test(hits_what_begins_at_its_end),
      cmocka_unit_test(hits_nothing_where_only_boundaries_meet),
      cmocka_unit_test(hits_struts_within_a_box),
      cmocka_unit_test(meets_struts_beside_others_along_the_ray),
      cmocka_unit_test(tells_the_material),
      cmocka_unit_test(hits_do_not_depend_on_the_order_of_rays),
      cmocka_unit_test(ends_in_a_mesh_of_one_triangle),
      cmocka_unit_test(can_be_cancelled),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

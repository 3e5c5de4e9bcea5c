// SPDX-License-Identifier: Apache-2.0
// Calls in any order on handles in any state that msq.h allows: objects are made of objects,
// retained, released while others use them, queried, sliced and cancelled, also from within
// callbacks. What a model once answered it answers for good.
#include <algorithm>
#include <cstring>

#include "objects.h"

namespace msq::fuzz {

namespace {

void retain(msq_shape* handle) {
  msq_shape_retain(handle);
}
void retain(msq_field* handle) {
  msq_field_retain(handle);
}
void retain(msq_structure* handle) {
  msq_structure_retain(handle);
}
void retain(msq_model* handle) {
  msq_model_retain(handle);
}
void retain(msq_slicer* handle) {
  msq_slicer_retain(handle);
}
void retain(msq_contours* handle) {
  msq_contours_retain(handle);
}
template <class Handle>
Owner<Handle> shared(const Owner<Handle>& handle) {
  retain(handle.get());
  return Owner<Handle>(handle.get());
}

constexpr double probes[4][3] = {{0.1, 0.2, 0.3}, {-0.7, 0.9, 0.4}, {1.1, -1.2, 0.5}, {0, 0, 0}};

class Player {
 public:
  explicit Player(Input& input) : input_(input) {
    for (Owner<msq_context>& context : contexts_) context = make_context();
    for (msq_job*& job : jobs_)
      if (msq_job_create(&job) != MSQ_OK) wrong("no job");
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  ~Player() {
    for (msq_job* job : jobs_) msq_job_release(job);
  }

  void play() {
    for (int i = 0; i < 40 && !input_.is_empty(); ++i) step(0);
  }

 private:
  static constexpr size_t slots = 3;

  /// A model, and what it answered when it was made.
  struct Known {
    Owner<msq_model> model;
    int32_t inside[4];
    double distance[4];
    uint8_t hash[16];
    bool has_hash;
  };

  template <class Handle>
  Owner<Handle>& any(Owner<Handle> (&of)[slots]) {
    return of[input_.below(slots)];
  }
  msq_context* context() { return contexts_[input_.below(2)].get(); }
  msq_job* job() { return input_.chance(128) ? jobs_[input_.below(2)] : nullptr; }
  /// A reference of its own for the call: the slot may be emptied meanwhile.
  template <class Handle>
  Owner<Handle> held(const Owner<Handle>& handle) {
    return handle ? shared(handle) : nullptr;
  }

  static void ask(Known* known) {
    for (int i = 0; i < 4; ++i) {
      if (!MSQ_FUZZ(msq_point_membership, known->model.get(), probes[i], nullptr,
                    &known->inside[i]))
        known->inside[i] = -1;
      if (!MSQ_FUZZ(msq_point_distance, known->model.get(), probes[i], nullptr,
                    &known->distance[i]))
        known->distance[i] = -1;
    }
    known->has_hash = MSQ_FUZZ(msq_model_hash, known->model.get(), known->hash);
  }

  void step(int depth) {
    if (depth > 2) return;
    switch (input_.below(24)) {
      case 0:
      case 1:
        make_shape();
        break;
      case 2:
        make_field();
        break;
      case 3:
      case 4:
        make_structure();
        break;
      case 5:
      case 6:
        make_model();
        break;
      case 7:
        make_slicer();
        break;
      case 8:
      case 9:
        run_slicer(depth);
        break;
      case 10:
        slice_layer();
        break;
      case 11:
        query_set();
        break;
      case 12:
        check_known();
        break;
      case 13:
        drop();
        break;
      case 14:
        share();
        break;
      case 15:
        (void)MSQ_FUZZ(msq_job_cancel, jobs_[input_.below(2)]);
        break;
      case 16: {
        msq_job*& old = jobs_[input_.below(2)];
        // A call may run under the old one.
        if (depth > 0) break;
        msq_job_release(old);
        if (msq_job_create(&old) != MSQ_OK) wrong("no job");
        break;
      }
      case 17:
        cache();
        break;
      case 18:
        contour();
        break;
      case 19:
        struts(depth);
        break;
      case 20:
        cast();
        break;
      case 21:
        fill();
        break;
      case 22:
        surface(depth);
        break;
      default:
        reports();
        break;
    }
  }

  void make_shape() {
    Owner<msq_shape>& slot = any(shapes_);
    msq_context* const in = context();
    const Owner<msq_shape> a = held(any(shapes_)), b = held(any(shapes_));
    const uint32_t kind = input_.below(6);
    if (kind < 2 || !a) {
      const double low[3] = {-1.5, -1, -1.2},
                   high[3] = {input_.between(1, 2), 1.5, input_.between(0.5, 2)};
      slot = make<msq_shape>("msq_shape_from_box",
                             [&](msq_shape** s) { return msq_shape_from_box(in, low, high, s); });
    } else if (kind == 2 && b) {
      const msq_shape* const both[2] = {a.get(), b.get()};
      const int32_t operation = 1 + static_cast<int32_t>(input_.below(3));
      slot = make<msq_shape>("msq_shape_boolean", [&](msq_shape** s) {
        return msq_shape_boolean(operation, both, 2, s);
      });
    } else if (kind == 3) {
      const double matrix[12] = {0, -1, 0, input_.between(-1, 1), 1, 0, 0, 0, 0, 0, 1, 0.25};
      slot = make<msq_shape>("msq_shape_placed",
                             [&](msq_shape** s) { return msq_shape_placed(a.get(), matrix, s); });
    } else if (kind == 4) {
      const double by = input_.between(-0.3, 0.3);
      slot = make<msq_shape>("msq_shape_offset",
                             [&](msq_shape** s) { return msq_shape_offset(a.get(), by, s); });
    } else {
      const double center[3] = {0.2, 0, 0.1};
      slot = make<msq_shape>("msq_shape_from_sphere", [&](msq_shape** s) {
        return msq_shape_from_sphere(in, center, 1.4, s);
      });
    }
  }

  void make_field() {
    Owner<msq_field>& slot = any(fields_);
    msq_context* const in = context();
    const Owner<msq_field> of = held(any(fields_));
    if (of && input_.chance(128)) {
      const double curve[4] = {0.1, 0.15, 0.3, 0.25};
      slot = make<msq_field>(
          "msq_field_map", [&](msq_field** f) { return msq_field_map(in, of.get(), curve, 2, f); });
      return;
    }
    const double from[3] = {-1, 0, 0.5}, to[3] = {1, 0.5, 0};
    const double value = input_.between(0.05, 0.4);
    slot = make<msq_field>("msq_field_gradient", [&](msq_field** f) {
      return msq_field_gradient(in, from, 0.1, to, value, f);
    });
  }

  void make_structure() {
    Owner<msq_structure>& slot = any(structures_);
    msq_context* const in = context();
    const Owner<msq_field> field = held(any(fields_));
    const uint32_t kind = input_.below(4);
    const msq_param radius = {input_.between(0.05, 0.3),
                              input_.chance(100) ? field.get() : nullptr};
    if (kind == 0) {
      msq_lattice_def def = make_def(msq_lattice_def_init);
      def.unit_cell = 1 + static_cast<int32_t>(input_.below(8));
      def.radius = radius;
      slot = make<msq_structure>("msq_structure_lattice", [&](msq_structure** s) {
        return msq_structure_lattice(in, &def, s);
      });
    } else if (kind == 1) {
      msq_functional_def def = make_def(msq_functional_def_init);
      def.function = 1 + static_cast<int32_t>(input_.below(18));
      def.kind = MSQ_FUNCTIONAL_SHEET;
      def.level = radius;
      slot = make<msq_structure>("msq_structure_functional", [&](msq_structure** s) {
        return msq_structure_functional(in, &def, s);
      });
    } else {
      msq_foam_def def = make_def(msq_foam_def_init);
      // The other methods are dear, and what they have of their own is within a call.
      def.method = kind == 2 ? MSQ_FOAM_AUTO : MSQ_FOAM_METHOD_2;
      def.radius = radius;
      def.seed = input_.byte();
      if (kind == 2 && input_.chance(64)) def.wall_thickness.value = 0.1;
      slot = make<msq_structure>(
          "msq_structure_foam", [&](msq_structure** s) { return msq_structure_foam(in, &def, s); });
    }
  }

  void make_model() {
    Known& slot = models_[input_.below(slots)];
    msq_context* const in = context();
    const Owner<msq_shape> shape = held(any(shapes_));
    const Owner<msq_structure> structure = held(any(structures_));
    const Owner<msq_model> other = held(models_[input_.below(slots)].model);
    Owner<msq_model> made;
    if (other && slot.model && input_.chance(64)) {
      const msq_model* const both[2] = {other.get(), slot.model.get()};
      made = make<msq_model>("msq_model_regions",
                             [&](msq_model** m) { return msq_model_regions(in, both, 2, m); });
    } else if (shape) {
      msq_scale_def scales[2] = {};
      scales[0].shape = shape.get();
      scales[1].structure = structure.get();
      if (structure && input_.chance(80)) scales[1].skin.value = 0.15;
      msq_model_def def = make_def(msq_model_def_init);
      def.scales = scales;
      def.scale_count = structure ? 2 : 1;
      made = make<msq_model>("msq_model_create",
                             [&](msq_model** m) { return msq_model_create(in, &def, m); });
    }
    if (!made) return;
    slot.model = std::move(made);
    ask(&slot);
  }

  void make_slicer() {
    const Owner<msq_model> model = held(models_[input_.below(slots)].model);
    if (!model) return;
    msq_slicer_def def = make_def(msq_slicer_def_init);
    def.pitch[0] = input_.between(0.06, 0.4);
    def.pitch[1] = 0.2;
    def.layer_height = input_.between(0.2, 0.5);
    def.output = 1 + static_cast<int32_t>(input_.below(4));
    def.slab_layers = input_.below(5);
    any(slicers_) = make<msq_slicer>("msq_slicer_create", [&](msq_slicer** s) {
      return msq_slicer_create(model.get(), &def, s);
    });
  }

  /// What callbacks of msq get: the player, who plays on within them.
  struct Turn {
    Player* player;
    int depth;
    int steps;
    int32_t result;
  };
  static int32_t take_turn(Turn* turn) {
    while (turn->steps > 0 && !turn->player->input_.is_empty()) {
      --turn->steps;
      turn->player->step(turn->depth + 1);
    }
    return turn->result;
  }
  Turn turn_of(int depth) {
    return {this, depth, static_cast<int>(input_.below(4)), input_.chance(20) ? -5 : 0};
  }
  void check_host(const Turn& turn, msq_status status) const {
    if (status == MSQ_E_HOST && (turn.result == 0 || msq_error_host_code() != turn.result))
      wrong("the host's code %d became %d", turn.result, msq_error_host_code());
  }

  void run_slicer(int depth) {
    const Owner<msq_slicer> slicer = held(any(slicers_));
    if (!slicer) return;
    Turn turn = turn_of(depth);
    const Call call("msq_slicer_run", 60);
    const msq_status status = msq_slicer_run(
        slicer.get(), input_.below(3), input_.chance(128) ? UINT64_MAX : 1 + input_.below(3),
        [](void* user, const msq_layer*) { return take_turn(static_cast<Turn*>(user)); }, &turn,
        job());
    call.returned(status);
    check_host(turn, status);
  }

  void slice_layer() {
    const Owner<msq_slicer> slicer = held(any(slicers_));
    if (!slicer) return;
    msq_slicer_report plan{};
    plan.struct_size = sizeof plan;
    if (!MSQ_FUZZ(msq_slicer_info, slicer.get(), &plan)) wrong("a slicer has no report");
    std::vector<uint8_t> layer(plan.layer_bytes);
    (void)MSQ_FUZZ(msq_slice_layer, slicer.get(), input_.below(8), layer.data(), layer.size(),
                   job());
  }

  void query_set() {
    const Known& known = models_[input_.below(slots)];
    if (!known.model) return;
    msq_points_def points = make_def(msq_points_def_init);
    points.kind = MSQ_POINTS_ARRAY;
    points.coordinates = probes;
    points.count = 4;
    uint8_t inside[4];
    if (!MSQ_FUZZ(msq_set_membership, known.model.get(), &points, nullptr, inside, 4, job()))
      return;
    for (int i = 0; i < 4; ++i)
      if (known.inside[i] >= 0 && inside[i] != known.inside[i])
        wrong("a model changed at probe %d", i);
  }

  void check_known() {
    Known& known = models_[input_.below(slots)];
    if (!known.model) return;
    Known now = {};
    now.model = held(known.model);
    ask(&now);
    if (std::memcmp(now.inside, known.inside, sizeof now.inside) != 0 ||
        std::memcmp(now.distance, known.distance, sizeof now.distance) != 0 ||
        now.has_hash != known.has_hash ||
        (now.has_hash && std::memcmp(now.hash, known.hash, sizeof now.hash) != 0))
      wrong("a model changed");
  }

  void drop() {
    switch (input_.below(8)) {
      case 0:
        any(shapes_).reset();
        break;
      case 1:
        any(fields_).reset();
        break;
      case 2:
        any(structures_).reset();
        break;
      case 3:
        models_[input_.below(slots)] = Known{};
        break;
      case 4:
        any(slicers_).reset();
        break;
      case 5:
        // What was made in it keeps it.
        contexts_[input_.below(2)] = make_context(1 + input_.below(2));
        break;
      case 6:
        any(contours_).reset();
        break;
      default:
        any(graphs_).reset();
        any(fills_).reset();
        break;
    }
  }

  void share() {
    const uint32_t from = input_.below(slots), to = input_.below(slots);
    shapes_[to] = held(shapes_[from]);
    structures_[to] = held(structures_[from]);
    slicers_[to] = held(slicers_[from]);
    contours_[to] = held(contours_[from]);
  }

  void cache() {
    msq_context* const in = context();
    if (input_.chance(128)) {
      (void)MSQ_FUZZ(msq_cache_clear, in);
      return;
    }
    msq_cache_report report{};
    report.struct_size = sizeof report;
    if (!MSQ_FUZZ(msq_cache_stats, in, &report) || report.bytes > report.limit_bytes ||
        report.bytes > report.peak_bytes)
      wrong("a cache of %zu bytes", static_cast<size_t>(report.bytes));
  }

  void contour() {
    const Owner<msq_model> model = held(models_[input_.below(slots)].model);
    if (!model) return;
    msq_contours_def def = make_def(msq_contours_def_init);
    def.tolerance = 0.05;
    def.pitch = input_.between(0.1, 0.5);
    const double height = input_.between(-1, 1);
    any(contours_) = make<msq_contours>("msq_layer_contours", [&](msq_contours** c) {
      return msq_layer_contours(model.get(), height, &def, c, job());
    });
  }

  void struts(int depth) {
    msq_context* const in = context();
    const Owner<msq_structure> structure = held(any(structures_));
    const Owner<msq_shape> shape = held(any(shapes_));
    if (!structure) return;
    msq_struts_def def = make_def(msq_struts_def_init);
    for (int axis = 0; axis < 3; ++axis) def.max[axis] = 1.1;
    if (input_.chance(80)) def.shape = shape.get();
    if (input_.chance(128)) {
      any(graphs_) = make<msq_strut_graph>("msq_structure_strut_graph", [&](msq_strut_graph** g) {
        return msq_structure_strut_graph(in, structure.get(), &def, g, job());
      });
      return;
    }
    Turn turn = turn_of(depth);
    const Call call("msq_structure_struts", 60);
    const msq_status status = msq_structure_struts(
        in, structure.get(), &def,
        [](void* user, const msq_strut*, uint64_t) { return take_turn(static_cast<Turn*>(user)); },
        &turn, job());
    call.returned(status);
    check_host(turn, status);
  }

  void cast() {
    const Owner<msq_model> model = held(models_[input_.below(slots)].model);
    if (!model) return;
    msq_rays_def rays = make_def(msq_rays_def_init);
    const double directions[4][3] = {{1, 0, 0}, {0.2, -1, 0.1}, {0, 0, -1}, {1, 1, 1}};
    rays.count = 4;
    rays.origins = probes;
    rays.directions = directions;
    msq_ray_hit hits[4];
    (void)MSQ_FUZZ(msq_ray_cast, model.get(), &rays, nullptr, hits, 4, job());
  }

  void fill() {
    msq_context* const in = context();
    const Owner<msq_structure> structure = held(any(structures_));
    if (!structure) return;
    const int64_t points[8] = {0, 0, 2000, 0, 2000, 1500, 0, 2000};
    const msq_ring ring = {points, 4};
    msq_fill_def def = make_def(msq_fill_def_init);
    def.rings = &ring;
    def.ring_count = 1;
    def.scale = 1e-3;
    def.z = input_.between(-1, 1);
    any(fills_) = make<msq_fill>("msq_fill_lines", [&](msq_fill** f) {
      return msq_fill_lines(in, structure.get(), &def, f, job());
    });
  }

  void surface(int depth) {
    const Owner<msq_model> model = held(models_[input_.below(slots)].model);
    if (!model) return;
    msq_surface_def def = make_def(msq_surface_def_init);
    def.pitch = input_.between(0.4, 1);
    Turn turn = turn_of(depth);
    const Call call("msq_surface_mesh", 60);
    const msq_status status = msq_surface_mesh(
        model.get(), &def,
        [](void* user, const msq_surface_slab*) { return take_turn(static_cast<Turn*>(user)); },
        &turn, job());
    call.returned(status);
    check_host(turn, status);
  }

  void reports() {
    if (const Owner<msq_contours>& contours = any(contours_)) {
      msq_contours_report report{};
      report.struct_size = sizeof report;
      if (!MSQ_FUZZ(msq_contours_info, contours.get(), &report)) wrong("contours have no report");
      double sum = 0;
      for (uint64_t i = 0; i < 2 * report.point_count; ++i)
        sum += static_cast<const double*>(report.points)[i];
      if (!(std::abs(sum) < 1e12)) wrong("contours are gone");
    }
    if (const Owner<msq_fill>& fill = any(fills_)) {
      msq_fill_report report{};
      report.struct_size = sizeof report;
      if (!MSQ_FUZZ(msq_fill_info, fill.get(), &report)) wrong("a fill has no report");
      for (uint64_t i = 0; i < 2 * report.point_count; ++i)
        if (std::abs(static_cast<const int64_t*>(report.points)[i]) > 2000)
          wrong("a line leaves its polygon");
    }
    if (const Owner<msq_strut_graph>& graph = any(graphs_)) {
      msq_strut_graph_report report{};
      report.struct_size = sizeof report;
      if (!MSQ_FUZZ(msq_strut_graph_info, graph.get(), &report)) wrong("a graph has no report");
      for (uint64_t i = 0; i < 2 * report.strut_count; ++i)
        if (report.struts[i] >= report.node_count)
          wrong("a strut ends at node %u", report.struts[i]);
    }
    double fraction;
    if (!MSQ_FUZZ(msq_job_progress, jobs_[input_.below(2)], &fraction) ||
        !(fraction >= 0 && fraction <= 1))
      wrong("progress %g", fraction);
  }

  Input& input_;
  Owner<msq_context> contexts_[2];
  msq_job* jobs_[2] = {};
  Owner<msq_shape> shapes_[slots];
  Owner<msq_field> fields_[slots];
  Owner<msq_structure> structures_[slots];
  Known models_[slots] = {};
  Owner<msq_slicer> slicers_[slots];
  Owner<msq_contours> contours_[slots];
  Owner<msq_fill> fills_[slots];
  Owner<msq_strut_graph> graphs_[slots];
};

}  // namespace

void run_calls(const uint8_t* data, size_t size) {
  Input input(data, size);
  Player(input).play();
}

}  // namespace msq::fuzz

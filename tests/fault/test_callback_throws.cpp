// SPDX-License-Identifier: Apache-2.0
// C++ exceptions that leave callbacks in spite of the rules: MSQ_E_HOST, and the next call is
// right.
#include <atomic>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "msq_test.h"

namespace {

std::atomic<bool> throws{false};

void throw_if_wanted() {
  if (throws) throw std::runtime_error("no ink");
}

/// With exceptions the call fails by them; without, it succeeds, on this thread too.
template <class Call>
void assert_stops(Call&& call) {
  assert_ok(call());
  throws = true;
  const msq_status status = call();
  throws = false;
  assert_int_equal(status, MSQ_E_HOST);
  assert_int_equal(msq_error_host_code(), 0);
  assert_non_null(std::strstr(msq_error_message(), "no ink"));
  assert_ok(call());
}

struct Stage {
  msq_context* context = nullptr;
  msq_shape* box = nullptr;
  msq_field* field = nullptr;
  msq_structure *foam = nullptr, *cubic = nullptr;
  msq_model *model = nullptr, *plain = nullptr;
  msq_slicer *slicer = nullptr, *plain_slicer = nullptr;

  explicit Stage(msq_context* in) : context(in) {
    const double min[3] = {0, 0, 0}, max[3] = {4, 4, 4};
    assert_ok(msq_shape_from_box(context, min, max, &box));
    msq_host_field_def of;
    assert_ok(msq_host_field_def_init(&of, sizeof of));
    of.low = 0.1;
    of.high = 0.2;
    of.concurrent = 1;
    of.evaluate = [](void*, const double*, uint64_t count, double* values) -> int32_t {
      throw_if_wanted();
      for (uint64_t i = 0; i < count; ++i) values[i] = 0.15;
      return 0;
    };
    of.release = [](void*) { throw_if_wanted(); };
    assert_ok(msq_field_host(context, &of, &field));
    msq_foam_def foam_def;
    assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
    foam_def.radius.field = field;
    assert_ok(msq_structure_foam(context, &foam_def, &foam));
    msq_lattice_def lattice;
    assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
    lattice.radius.value = 0.1;
    assert_ok(msq_structure_lattice(context, &lattice, &cubic));
    model = filled(foam);
    plain = filled(cubic);
    slicer = sliced(model);
    plain_slicer = sliced(plain);
  }
  ~Stage() {
    msq_slicer_release(slicer);
    msq_slicer_release(plain_slicer);
    msq_model_release(model);
    msq_model_release(plain);
    msq_structure_release(foam);
    msq_structure_release(cubic);
    msq_field_release(field);
    msq_shape_release(box);
    msq_context_release(context);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  msq_model* filled(const msq_structure* structure) {
    msq_scale_def scales[2] = {};
    scales[0].shape = box;
    scales[1].structure = structure;
    msq_model_def def;
    assert_ok(msq_model_def_init(&def, sizeof def));
    def.scales = scales;
    def.scale_count = 2;
    def.scale_size = sizeof scales[0];
    msq_model* made = nullptr;
    assert_ok(msq_model_create(context, &def, &made));
    return made;
  }
  msq_slicer* sliced(const msq_model* of) {
    msq_slicer_def def;
    assert_ok(msq_slicer_def_init(&def, sizeof def));
    def.pitch[0] = def.pitch[1] = 0.1;
    def.layer_height = 0.5;
    msq_slicer* made = nullptr;
    assert_ok(msq_slicer_create(of, &def, &made));
    return made;
  }
};

msq_context* make_context(msq_parallel_for_fn parallel_for = nullptr) {
  msq_context_def def;
  assert_ok(msq_context_def_init(&def, sizeof def));
  def.threads = 4;
  def.parallel_for = parallel_for;
  def.warning = [](void*, int32_t, const char*) { throw std::runtime_error("dropped"); };
  msq_context* made = nullptr;
  assert_ok(msq_context_create(&def, &made));
  return made;
}

void objects(void**) {
  const Stage stage(make_context());
  const double point[3] = {1.2, 1.3, 1.4};
  assert_stops([&] {
    int32_t inside = 0;
    return msq_point_membership(stage.model, point, nullptr, &inside);
  });
  assert_stops([&] {
    std::vector<uint8_t> layer(1 << 16);
    msq_slicer_report report{};
    report.struct_size = sizeof report;
    assert_ok(msq_slicer_info(stage.slicer, &report));
    return msq_slice_layer(stage.slicer, 3, layer.data(), report.layer_bytes, nullptr);
  });
  // What release throws is dropped.
  msq_host_field_def of;
  assert_ok(msq_host_field_def_init(&of, sizeof of));
  of.low = 0;
  of.high = 1;
  of.evaluate = [](void*, const double*, uint64_t, double*) -> int32_t { return 0; };
  of.release = [](void*) { throw std::runtime_error("dropped"); };
  msq_field* field = nullptr;
  assert_ok(msq_field_host(stage.context, &of, &field));
  msq_field_release(field);
}

void results(void**) {
  const Stage stage(make_context());
  assert_stops([&] {
    return msq_slicer_run(
        stage.plain_slicer, 0, 8,
        [](void*, const msq_layer* layer) -> int32_t {
          if (layer->index == 2) throw_if_wanted();
          return 0;
        },
        nullptr, nullptr);
  });
  assert_stops([&] {
    msq_printability_report report{};
    report.struct_size = sizeof report;
    msq_printability_def def;
    assert_ok(msq_printability_def_init(&def, sizeof def));
    def.has_plate = 0;
    return msq_printability(
        stage.plain_slicer, &def,
        [](void*, const msq_finding*, uint64_t) -> int32_t {
          throw_if_wanted();
          return 0;
        },
        nullptr, &report, nullptr);
  });
  assert_stops([&] {
    msq_surface_def def;
    assert_ok(msq_surface_def_init(&def, sizeof def));
    def.pitch = 0.5;
    return msq_surface_mesh(
        stage.plain, &def,
        [](void*, const msq_surface_slab*) -> int32_t {
          throw_if_wanted();
          return 0;
        },
        nullptr, nullptr);
  });
  assert_stops([&] {
    msq_struts_def def;
    assert_ok(msq_struts_def_init(&def, sizeof def));
    for (double& max : def.max) max = 2;
    return msq_structure_struts(
        stage.context, stage.cubic, &def,
        [](void*, const msq_strut*, uint64_t) -> int32_t {
          throw_if_wanted();
          return 0;
        },
        nullptr, nullptr);
  });
}

void loops(void**) {
  const Stage stage(make_context([](void*, uint64_t count, msq_task_fn body, void* task) {
    throw_if_wanted();
    for (uint64_t i = 0; i < count; ++i) body(task, i);
    return int32_t{0};
  }));
  assert_stops([&] {
    return msq_slicer_run(
        stage.plain_slicer, 0, 8, [](void*, const msq_layer*) { return int32_t{0}; }, nullptr,
        nullptr);
  });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(objects),
      cmocka_unit_test(results),
      cmocka_unit_test(loops),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

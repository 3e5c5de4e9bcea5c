// SPDX-License-Identifier: Apache-2.0
// Threads of hosts of every sort, on contexts that they share and on their own: each gets the
// results that one thread gets. It sees msq as a host does, and hands all that threads tell each
// other through atomics and joins, which ThreadSanitizer sees.
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

extern "C" {
#include <cmocka.h>
}

#include "msq.h"

namespace {

/// Threads of the heavy tests: 64, or fewer as MSQ_TEST_SCALE says, but at least 32.
size_t thread_count() {
  const char* scale = std::getenv("MSQ_TEST_SCALE");
  const double part = scale ? std::atof(scale) : 1;
  return part >= 1 ? 64 : std::max<size_t>(32, static_cast<size_t>(64 * part));
}

void check(msq_status status) {
  if (status == MSQ_OK) return;
  print_error("%s: %s\n", msq_status_name(status), msq_error_message());
  std::abort();
}

/// FNV-1a of everything that a thread was told.
class Digest {
 public:
  void add(const void* data, size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < bytes; ++i) hash_ = (hash_ ^ byte[i]) * 0x100000001b3;
  }
  uint64_t get() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325;
};

msq_context* make_context(uint32_t threads, msq_parallel_for_fn parallel_for = nullptr) {
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  def.beyond_cores = 1;
  def.cache_bytes = 1 << 20;  // cells are evicted
  def.parallel_for = parallel_for;
  msq_context* context;
  check(msq_context_create(&def, &context));
  return context;
}

/// One model of each kind of structure, in a mesh with a skin or a box.
struct Models {
  explicit Models(msq_context* context) {
    const double vertices[12] = {-1.5, -1.5, -1.5, 2.5, -1.4, -1.3, -1.2, 2.5, -1.1, -1.4, -1, 2.4};
    const uint32_t triangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    msq_mesh_def mesh;
    check(msq_mesh_def_init(&mesh, sizeof mesh));
    mesh.vertices = vertices;
    mesh.vertex_count = 4;
    mesh.triangles = triangles;
    mesh.triangle_count = 4;
    msq_shape* part;
    check(msq_shape_from_mesh(context, &mesh, &part));
    const double from[3] = {-1, 0, 0}, to[3] = {1, 1, 0};
    msq_field* field;
    check(msq_field_gradient(context, from, 0.08, to, 0.2, &field));

    msq_lattice_def lattice;
    check(msq_lattice_def_init(&lattice, sizeof lattice));
    lattice.radius.field = field;
    add(context, part, 0.1,
        [&](msq_structure** s) { return msq_structure_lattice(context, &lattice, s); });
    for (const int32_t method : {MSQ_FOAM_AUTO, MSQ_FOAM_METHOD_1}) {
      msq_foam_def foam;
      check(msq_foam_def_init(&foam, sizeof foam));
      foam.method = method;
      foam.radius.value = 0.12;
      if (method == MSQ_FOAM_AUTO) foam.wall_thickness.value = 0.05;
      add(context, part, 0,
          [&](msq_structure** s) { return msq_structure_foam(context, &foam, s); });
    }
    msq_functional_def functional;
    check(msq_functional_def_init(&functional, sizeof functional));
    functional.kind = MSQ_FUNCTIONAL_SHEET;
    functional.thickness.value = 0.15;
    add(context, part, 0.1,
        [&](msq_structure** s) { return msq_structure_functional(context, &functional, s); });
    const double nodes[9] = {-1, -1, -1, 1, 0.5, 0, 0, 1, 1};
    const uint32_t ends[6] = {0, 1, 1, 2, 2, 0};
    msq_beams_def beams;
    check(msq_beams_def_init(&beams, sizeof beams));
    beams.nodes = nodes;
    beams.node_count = 3;
    beams.beams = ends;
    beams.beam_count = 3;
    beams.radius = 0.2;
    add(context, part, 0,
        [&](msq_structure** s) { return msq_structure_beams(context, &beams, s, nullptr); });
    msq_field_release(field);
    msq_shape_release(part);
  }
  Models(const Models&) = delete;
  Models& operator=(const Models&) = delete;
  ~Models() {
    for (msq_model* model : list) msq_model_release(model);
  }

  template <class Make>
  void add(msq_context* context, msq_shape* part, double skin, const Make& make) {
    msq_structure* structure;
    check(make(&structure));
    msq_scale_def scales[2] = {};
    scales[0].shape = part;
    scales[1].structure = structure;
    scales[1].skin.value = skin;
    msq_model_def def;
    check(msq_model_def_init(&def, sizeof def));
    def.scales = scales;
    def.scale_count = 2;
    msq_model* model;
    check(msq_model_create(context, &def, &model));
    msq_structure_release(structure);
    list.push_back(model);
  }

  std::vector<msq_model*> list;
};

/// What one thread does with a model: every kind of call that computes, and one that fails.
void ask(const msq_model* model, Digest* digest) {
  double point[3], distance;
  int32_t inside = 0;
  if (msq_point_membership(model, nullptr, nullptr, &inside) != MSQ_E_ARGUMENT) std::abort();
  if (!std::strstr(msq_error_message(), "point")) std::abort();
  for (int i = 0; i < 20; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = std::fmod(0.37 * i + 0.71 * axis * i, 2.8) - 1.4;
    check(msq_point_membership(model, point, nullptr, &inside));
    check(msq_point_distance(model, point, nullptr, &distance));
    digest->add(&inside, sizeof inside);
    digest->add(&distance, sizeof distance);
  }
  msq_points_def grid;
  check(msq_points_def_init(&grid, sizeof grid));
  grid.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = -1.4;
    grid.spacing[axis] = 0.28;
    grid.counts[axis] = 10;
  }
  std::vector<uint8_t> set(1000);
  check(msq_set_membership(model, &grid, nullptr, set.data(), set.size(), nullptr));
  digest->add(set.data(), set.size());

  msq_rays_def rays;
  check(msq_rays_def_init(&rays, sizeof rays));
  double origins[24], directions[24];
  for (int i = 0; i < 24; ++i) {
    origins[i] = i % 3 == 2 ? -3 : 0.3 * (i % 5) - 0.6;
    directions[i] = i % 3 == 2 ? 1 : 0.05 * (i % 4);
  }
  rays.count = 8;
  rays.origins = origins;
  rays.directions = directions;
  msq_ray_hit hits[8];
  check(msq_ray_cast(model, &rays, nullptr, hits, 8, nullptr));
  for (const msq_ray_hit& hit : hits) digest->add(&hit.t, sizeof hit.t);

  msq_slicer_def def;
  check(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = def.pitch[1] = 0.15;
  def.layer_height = 0.5;
  def.slab_layers = 2;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &def, &slicer));
  check(msq_slicer_run(
      slicer, 0, UINT64_MAX,
      [](void* user, const msq_layer* layer) -> int32_t {
        static_cast<Digest*>(user)->add(layer->data, layer->stride * layer->height);
        return 0;
      },
      digest, nullptr));
  msq_slicer_report plan{};
  plan.struct_size = sizeof plan;
  check(msq_slicer_info(slicer, &plan));
  std::vector<uint8_t> layer(plan.layer_bytes);
  check(msq_slice_layer(slicer, plan.layer_count / 2, layer.data(), layer.size(), nullptr));
  digest->add(layer.data(), layer.size());
  msq_slicer_release(slicer);

  msq_contours_def contours_def;
  check(msq_contours_def_init(&contours_def, sizeof contours_def));
  contours_def.tolerance = 0.02;
  contours_def.pitch = 0.15;
  msq_contours* contours;
  check(msq_layer_contours(model, 0.1, &contours_def, &contours, nullptr));
  msq_contours_report rings{};
  rings.struct_size = sizeof rings;
  check(msq_contours_info(contours, &rings));
  digest->add(rings.points, 2 * sizeof(double) * rings.point_count);
  msq_contours_release(contours);
}

uint64_t ask_all(const Models& models) {
  Digest digest;
  for (const msq_model* model : models.list) ask(model, &digest);
  return digest.get();
}

uint64_t ask_own(uint32_t threads, msq_parallel_for_fn parallel_for = nullptr) {
  msq_context* context = make_context(threads, parallel_for);
  const Models models(context);
  msq_context_release(context);  // the models keep it
  return ask_all(models);
}

uint64_t expected() {
  static const uint64_t hash = ask_own(1);
  return hash;
}

/// Runs body(i) on as many threads as there are parts.
template <class Body>
void on_threads(size_t count, const Body& body) {
  std::vector<std::thread> threads;
  for (size_t i = 0; i < count; ++i) threads.emplace_back([&body, i] { body(i); });
  for (std::thread& thread : threads) thread.join();
}

void test_shared_context(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(0);
  const Models models(context);
  std::atomic<int> wrong{0};
  on_threads(thread_count(), [&](size_t i) {
    wrong += ask_all(models) != hash;
    // Handles come and go, and the cache is cleared, while others use them.
    msq_model* model = models.list[i % models.list.size()];
    msq_model_retain(model);
    msq_model_release(model);
    if (i % 4 == 0) check(msq_cache_clear(context));
    msq_cache_report report{};
    report.struct_size = sizeof report;
    check(msq_cache_stats(context, &report));
  });
  msq_context_release(context);
  assert_int_equal(wrong, 0);
}

void test_own_contexts(void**) {
  const uint64_t hash = expected();
  std::atomic<int> wrong{0};
  on_threads(thread_count() / 4, [&](size_t i) { wrong += ask_own(i % 2 ? 1 : 8) != hash; });
  assert_int_equal(wrong, 0);
}

/// As a host with a pool would: half of the tasks on another thread.
int32_t two_threads(void*, uint64_t count, msq_task_fn body, void* task) {
  std::thread other([=] {
    for (uint64_t i = 1; i < count; i += 2) body(task, i);
  });
  for (uint64_t i = 0; i < count; i += 2) body(task, i);
  other.join();
  return 0;
}

void test_host_parallel_for(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(4, two_threads);
  const Models models(context);
  std::atomic<int> wrong{0};
  on_threads(4, [&](size_t) { wrong += ask_all(models) != hash; });
  msq_context_release(context);
  assert_int_equal(wrong, 0);
}

void test_async(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(0);
  const Models models(context);
  std::vector<std::future<uint64_t>> results;
  for (size_t i = 0; i < thread_count() / 4; ++i)
    results.push_back(std::async(std::launch::async, [&] { return ask_all(models); }));
  for (std::future<uint64_t>& result : results) assert_true(result.get() == hash);
  msq_context_release(context);
}

void test_arena_of_host(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(0);
  const Models models(context);
  std::atomic<int> wrong{0};
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::parallel_for(0, static_cast<int>(thread_count() / 4),
                      [&](int) { wrong += ask_all(models) != hash; });
  });
  msq_context_release(context);
  assert_int_equal(wrong, 0);
}

void test_openmp(void**) {
#ifdef _OPENMP
  const uint64_t hash = expected();
  msq_context* context = make_context(0);
  const Models models(context);
  // The library of OpenMP is not sanitized: what the threads tell is in atomics, and they say when
  // they are done.
  std::atomic<int> wrong{0}, done{0}, started{0};
#pragma omp parallel num_threads(4)
  {
    ++started;
    wrong += ask_all(models) != hash;
    ++done;
  }
  while (done.load() < started.load()) std::this_thread::yield();
  msq_context_release(context);
  assert_int_equal(wrong, 0);
  assert_true(started >= 1);
#else
  skip();
#endif
}

void test_cancel_from_outside(void**) {
  msq_context* context = make_context(0);
  const Models models(context);
  msq_context_release(context);
  on_threads(8, [&](size_t i) {
    msq_job* job;
    check(msq_job_create(&job));
    std::thread canceller([&] {
      double fraction = 0;
      while (fraction < 0.2) {
        check(msq_job_progress(job, &fraction));
        std::this_thread::yield();
        if (i % 2) break;
      }
      check(msq_job_cancel(job));
    });
    msq_slicer_def def;
    check(msq_slicer_def_init(&def, sizeof def));
    def.pitch[0] = def.pitch[1] = 0.05;
    def.layer_height = 0.1;
    def.slab_layers = 1;
    msq_slicer* slicer;
    check(msq_slicer_create(models.list[i % models.list.size()], &def, &slicer));
    const msq_status status = msq_slicer_run(
        slicer, 0, UINT64_MAX, [](void*, const msq_layer*) -> int32_t { return 0; }, nullptr, job);
    if (status != MSQ_E_CANCELLED) check(status);
    canceller.join();
    msq_slicer_release(slicer);
    msq_job_release(job);
  });
}

void test_fork(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(0);
  const Models models(context);
  assert_true(ask_all(models) == hash);  // threads of msq have begun
  for (const uint32_t threads : {1u, 0u}) {
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
      // In the child there is this thread alone. Objects of before serve, and new ones.
      const bool is_right = ask_all(models) == hash && ask_own(threads) == hash;
      _exit(is_right ? 0 : 1);
    }
    int status = -1;
    assert_true(waitpid(child, &status, 0) == child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
  }
  assert_true(ask_all(models) == hash);
  msq_context_release(context);
}

void test_threads_come_and_go(void**) {
  const uint64_t hash = expected();
  msq_context* context = make_context(2);
  const Models models(context);
  msq_context_release(context);
  for (int i = 0; i < 10; ++i) {
    uint64_t result = 0;
    std::thread([&] { result = ask_all(models); }).join();
    assert_true(result == hash);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_shared_context),      cmocka_unit_test(test_own_contexts),
      cmocka_unit_test(test_host_parallel_for),   cmocka_unit_test(test_async),
      cmocka_unit_test(test_arena_of_host),       cmocka_unit_test(test_openmp),
      cmocka_unit_test(test_cancel_from_outside), cmocka_unit_test(test_fork),
      cmocka_unit_test(test_threads_come_and_go)};
  return cmocka_run_group_tests_name("host_threads", tests, nullptr, nullptr);
}

// SPDX-License-Identifier: Apache-2.0
// Where no thread can be started, calls do their work on the thread that made them.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

#include "suite.h"
#include "world.h"

namespace {

std::atomic<bool> fails{false};
std::atomic<int> refused{0};

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (!fails) return create(thread, attributes, start, argument);
  ++refused;
  return EAGAIN;
}

namespace {

using namespace msq::test;

struct Answers {
  std::vector<uint8_t> inside = std::vector<uint8_t>(8000), layers;
};

Answers ask(uint32_t threads) {
  Stage stage;
  stage.threads = threads;
  World world(stage);
  const msq_model* model = world.model(world.box(), kinds()[4].make(world));
  Answers answers;
  const msq_points_def points = grid_of(20);
  assert_ok(msq_set_membership(model, &points, nullptr, answers.inside.data(),
                               answers.inside.size(), nullptr));
  const msq_slicer* slicer = world.slicer(model);
  assert_ok(msq_slicer_run(
      slicer, 0, UINT64_MAX,
      [](void* user, const msq_layer* layer) -> int32_t {
        auto& layers = *static_cast<std::vector<uint8_t>*>(user);
        layers.insert(layers.end(), layer->data, layer->data + layer->stride * layer->height);
        return 0;
      },
      &answers.layers, nullptr));
  return answers;
}

void test_no_threads(void**) {
  const Answers expected = ask(1);
  fails = true;
  for (int i = 0; i < 3; ++i) {
    const Answers answers = ask(0);
    assert_true(answers.inside == expected.inside);
    assert_true(answers.layers == expected.layers);
  }
  fails = false;
  const Answers answers = ask(0);
  assert_true(answers.inside == expected.inside);
  print_message("%d threads were refused\n", refused.load());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_no_threads)};
  return cmocka_run_group_tests_name("no_threads", tests, nullptr, nullptr);
}

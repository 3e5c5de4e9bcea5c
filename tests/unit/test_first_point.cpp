// SPDX-License-Identifier: Apache-2.0
// The first point of a set that a condition holds for: on one thread and many, wherever it is.
#include "query/first_point.h"

#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Point i is (i, 0, 0).
class Numbers final : public PointSet {
 public:
  explicit Numbers(uint64_t count) : count_(count) {}
  uint64_t count() const override { return count_; }
  void read(uint64_t first, uint64_t count, Vec3* out) const override {
    assert_true(first + count <= count_);
    for (uint64_t i = 0; i < count; ++i) out[i] = {static_cast<double>(first + i), 0, 0};
  }
  void gather(uint64_t, std::span<const uint32_t>, Vec3*) const override {}
  uint64_t parts() const override { return 0; }
  void read_part(uint64_t, Part&) const override {}
  bool is_compact() const override { return true; }

 private:
  uint64_t count_;
};

void test_first_point(void**) {
  Random random(5);
  for (const unsigned threads : {1, 4}) {
    const Executor executor(threads, true);
    for (const uint64_t count : {0, 1, 255, 256, 257, 65535, 65536, 65537, 300000}) {
      const Numbers points(count);
      assert_int_equal(find_first_point(points, executor, [](Vec3) { return false; }), count);
      for (int n = 0; n < 40 && count > 0; ++n) {
        // At any number and at its ends, followed by others.
        const uint64_t first = n == 0 ? 0 : n == 1 ? count - 1 : random.below(count);
        const double from = static_cast<double>(first);
        const double apart = std::exp2(random.between(0, 17));
        const auto holds = [&](Vec3 p) {
          return p.x >= from && std::fmod(p.x - from, std::floor(apart)) == 0;
        };
        assert_int_equal(find_first_point(points, executor, holds), first);
      }
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_first_point)};
  return cmocka_run_group_tests_name("first_point", tests, nullptr, nullptr);
}

// SPDX-License-Identifier: Apache-2.0
// Integers of many bits: up to 128 against the compiler's, longer ones against identities.
#include "structure/foam/joints/wide_int.h"

#include <cmath>

#include "base/int128.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Numbers of all lengths; many are at the borders of words.
int64_t some_number(Random& random) {
  const auto bits = static_cast<int>(random.below(64));
  const auto power = int64_t{1} << std::min(bits, 62);
  switch (random.below(4)) {
    case 0:
      return power - 1;
    case 1:
      return -power;
    case 2:
      return random.below(2) ? INT64_MIN : 0;
    default:
      return static_cast<int64_t>(random.below(UINT64_MAX)) >> bits;
  }
}

Int128 number_of(const WideInt<4>& n) {
  Int128 sum = 0;
  for (size_t i = 4; i-- > 0;)
    sum = sum * (Int128{1} << 32) +
          (i == 3 ? Int128{static_cast<int32_t>(n.part[i])} : Int128{n.part[i]});
  return sum;
}

template <size_t n>
void assert_equal(const WideInt<n>& a, const WideInt<n>& b) {
  for (size_t i = 0; i < n; ++i) assert_int_equal(a.part[i], b.part[i]);
}

void test_up_to_128_bits(void**) {
  Random random(1);
  for (size_t i = 0; i < 1000 + test_count(100000); ++i) {
    const int64_t a = some_number(random), b = some_number(random);
    const WideInt<2> u(a), v(b);
    const WideInt<4> product = u * v;
    assert_true(number_of(product) == Int128{a} * b);
    assert_true(number_of(WideInt<4>(u)) == a);
    assert_true(number_of(WideInt<4>(a) + WideInt<4>(b)) == Int128{a} + b);
    assert_true(number_of(WideInt<4>(a) - WideInt<4>(b)) == Int128{a} - b);
    assert_true(number_of(-WideInt<4>(a)) == -Int128{a});
    const Int128 exact = Int128{a} * b;
    assert_int_equal(product.sign(), (exact > 0) - (exact < 0));
    const double value = static_cast<double>(exact);
    assert_true(std::abs(product.value() - value) <= 0x1p-50 * std::abs(value));
  }
}

/// (a + b) c = a c + b c, and (a - b) (a + b) = a a - b b, with 256 bits.
void test_longer(void**) {
  Random random(2);
  const auto some = [&] {
    const WideInt<4> n = WideInt<2>(some_number(random)) * WideInt<2>(some_number(random));
    return WideInt<6>(n);  // so that sums fit
  };
  for (size_t i = 0; i < 1000 + test_count(20000); ++i) {
    const WideInt<6> a = some(), b = some(), c = some();
    assert_equal((a + b) * c, a * c + b * c);
    assert_equal((a - b) * (a + b), a * a - b * b);
    assert_equal(a * b, b * a);
    assert_int_equal((a - a).sign(), 0);
    assert_int_equal((a * b).sign(), a.sign() * b.sign());
    assert_int_equal((-a).sign(), -a.sign());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_up_to_128_bits),
      cmocka_unit_test(test_longer),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

// SPDX-License-Identifier: Apache-2.0
// Integers of a fixed number of bits, for signs and quotients of exact sums of products.
//
// msq has GMP only together with CGAL, which is optional, and no other library of every build has
// such integers. These few operations need neither memory nor errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace msq {

/// A signed integer of 32 n bits in two's complement. Sums stay in n; products have the bits of
/// both factors. The caller sees to it that sums fit.
template <size_t n>
struct WideInt {
  uint32_t part[n];  // the lowest first

  WideInt() = default;
  /// n >= 2.
  explicit WideInt(int64_t number) {
    const auto bits = static_cast<uint64_t>(number);
    part[0] = static_cast<uint32_t>(bits);
    part[1] = static_cast<uint32_t>(bits >> 32);
    for (size_t i = 2; i < n; ++i) part[i] = number < 0 ? ~uint32_t{0} : 0;
  }
  /// Of fewer bits.
  template <size_t m>
  explicit WideInt(const WideInt<m>& of) {
    static_assert(m <= n);
    for (size_t i = 0; i < n; ++i)
      part[i] = i < m ? of.part[i] : of.is_negative() ? ~uint32_t{0} : 0;
  }

  bool is_negative() const { return part[n - 1] >> 31; }
  int sign() const {
    if (is_negative()) return -1;
    for (size_t i = 0; i < n; ++i)
      if (part[i] != 0) return 1;
    return 0;
  }
  WideInt operator-() const {
    WideInt result;
    uint64_t carry = 1;
    for (size_t i = 0; i < n; ++i) {
      carry += static_cast<uint32_t>(~part[i]);
      result.part[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    return result;
  }
  friend WideInt operator+(const WideInt& a, const WideInt& b) {
    WideInt result;
    uint64_t carry = 0;
    for (size_t i = 0; i < n; ++i) {
      carry += uint64_t{a.part[i]} + b.part[i];
      result.part[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    return result;
  }
  friend WideInt operator-(const WideInt& a, const WideInt& b) {
    WideInt result;
    uint64_t carry = 1;
    for (size_t i = 0; i < n; ++i) {
      carry += uint64_t{a.part[i]} + static_cast<uint32_t>(~b.part[i]);
      result.part[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    return result;
  }
  /// Off by at most 2^-50 of it.
  double value() const {
    if (is_negative()) return -(-*this).value();
    double sum = 0;
    for (size_t i = 0; i < n; ++i) sum += std::ldexp(double(part[i]), static_cast<int>(32 * i));
    return sum;
  }
};

template <size_t n, size_t m>
WideInt<n + m> operator*(const WideInt<n>& a, const WideInt<m>& b) {
  const bool a_negative = a.is_negative(), b_negative = b.is_negative();
  const WideInt<n> p = a_negative ? -a : a;
  const WideInt<m> q = b_negative ? -b : b;
  WideInt<n + m> result;
  for (size_t i = 0; i < n + m; ++i) result.part[i] = 0;
  for (size_t i = 0; i < n; ++i) {
    if (p.part[i] == 0) continue;
    uint64_t carry = 0;
    for (size_t k = 0; k < m; ++k) {
      carry += uint64_t{p.part[i]} * q.part[k] + result.part[i + k];
      result.part[i + k] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    result.part[i + m] = static_cast<uint32_t>(carry);
  }
  return a_negative != b_negative ? -result : result;
}

}  // namespace msq

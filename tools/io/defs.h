// SPDX-License-Identifier: Apache-2.0
// Definitions and reports of the C ABI, by the rules of struct_size in msq.h.
#pragma once

#include <cmath>
#include <cstring>

#include "error.h"

namespace msq_io {

/// Size that a struct had when it was first published. A struct that grows gets its old size here,
/// as a specialisation.
template <class T>
inline constexpr size_t first_size = sizeof(T);
constexpr size_t max_size = 4096;

template <class T>
void check_struct_size(size_t size, const char* name) {
  if (size < first_size<T> || size > max_size)
    fail(MSQ_E_ARGUMENT, "the struct_size of %s is %zu; it must be its sizeof, %zu to %zu", name,
         size, first_size<T>, max_size);
}

template <class Def>
void set_defaults(Def* def, size_t size, const Def& defaults, const char* name) {
  if (!def) fail(MSQ_E_ARGUMENT, "def is NULL");
  check_struct_size<Def>(size, name);
  std::memset(static_cast<void*>(def), 0, size);
  std::memcpy(static_cast<void*>(def), &defaults, size < sizeof defaults ? size : sizeof defaults);
  def->struct_size = static_cast<uint32_t>(size);
}

/// The definition of a host as this version knows it. NULL: the defaults.
template <class Def>
Def read_def(const Def* def, const Def& defaults, const char* name) {
  if (!def) return defaults;
  const size_t size = def->struct_size;
  check_struct_size<Def>(size, name);
  Def known = defaults;
  std::memcpy(static_cast<void*>(&known), def, size < sizeof known ? size : sizeof known);
  const auto* bytes = reinterpret_cast<const unsigned char*>(def);
  for (size_t i = sizeof known; i < size; ++i)
    if (bytes[i] != 0)
      fail(MSQ_E_ARGUMENT,
           "%s uses a field at byte %zu that this version of msq_io does not know (it knows %zu "
           "bytes)",
           name, i, sizeof known);
  return known;
}

template <class Report>
void write_report(Report* report, Report known, const char* name) {
  if (!report) fail(MSQ_E_ARGUMENT, "%s is NULL", name);
  const uint32_t size = report->struct_size;
  check_struct_size<Report>(size, name);
  known.struct_size = size;
  std::memset(static_cast<void*>(report), 0, size);
  std::memcpy(static_cast<void*>(report), &known, size < sizeof known ? size : sizeof known);
}

template <class T>
T& require(T* pointer, const char* name) {
  if (!pointer) fail(MSQ_E_ARGUMENT, "%s is NULL", name);
  return *pointer;
}

template <class Int>
Int require_range(Int value, Int low, Int high, const char* name) {
  if (value < low || value > high)
    fail(MSQ_E_ARGUMENT, "%s is %lld; it must be from %lld to %lld", name,
         static_cast<long long>(value), static_cast<long long>(low), static_cast<long long>(high));
  return value;
}

inline double require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    fail(MSQ_E_ARGUMENT, "%s is %s; it must be positive and finite", name, text_of(value).c_str());
  return value;
}

inline double require_not_negative(double value, const char* name) {
  if (!(value >= 0) || !std::isfinite(value))
    fail(MSQ_E_ARGUMENT, "%s is %s; it must be finite and not negative", name,
         text_of(value).c_str());
  return value;
}

}  // namespace msq_io

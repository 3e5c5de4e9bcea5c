// SPDX-License-Identifier: Apache-2.0
// What every entry of the C ABI goes through: no exception gets out, the last failure of the thread
// is kept, handles are the engine's objects.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <new>

#include "base/attributes.h"
#include "base/call.h"
#include "base/checked.h"
#include "base/job.h"
#include "base/ref.h"
#include "base/status.h"
#include "base/vec.h"
#include "cell/context.h"
#include "field/field.h"
#include "fill/fill.h"
#include "model/model.h"
#include "msq.h"
#include "query/point_array.h"
#include "shape/shape.h"
#include "slice/contours.h"
#include "slice/slicer.h"
#include "structure/structure.h"

namespace msq::api {

/// Records a failure of this thread and returns its status (last_error.cpp).
msq_status record(Status status, const char* message, int32_t host_code) noexcept;

/// Calls a function where the compiler moves no arithmetic out of it.
template <class Body>
MSQ_NOINLINE void call_apart(Body& body) {
  body();
}

/// Runs an entry's body, in msq's floating-point environment. All failures come as exceptions.
template <class Body>
msq_status guard(Body&& body) noexcept {
  const CallScope scope;
  try {
    call_apart(body);
    return MSQ_OK;
  } catch (const Error& error) {
    return record(error.status, error.what(), error.host_code);
  } catch (const std::bad_alloc&) {
    return record(Status::memory, "out of memory", 0);
  } catch (const std::length_error&) {
    return record(Status::memory, "out of memory", 0);
  } catch (const std::exception& error) {
    return record(Status::internal, error.what(), 0);
  } catch (...) {
    return record(Status::internal, "unknown exception", 0);
  }
}

/// Throws Error(argument) if a pointer is NULL.
template <class T>
T& require(T* pointer, const char* name) {
  if (!pointer) fail(Status::argument, "%s is NULL", name);
  return *pointer;
}

inline void require_reserved(uint64_t value, const char* name) {
  if (value != 0)
    fail(Status::argument, "%s is %llu; it must be 0", name,
         static_cast<unsigned long long>(value));
}

inline double require_finite(double value, const char* name) {
  if (!std::isfinite(value)) fail(Status::argument, "%s is %g; it must be finite", name, value);
  return value;
}

inline double require_not_negative(double value, const char* name) {
  if (!(value >= 0) || !std::isfinite(value))
    fail(Status::argument, "%s is %g; it must be finite and not negative", name, value);
  return value;
}

/// Infinity is allowed.
inline double require_zero_or_more(double value, const char* name) {
  if (!(value >= 0)) fail(Status::argument, "%s is %g; it must be 0 or more", name, value);
  return value;
}

inline double require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    fail(Status::argument, "%s is %g; it must be positive and finite", name, value);
  return value;
}

inline int32_t require_range(int32_t value, int32_t low, int32_t high, const char* name) {
  if (value < low || value > high)
    fail(Status::argument, "%s is %d; it must be from %d to %d", name, value, low, high);
  return value;
}

inline Vec3 require_vector(const double* v, const char* name) {
  if (!v) fail(Status::argument, "%s is NULL", name);
  if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
    fail(Status::argument, "%s is (%g, %g, %g); it must be finite", name, v[0], v[1], v[2]);
  return {v[0], v[1], v[2]};
}

/// The host's coordinates. Throws Error(argument) where they make no sense.
inline PointArray point_array(const void* data, uint64_t count, uint64_t stride, int32_t type,
                              const char* name) {
  PointArray points;
  points.is_float32 =
      require_range(type, MSQ_FLOAT32, MSQ_FLOAT64, "coordinate_type") == MSQ_FLOAT32;
  const uint64_t packed = 3 * (points.is_float32 ? sizeof(float) : sizeof(double));
  if (stride != 0 && stride < packed)
    fail(Status::argument, "the stride of %s is %llu bytes; a point has %llu", name,
         static_cast<unsigned long long>(stride), static_cast<unsigned long long>(packed));
  if (count > 0 && !data) fail(Status::argument, "%s is NULL", name);
  points.data = static_cast<const unsigned char*>(data);
  points.count = count;
  points.stride = stride ? stride : packed;
  checked_product(count, points.stride, name);
  return points;
}

/// Throws Error(argument) if an output overlaps an array that the call reads.
void require_apart(const void* input, uint64_t input_bytes, const char* input_name,
                   const void* output, uint64_t bytes, const char* name);
inline void require_apart(const PointArray& points, const char* points_name, const void* output,
                          uint64_t bytes, const char* name) {
  if (points.count == 0) return;
  const uint64_t packed = 3 * (points.is_float32 ? sizeof(float) : sizeof(double));
  require_apart(points.data, (points.count - 1) * points.stride + packed, points_name, output,
                bytes, name);
}

/// Size that a struct of the ABI had when it was first published. A struct that grows gets its old
/// size here, as a specialisation; less was never right, such as the size of a pointer to it.
template <class T>
inline constexpr size_t first_size = sizeof(T);
template <>
inline constexpr size_t first_size<msq_context_def> = offsetof(msq_context_def, cache_policy);
template <>
inline constexpr size_t first_size<msq_build_report> = offsetof(msq_build_report, with_xxhash);
template <>
inline constexpr size_t first_size<msq_host_shape_def> = offsetof(msq_host_shape_def, hash_key);
template <>
inline constexpr size_t first_size<msq_host_field_def> = offsetof(msq_host_field_def, hash_key);
template <>
inline constexpr size_t first_size<msq_host_structure_def> = offsetof(msq_host_structure_def,
                                                                      hash_key);
template <>
inline constexpr size_t first_size<msq_host_function_def> = offsetof(msq_host_function_def,
                                                                     hash_key);
template <>
inline constexpr size_t first_size<msq_cache_report> = offsetof(msq_cache_report, building_bytes);
template <>
inline constexpr size_t first_size<msq_contours_def> = offsetof(msq_contours_def, topology_samples);
template <>
inline constexpr size_t first_size<msq_contours_report> = offsetof(msq_contours_report,
                                                                   topology_count);
template <>
inline constexpr size_t first_size<msq_printability_def> = offsetof(msq_printability_def, overhang);
template <>
inline constexpr size_t first_size<msq_printability_report> = offsetof(msq_printability_report,
                                                                       cup_count);
template <>
inline constexpr size_t first_size<msq_foam_def> = offsetof(msq_foam_def, density);
template <>
inline constexpr size_t first_size<msq_functional_def> = offsetof(msq_functional_def, period);
template <>
inline constexpr size_t first_size<msq_lattice_def> = offsetof(msq_lattice_def, strut_factors);
template <>
inline constexpr size_t first_size<msq_query_def> = offsetof(msq_query_def, critical_count);
template <>
inline constexpr size_t first_size<msq_points_def> = offsetof(msq_points_def, seed);
template <>
inline constexpr size_t first_size<msq_slicer_def> = offsetof(msq_slicer_def, window);
template <>
inline constexpr size_t first_size<msq_output_def> = offsetof(msq_output_def, channel);
template <>
inline constexpr size_t first_size<msq_slicer_report> = offsetof(msq_slicer_report, window);
template <>
inline constexpr size_t first_size<msq_warp_def> = offsetof(msq_warp_def, u);
template <>
inline constexpr size_t first_size<msq_fill_def> = offsetof(msq_fill_def, corner_distance);
/// More is a struct_size that was never set.
constexpr size_t max_size = 4096;

template <class T>
void check_struct_size(size_t size, const char* name) {
  if (size < first_size<T> || size > max_size)
    fail(Status::argument, "the struct_size of %s is %zu; it must be its sizeof, %zu to %zu", name,
         size, first_size<T>, max_size);
}

/// Fills in a host's definition: defaults in what it has room for, 0 in what this version does not
/// know.
template <class Def>
void set_defaults(Def* def, size_t size, const Def& defaults, const char* name) {
  if (!def) fail(Status::argument, "def is NULL");
  check_struct_size<Def>(size, name);
  std::memset(static_cast<void*>(def), 0, size);
  std::memcpy(static_cast<void*>(def), &defaults, size < sizeof defaults ? size : sizeof defaults);
  def->struct_size = static_cast<uint32_t>(size);
}

/// A host's definition as this version knows it: what an older host lacks has its default, what a
/// newer one adds must be 0.
template <class Def>
Def read_def(const Def* def, const Def& defaults, const char* name) {
  if (!def) fail(Status::argument, "%s is NULL", name);
  const size_t size = def->struct_size;
  check_struct_size<Def>(size, name);
  Def known = defaults;
  std::memcpy(static_cast<void*>(&known), def, size < sizeof known ? size : sizeof known);
  const auto* bytes = reinterpret_cast<const unsigned char*>(def);
  for (size_t i = sizeof known; i < size; ++i)
    if (bytes[i] != 0)
      fail(
          Status::argument,
          "%s uses a field at byte %zu that this version of msq does not know (it knows %zu bytes)",
          name, i, sizeof known);
  return known;
}

/// Copies a report to the host, as much as its struct_size says; what this version does not know is
/// 0.
template <class Report>
void write_report(Report* report, Report known, const char* name) {
  if (!report) fail(Status::argument, "%s is NULL", name);
  const uint32_t size = report->struct_size;
  check_struct_size<Report>(size, name);
  known.struct_size = size;
  std::memset(static_cast<void*>(report), 0, size);
  std::memcpy(static_cast<void*>(report), &known, size < sizeof known ? size : sizeof known);
}

/// A handle is a pointer to its engine object. Specialised below for each handle.
template <class Handle>
struct ObjectOf;
template <class Handle>
struct ObjectOf<const Handle> {
  using type = const typename ObjectOf<Handle>::type;
};

template <class Handle>
typename ObjectOf<Handle>::type& object(Handle* handle, const char* name) {
  if (!handle) fail(Status::argument, "%s is NULL", name);
  return *reinterpret_cast<typename ObjectOf<Handle>::type*>(handle);
}

/// A new handle, to store in the host's variable once nothing can fail any more.
template <class Handle>
Handle* new_handle(Ref<typename ObjectOf<Handle>::type> ref) {
  return reinterpret_cast<Handle*>(ref.detach());
}

template <class Handle>
void retain(Handle* handle) {
  if (handle) reinterpret_cast<typename ObjectOf<Handle>::type*>(handle)->retain();
}

template <class Handle>
void release(Handle* handle) {
  if (!handle) return;
  const CallScope scope;
  reinterpret_cast<typename ObjectOf<Handle>::type*>(handle)->release();
}

template <>
struct ObjectOf<msq_context> {
  using type = Context;
};
template <>
struct ObjectOf<msq_job> {
  using type = Job;
};
template <>
struct ObjectOf<msq_shape> {
  using type = Shape;
};
template <>
struct ObjectOf<msq_field> {
  using type = Field;
};
template <>
struct ObjectOf<msq_structure> {
  using type = Structure;
};
template <>
struct ObjectOf<msq_material> {
  using type = Material;
};
template <>
struct ObjectOf<msq_model> {
  using type = Model;
};
template <>
struct ObjectOf<msq_fill> {
  using type = Fill;
};
template <>
struct ObjectOf<msq_slicer> {
  using type = Slicer;
};
template <>
struct ObjectOf<msq_contours> {
  using type = Contours;
};

}  // namespace msq::api

// SPDX-License-Identifier: Apache-2.0
/// @file
/// msq for C++17: handles that release themselves, statuses as exceptions, callbacks as lambdas.
///
/// The header adds nothing to msq.h but convenience, and msq.h documents what each function does,
/// its units and its errors. One file, without a library of its own, so that a host can copy it.
/// All classes are thin: a handle is one pointer, and copying it adds a reference.
///
/// Errors. A function that fails throws msq::Error, or msq::Cancelled if the job was cancelled.
/// Arrays whose lengths do not fit throw std::invalid_argument.
///
/// Callbacks. A callback is anything that can be called with the given arguments: a lambda, a
/// function, a std::function. It returns nothing, or an int32_t: 0 for success, another code to
/// stop the call, which then throws msq::Error with that host_code(). An exception that leaves a
/// callback stops the call of msq, which throws it again on the thread that called. Of more than
/// 65536 exceptions that wait for their calls to return, the oldest is lost, and its call throws
/// msq::Error. Only warnings must not throw: what they throw is dropped.
///
/// Threads. As in msq.h: handles may be shared; callbacks of objects with concurrent = 1 run on any
/// thread.
///
/// Definitions. msq::FoamDef and its like are the structs of msq.h with the defaults set.
#ifndef MSQ_HPP
#define MSQ_HPP

#include <msq.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace msq {
// The engine itself is in the namespace msq. The inline namespace keeps the names of the two apart
// where a host links a static msq.
inline namespace cpp {

// ---- Errors -------------------------------------------------------------------------------------

/// A call of msq failed. what() is the message, with the offending value and its limit.
class Error : public std::runtime_error {
 public:
  Error(msq_status status, int32_t host_code, const std::string& message)
      : std::runtime_error(std::string(msq_status_name(status)) + ": " + message),
        status_(status),
        host_code_(host_code) {}

  msq_status status() const noexcept { return status_; }
  /// With MSQ_E_HOST: the code that a callback returned; 0 if it returned an invalid value.
  int32_t host_code() const noexcept { return host_code_; }

 private:
  msq_status status_;
  int32_t host_code_;
};

/// The job of the call was cancelled.
class Cancelled : public Error {
 public:
  using Error::Error;
};

namespace detail {

/// Exceptions that left callbacks, each until the call of msq that it stops returns. A callback
/// returns the number of its exception as the host's code. Of callbacks that throw at the same time
/// in one call, one is thrown again, and nothing tells which others belong to that call. They stay
/// until max_kept exceptions wait, when the oldest gives way.
class Thrown {
 public:
  static constexpr size_t max_kept = 65536;

  /// Without memory the exception is lost, and check() throws Error with the code.
  static int32_t keep(std::exception_ptr exception) noexcept {
    std::exception_ptr oldest;  // freed without the lock: what it holds may call msq
    const std::lock_guard<std::mutex> lock(mutex());
    Waiting& waiting = exceptions();
    const uint64_t number = waiting.next++;
    try {
      waiting.kept.emplace_hint(waiting.kept.end(), number, std::move(exception));
    } catch (...) {
    }
    if (waiting.kept.size() > max_kept) {
      oldest = std::move(waiting.kept.begin()->second);
      waiting.kept.erase(waiting.kept.begin());
    }
    return first_code - static_cast<int32_t>(number % codes);
  }

  /// NULL if the code is not that of an exception.
  static std::exception_ptr take(int32_t code) noexcept {
    if (code > first_code) return nullptr;
    const std::lock_guard<std::mutex> lock(mutex());
    Waiting& waiting = exceptions();
    // The newest number with this code.
    const uint64_t back = (waiting.next - 1 - static_cast<uint64_t>(first_code - code)) % codes;
    const auto found = waiting.kept.find(waiting.next - 1 - back);
    if (found == waiting.kept.end()) return nullptr;
    std::exception_ptr exception = std::move(found->second);
    waiting.kept.erase(found);
    return exception;
  }

 private:
  struct Waiting {
    uint64_t next = 1;
    std::map<uint64_t, std::exception_ptr> kept;  // by number, so that the first is the oldest
  };
  static constexpr int32_t first_code = -(int32_t{1} << 30);
  static constexpr uint64_t codes = uint64_t{1} << 30;

  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static Waiting& exceptions() {
    static Waiting waiting;
    return waiting;
  }
};

/// The result of a callback for msq: 0, or the code that stops the call.
template <class F>
int32_t result_of(F&& function) noexcept {
  using Result = decltype(function());
  static_assert(std::is_void_v<Result> || std::is_same_v<Result, int32_t>,
                "a callback returns nothing, or an int32_t");
  try {
    if constexpr (std::is_void_v<Result>) {
      function();
      return 0;
    } else {
      return function();
    }
  } catch (...) {
    return Thrown::keep(std::current_exception());
  }
}

}  // namespace detail

/// Throws if a function of msq failed. For calls of msq.h beside this header.
inline void check(msq_status status) {
  if (status == MSQ_OK) return;
  int32_t code = 0;
  if (status == MSQ_E_HOST) {
    code = msq_error_host_code();
    if (std::exception_ptr thrown = detail::Thrown::take(code)) std::rethrow_exception(thrown);
  }
  if (status == MSQ_E_CANCELLED) throw Cancelled(status, code, msq_error_message());
  throw Error(status, code, msq_error_message());
}

// ---- Arrays, definitions, reports ---------------------------------------------------------------

/// A pointer and a count. Made from any container with data() and size(), which must outlive it.
template <class T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T* data, size_t size) : data_(data), size_(size) {}
  template <size_t N>
  constexpr Span(T (&array)[N]) : data_(array), size_(N) {}
  template <class Container,
            class = std::enable_if_t<std::is_convertible_v<
                std::remove_pointer_t<decltype(std::declval<Container&>().data())> (*)[], T (*)[]>>>
  constexpr Span(Container&& container) : data_(container.data()), size_(container.size()) {}

  constexpr T* data() const { return data_; }
  constexpr size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr T* begin() const { return data_; }
  constexpr T* end() const { return data_ + size_; }
  constexpr T& operator[](size_t i) const { return data_[i]; }

 private:
  T* data_ = nullptr;
  size_t size_ = 0;
};

using Vec3 = std::array<double, 3>;
/// 128 bits of a hash.
using Hash = std::array<uint8_t, 16>;

namespace detail {

template <class C, msq_status (*Init)(C*, size_t)>
struct Definition : C {
  Definition() : C() { check(Init(this, sizeof(C))); }
};

/// Fills in a report: call(report).
template <class Report, class Call>
Report report(Call&& call) {
  Report result{};
  result.struct_size = sizeof result;
  check(call(&result));
  return result;
}

/// How many groups of `each` an array has: "there are 4 coordinates; there must be 3 per point".
inline size_t groups(const char* function, size_t count, const char* what, size_t each,
                     const char* group) {
  if (count % each != 0)
    throw std::invalid_argument(std::string(function) + ": there are " + std::to_string(count) +
                                " " + what + "; there must be " + std::to_string(each) + " per " +
                                group);
  return count / each;
}

}  // namespace detail

using ContextDef = detail::Definition<msq_context_def, msq_context_def_init>;
using PeriodDef = detail::Definition<msq_period_def, msq_period_def_init>;
using WarpDef = detail::Definition<msq_warp_def, msq_warp_def_init>;
using FileDef = detail::Definition<msq_file_def, msq_file_def_init>;
using MeshDef = detail::Definition<msq_mesh_def, msq_mesh_def_init>;
using HostShapeDef = detail::Definition<msq_host_shape_def, msq_host_shape_def_init>;
using VoxelsDef = detail::Definition<msq_voxels_def, msq_voxels_def_init>;
using RadialFieldDef = detail::Definition<msq_radial_field_def, msq_radial_field_def_init>;
using HostFieldDef = detail::Definition<msq_host_field_def, msq_host_field_def_init>;
using GridFieldDef = detail::Definition<msq_grid_field_def, msq_grid_field_def_init>;
using ExpressionFieldDef =
    detail::Definition<msq_expression_field_def, msq_expression_field_def_init>;
using ShapeDistanceFieldDef =
    detail::Definition<msq_shape_distance_field_def, msq_shape_distance_field_def_init>;
using UnitCellDef = detail::Definition<msq_unit_cell_def, msq_unit_cell_def_init>;
using LatticeDef = detail::Definition<msq_lattice_def, msq_lattice_def_init>;
using PlateLatticeDef = detail::Definition<msq_plate_lattice_def, msq_plate_lattice_def_init>;
using FoamDef = detail::Definition<msq_foam_def, msq_foam_def_init>;
using FunctionalDef = detail::Definition<msq_functional_def, msq_functional_def_init>;
using WavesDef = detail::Definition<msq_waves_def, msq_waves_def_init>;
using BeamsDef = detail::Definition<msq_beams_def, msq_beams_def_init>;
using DocumentDef = detail::Definition<msq_document_def, msq_document_def_init>;
using JsonDef = detail::Definition<msq_json_def, msq_json_def_init>;
using HostStructureDef = detail::Definition<msq_host_structure_def, msq_host_structure_def_init>;
using HostFunctionDef = detail::Definition<msq_host_function_def, msq_host_function_def_init>;
using StrutsDef = detail::Definition<msq_struts_def, msq_struts_def_init>;
using MaterialDef = detail::Definition<msq_material_def, msq_material_def_init>;
using ModelDef = detail::Definition<msq_model_def, msq_model_def_init>;
using QueryDef = detail::Definition<msq_query_def, msq_query_def_init>;
using PointsDef = detail::Definition<msq_points_def, msq_points_def_init>;
using SegmentsDef = detail::Definition<msq_segments_def, msq_segments_def_init>;
using ContoursDef = detail::Definition<msq_contours_def, msq_contours_def_init>;
using OutputDef = detail::Definition<msq_output_def, msq_output_def_init>;
using SlicerDef = detail::Definition<msq_slicer_def, msq_slicer_def_init>;
using PrintabilityDef = detail::Definition<msq_printability_def, msq_printability_def_init>;
using FillDef = detail::Definition<msq_fill_def, msq_fill_def_init>;
using SurfaceDef = detail::Definition<msq_surface_def, msq_surface_def_init>;
using RaysDef = detail::Definition<msq_rays_def, msq_rays_def_init>;
using Camera = detail::Definition<msq_camera, msq_camera_init>;
using RenderDef = detail::Definition<msq_render_def, msq_render_def_init>;
using Frame = detail::Definition<msq_frame, msq_frame_init>;

/// Cells whose size varies along an axis of the grid: a size for each position. The arrays must
/// outlive the definition.
inline PeriodDef period(int32_t axis, Span<const double> positions, Span<const double> cell_sizes) {
  if (positions.size() != cell_sizes.size())
    throw std::invalid_argument("msq::period: there are " + std::to_string(positions.size()) +
                                " positions and " + std::to_string(cell_sizes.size()) +
                                " cell_sizes");
  PeriodDef def;
  def.axis = axis;
  def.positions = positions.data();
  def.cell_sizes = cell_sizes.data();
  def.count = positions.size();
  return def;
}

// ---- Sets of points -----------------------------------------------------------------------------

/// Triples x, y, z, which must outlive the definition.
inline PointsDef points(Span<const double> triples) {
  PointsDef def;
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinate_type = MSQ_FLOAT64;
  def.coordinates = triples.data();
  def.count = detail::groups("msq::points", triples.size(), "coordinates", 3, "point");
  return def;
}

/// The points origin + (i, j, k) * spacing, x fastest.
inline PointsDef grid(const Vec3& origin, const Vec3& spacing,
                      const std::array<uint64_t, 3>& counts) {
  PointsDef def;
  def.kind = MSQ_POINTS_GRID;
  for (size_t axis = 0; axis < 3; ++axis) {
    def.origin[axis] = origin[axis];
    def.spacing[axis] = spacing[axis];
    def.counts[axis] = counts[axis];
  }
  return def;
}

/// per_cell random points in each cell of a grid, see MSQ_POINTS_STRATIFIED.
inline PointsDef stratified(const Vec3& origin, const Vec3& spacing,
                            const std::array<uint64_t, 3>& counts, uint32_t per_cell,
                            uint64_t seed) {
  PointsDef def = grid(origin, spacing, counts);
  def.kind = MSQ_POINTS_STRATIFIED;
  def.per_cell = per_cell;
  def.seed = seed;
  return def;
}

/// The coordinates of points first to first + count - 1 of a set.
inline std::vector<double> generate(const msq_points_def& points, uint64_t first, uint64_t count) {
  std::vector<double> triples(3 * count);
  check(msq_points_generate(&points, first, count, triples.data()));
  return triples;
}

/// The ray through a position of a picture, in pixels: origin and direction.
inline std::pair<Vec3, Vec3> camera_ray(const Camera& camera, uint32_t width, uint32_t height,
                                        const std::array<double, 2>& position) {
  std::pair<Vec3, Vec3> ray{};
  check(
      msq_camera_ray(&camera, width, height, position.data(), ray.first.data(), ray.second.data()));
  return ray;
}

// ---- Library ------------------------------------------------------------------------------------

/// As MSQ_VERSION, of the loaded library.
inline uint32_t version() {
  return msq_version();
}

inline msq_build_report build_info() {
  return detail::report<msq_build_report>(msq_build_info);
}

/// The grid of a structure that moves with a part, see msq_neighbourhood_placed.
inline msq_neighbourhood placed(const msq_neighbourhood& grid,
                                const std::array<double, 12>& matrix) {
  msq_neighbourhood result;
  check(msq_neighbourhood_placed(&grid, matrix.data(), &result));
  return result;
}

// ---- Handles ------------------------------------------------------------------------------------

namespace detail {

/// One reference to an object of msq, or none.
template <class T, void (*Retain)(T*), void (*Release)(T*)>
class Handle {
 public:
  Handle() = default;
  Handle(const Handle& other) noexcept : object_(other.object_) { Retain(object_); }
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() { Release(object_); }

  /// The handle of msq.h, for calls beside this header. NULL if there is none.
  T* get() const noexcept { return object_; }
  explicit operator bool() const noexcept { return object_ != nullptr; }

 protected:
  /// Makes the object: create(&handle) returns a status.
  template <class Create>
  explicit Handle(std::in_place_t, Create&& create) {
    check(create(&object_));
  }
  /// Takes over a reference.
  explicit Handle(T* object) : object_(object) {}

 private:
  T* object_ = nullptr;
};

/// Makes an object with callbacks, which msq frees with the object: create(definition) returns a
/// status.
template <class Def, class Callbacks, class Create>
void give(Def& def, std::unique_ptr<Callbacks> callbacks, Create&& create) {
  def.user = callbacks.get();
  def.release = [](void* user) { delete static_cast<Callbacks*>(user); };
  check(create(&def));
  (void)callbacks.release();
}

/// A callback of one call, which outlives the call. Its address is the user pointer for msq. (That
/// of the callable would not do: a pointer to a function is no void*.)
template <class F>
struct Callback {
  F& function;

  template <class... Arguments>
  static int32_t call(void* user, Arguments... arguments) {
    return result_of([&] { return static_cast<Callback*>(user)->function(arguments...); });
  }
  /// The same for functions that take a struct by reference.
  template <class Struct>
  static int32_t call_with(void* user, const Struct* argument) {
    return result_of([&] { return static_cast<Callback*>(user)->function(*argument); });
  }
};

}  // namespace detail

/// Progress and cancellation of one long call. A call takes `Job()`, the default, for none.
class Job : public detail::Handle<msq_job, msq_job_retain, msq_job_release> {
 public:
  Job() = default;
  static Job create() { return Job(std::in_place); }

  void cancel() const { check(msq_job_cancel(get())); }
  /// 0 to 1.
  double progress() const {
    double fraction = 0;
    check(msq_job_progress(get(), &fraction));
    return fraction;
  }
  msq_job_report info() const {
    return detail::report<msq_job_report>([&](auto* r) { return msq_job_info(get(), r); });
  }

 private:
  explicit Job(std::in_place_t) : Handle(std::in_place, msq_job_create) {}
};

/// Receives warnings: code, an msq_warning_code, and message.
using WarningFn = std::function<void(int32_t code, const char* message)>;
/// Runs body(i) for each i below count, on any threads, and returns when all have returned.
using ParallelForFn =
    std::function<void(uint64_t count, const std::function<void(uint64_t i)>& body)>;

/// Threads, cell cache and memory limit that objects share.
class Context : public detail::Handle<msq_context, msq_context_retain, msq_context_release> {
 public:
  Context() : Context(ContextDef()) {}
  /// warning, parallel_for: NULL for none; kept as long as anything made in the context.
  explicit Context(ContextDef def, WarningFn warning = nullptr,
                   ParallelForFn parallel_for = nullptr)
      : Handle(std::in_place, [&](msq_context** made) {
          return create(def, std::move(warning), std::move(parallel_for), made);
        }) {}

  msq_memory_report memory() const {
    return detail::report<msq_memory_report>([&](auto* r) { return msq_context_memory(get(), r); });
  }
  msq_cache_report cache_stats() const {
    return detail::report<msq_cache_report>([&](auto* r) { return msq_cache_stats(get(), r); });
  }
  void clear_cache() const { check(msq_cache_clear(get())); }

 private:
  static msq_status create(ContextDef& def, WarningFn warning, ParallelForFn parallel_for,
                           msq_context** made) {
    std::unique_ptr<WarningFn> warns;
    std::unique_ptr<ParallelForFn> loops;
    if (warning) {
      warns = std::make_unique<WarningFn>(std::move(warning));
      def.warning = [](void* user, int32_t code, const char* message) {
        try {
          (*static_cast<WarningFn*>(user))(code, message);
        } catch (...) {
        }
      };
      def.warning_user = warns.get();
      def.warning_release = [](void* user) { delete static_cast<WarningFn*>(user); };
    }
    if (parallel_for) {
      loops = std::make_unique<ParallelForFn>(std::move(parallel_for));
      def.parallel_for = [](void* user, uint64_t count, msq_task_fn body, void* task) {
        return detail::result_of([&] {
          (*static_cast<ParallelForFn*>(user))(count, [=](uint64_t i) { body(task, i); });
        });
      };
      def.parallel_for_user = loops.get();
      def.parallel_for_release = [](void* user) { delete static_cast<ParallelForFn*>(user); };
    }
    const msq_status status = msq_context_create(&def, made);
    if (status == MSQ_OK) {
      (void)warns.release();
      (void)loops.release();
    }
    return status;
  }
};

// ---- Shapes -------------------------------------------------------------------------------------

/// inside[i] = 0 or 1 for point i of count triples.
using InsideFn = std::function<void(const double* points, uint64_t count, uint8_t* inside)>;
/// values[i] for point i of count triples.
using ValuesFn = std::function<void(const double* points, uint64_t count, double* values)>;
/// Bounds of all values in the box from min to max.
using RangeFn =
    std::function<void(const double* min, const double* max, double* low, double* high)>;

/// A coarse solid.
class Shape : public detail::Handle<msq_shape, msq_shape_retain, msq_shape_release> {
 public:
  Shape() = default;

  static Shape from_file(const Context& context, const std::string& path,
                         const FileDef& def = FileDef(), const Job& job = {}) {
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_from_file(context.get(), path.c_str(), &def, made, job.get());
    });
  }
  static Shape from_memory(const Context& context, Span<const uint8_t> bytes,
                           const FileDef& def = FileDef(), const Job& job = {}) {
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_from_memory(context.get(), bytes.data(), bytes.size(), &def, made,
                                   job.get());
    });
  }
  static Shape from_mesh(const Context& context, const MeshDef& def) {
    return Shape(std::in_place,
                 [&](auto** made) { return msq_shape_from_mesh(context.get(), &def, made); });
  }
  /// vertices: triples. triangles: triples of indices.
  static Shape from_mesh(const Context& context, Span<const double> vertices,
                         Span<const uint32_t> triangles) {
    return from_mesh(context, mesh(MSQ_FLOAT64, vertices.data(), vertices.size(), triangles));
  }
  static Shape from_mesh(const Context& context, Span<const float> vertices,
                         Span<const uint32_t> triangles) {
    return from_mesh(context, mesh(MSQ_FLOAT32, vertices.data(), vertices.size(), triangles));
  }
  static Shape box(const Context& context, const Vec3& min, const Vec3& max) {
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_from_box(context.get(), min.data(), max.data(), made);
    });
  }
  static Shape sphere(const Context& context, const Vec3& center, double radius) {
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_from_sphere(context.get(), center.data(), radius, made);
    });
  }
  static Shape cylinder(const Context& context, const Vec3& from, const Vec3& to, double radius) {
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_from_cylinder(context.get(), from.data(), to.data(), radius, made);
    });
  }
  static Shape all_space(const Context& context) {
    return Shape(std::in_place,
                 [&](auto** made) { return msq_shape_all_space(context.get(), made); });
  }
  static Shape voxels(const Context& context, const VoxelsDef& def) {
    return Shape(std::in_place,
                 [&](auto** made) { return msq_shape_from_voxels(context.get(), &def, made); });
  }
  /// def: bounds, concurrent, hash_key; distance may be NULL.
  static Shape host(const Context& context, HostShapeDef def, InsideFn inside,
                    ValuesFn distance = nullptr) {
    struct Callbacks {
      InsideFn inside;
      ValuesFn distance;
    };
    def.inside = [](void* user, const double* points, uint64_t count, uint8_t* into) {
      return detail::result_of([&] { static_cast<Callbacks*>(user)->inside(points, count, into); });
    };
    if (distance)
      def.distance = [](void* user, const double* points, uint64_t count, double* values) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->distance(points, count, values); });
      };
    msq_shape* made = nullptr;
    detail::give(def,
                 std::make_unique<Callbacks>(Callbacks{std::move(inside), std::move(distance)}),
                 [&](auto* d) { return msq_shape_from_host(context.get(), d, &made); });
    return Shape(made);
  }

  /// matrix: three rows of four.
  Shape placed(const std::array<double, 12>& matrix) const {
    return Shape(std::in_place,
                 [&](auto** made) { return msq_shape_placed(get(), matrix.data(), made); });
  }
  Shape offset(double distance) const {
    return Shape(std::in_place,
                 [&](auto** made) { return msq_shape_offset(get(), distance, made); });
  }
  /// operation: an msq_boolean_operation.
  static Shape boolean(int32_t operation, const std::vector<Shape>& shapes) {
    std::vector<const msq_shape*> handles;
    for (const Shape& shape : shapes) handles.push_back(shape.get());
    return Shape(std::in_place, [&](auto** made) {
      return msq_shape_boolean(operation, handles.data(), handles.size(), made);
    });
  }

  /// create(&handle) makes it by a function of msq.h.
  template <class Create>
  static Shape made_by(Create&& create) {
    return Shape(std::in_place, create);
  }

  msq_shape_report info() const {
    return detail::report<msq_shape_report>([&](auto* r) { return msq_shape_info(get(), r); });
  }
  Hash hash() const {
    Hash hash;
    check(msq_shape_hash(get(), hash.data()));
    return hash;
  }
  uint64_t self_intersections(const Job& job = {}) const {
    uint64_t pairs = 0;
    check(msq_shape_self_intersections(get(), &pairs, job.get()));
    return pairs;
  }

 private:
  template <class Create>
  Shape(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
  explicit Shape(msq_shape* made) : Handle(made) {}

  static MeshDef mesh(int32_t type, const void* vertices, size_t coordinates,
                      Span<const uint32_t> triangles) {
    MeshDef def;
    def.coordinate_type = type;
    def.vertices = vertices;
    def.vertex_count =
        detail::groups("msq::Shape::from_mesh", coordinates, "coordinates", 3, "vertex");
    def.triangles = triangles.data();
    def.triangle_count =
        detail::groups("msq::Shape::from_mesh", triangles.size(), "indices", 3, "triangle");
    return def;
  }
};

/// The beam lattices of a 3MF file, and its meshes.
class BeamFile : public detail::Handle<msq_beam_file, msq_beam_file_retain, msq_beam_file_release> {
 public:
  BeamFile() = default;
  static BeamFile open(const Context& context, const std::string& path,
                       const FileDef& def = FileDef(), const Job& job = {}) {
    return BeamFile(std::in_place, [&](auto** made) {
      return msq_beam_file_open(context.get(), path.c_str(), &def, made, job.get());
    });
  }
  /// def names the format.
  static BeamFile open(const Context& context, Span<const uint8_t> bytes, const FileDef& def,
                       const Job& job = {}) {
    return BeamFile(std::in_place, [&](auto** made) {
      return msq_beam_file_open_memory(context.get(), bytes.data(), bytes.size(), &def, made,
                                       job.get());
    });
  }
  msq_beam_file_report info(uint64_t lattice = 0) const {
    return detail::report<msq_beam_file_report>(
        [&](auto* r) { return msq_beam_file_info(get(), lattice, r); });
  }
  /// Its arrays live as long as the file.
  BeamsDef beams(uint64_t lattice = 0) const {
    BeamsDef def;
    check(msq_beam_file_beams(get(), lattice, &def));
    return def;
  }
  /// mesh: an msq_beam_file_mesh.
  Shape shape(const Context& context, int32_t mesh = MSQ_BEAM_FILE_SOLID, uint64_t lattice = 0,
              int32_t winding_rule = MSQ_WINDING_AUTO) const {
    return Shape::made_by([&](auto** made) {
      return msq_beam_file_shape(context.get(), get(), lattice, mesh, winding_rule, made);
    });
  }

 private:
  template <class Create>
  BeamFile(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
};

// ---- Fields -------------------------------------------------------------------------------------

/// A number at every point of space.
class Field : public detail::Handle<msq_field, msq_field_retain, msq_field_release> {
 public:
  Field() = default;

  static Field gradient(const Context& context, const Vec3& from, double from_value, const Vec3& to,
                        double to_value) {
    return Field(std::in_place, [&](auto** made) {
      return msq_field_gradient(context.get(), from.data(), from_value, to.data(), to_value, made);
    });
  }
  static Field radial(const Context& context, const RadialFieldDef& def) {
    return Field(std::in_place,
                 [&](auto** made) { return msq_field_radial(context.get(), &def, made); });
  }
  /// curve: pairs of argument and value, see msq_field_map.
  static Field map(const Context& context, const Field& argument, Span<const double> curve) {
    const size_t pairs = detail::groups("msq::Field::map", curve.size(), "numbers", 2, "pair");
    return Field(std::in_place, [&](auto** made) {
      return msq_field_map(context.get(), argument.get(), curve.data(), pairs, made);
    });
  }
  static Field grid(const Context& context, const GridFieldDef& def) {
    return Field(std::in_place,
                 [&](auto** made) { return msq_field_grid(context.get(), &def, made); });
  }
  /// Samples at origin + (i, j, k) * spacing, x fastest; the values are copied.
  static Field grid(const Context& context, Span<const double> values,
                    const std::array<uint64_t, 3>& size, const Vec3& origin, const Vec3& spacing) {
    if (size[0] * size[1] * size[2] != values.size())
      throw std::invalid_argument("msq::Field::grid: there are " + std::to_string(values.size()) +
                                  " values; size has " + std::to_string(size[0]) + " x " +
                                  std::to_string(size[1]) + " x " + std::to_string(size[2]));
    GridFieldDef def;
    def.image.values = values.data();
    def.image.value_type = MSQ_FLOAT64;
    for (size_t axis = 0; axis < 3; ++axis) {
      def.image.size[axis] = size[axis];
      def.image.grid.origin[axis] = origin[axis];
      def.image.grid.cell_size[axis] = spacing[axis];
    }
    return grid(context, def);
  }
  static Field expression(const Context& context, const ExpressionFieldDef& def) {
    return Field(std::in_place,
                 [&](auto** made) { return msq_field_expression(context.get(), &def, made); });
  }
  /// A formula of x, y and z with values from low to high.
  static Field expression(const Context& context, const std::string& formula, double low,
                          double high) {
    ExpressionFieldDef def;
    def.expression = formula.c_str();
    def.low = low;
    def.high = high;
    return expression(context, def);
  }
  static Field shape_distance(const Context& context, const ShapeDistanceFieldDef& def,
                              const Job& job = {}) {
    return Field(std::in_place, [&](auto** made) {
      return msq_field_shape_distance(context.get(), &def, made, job.get());
    });
  }
  /// def: low, high, lipschitz, concurrent, hash_key; range may be NULL.
  static Field host(const Context& context, HostFieldDef def, ValuesFn evaluate,
                    RangeFn range = nullptr) {
    struct Callbacks {
      ValuesFn evaluate;
      RangeFn range;
    };
    def.evaluate = [](void* user, const double* points, uint64_t count, double* values) {
      return detail::result_of(
          [&] { static_cast<Callbacks*>(user)->evaluate(points, count, values); });
    };
    if (range)
      def.range = [](void* user, const double* min, const double* max, double* low, double* high) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->range(min, max, low, high); });
      };
    msq_field* made = nullptr;
    detail::give(def, std::make_unique<Callbacks>(Callbacks{std::move(evaluate), std::move(range)}),
                 [&](auto* d) { return msq_field_host(context.get(), d, &made); });
    return Field(made);
  }

  Hash hash() const {
    Hash hash;
    check(msq_field_hash(get(), hash.data()));
    return hash;
  }
  /// One value per point of the set, whose number of points the caller knows.
  void evaluate(const Context& context, const msq_points_def& points, Span<double> values,
                const Job& job = {}) const {
    check(
        msq_field_evaluate(context.get(), get(), &points, values.data(), values.size(), job.get()));
  }

 private:
  template <class Create>
  Field(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
  explicit Field(msq_field* made) : Handle(made) {}
};

/// Cells by a map: fields of samples (Field::grid) on one grid, which must outlive the definition.
inline WarpDef sampled_warp(const Field& u, const Field& v, const Field& w) {
  WarpDef def;
  def.kind = MSQ_WARP_SAMPLED;
  def.u = u.get();
  def.v = v.get();
  def.w = w.get();
  return def;
}

/// A parameter: a number, or a field that must live until the definition was used.
inline msq_param param(double value) {
  return {value, nullptr};
}
inline msq_param param(const Field& field) {
  return {0, field.get()};
}
msq_param param(Field&&) = delete;

// ---- Structures ---------------------------------------------------------------------------------

/// The struts of a structure as a graph with joints.
class StrutGraph
    : public detail::Handle<msq_strut_graph, msq_strut_graph_retain, msq_strut_graph_release> {
 public:
  StrutGraph() = default;
  /// The arrays live as long as the graph.
  msq_strut_graph_report info() const {
    return detail::report<msq_strut_graph_report>(
        [&](auto* r) { return msq_strut_graph_info(get(), r); });
  }

 private:
  friend class Structure;
  template <class Create>
  StrutGraph(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
};

/// Callbacks of a structure of the host, see msq_host_structure_def. inside, or build_cell with
/// evaluate_cell and free_cell; box and distance may be NULL.
struct StructureCallbacks {
  std::function<void(const msq_host_points& points, uint8_t* inside)> inside;
  std::function<void(const int32_t* cell, void** data, uint64_t* bytes)> build_cell;
  std::function<void(const void* data, const msq_host_points& points, uint8_t* inside)>
      evaluate_cell;
  /// It must not throw.
  std::function<void(void* data)> free_cell;
  /// Returns an msq_box_answer.
  std::function<int32_t(const double* min, const double* max)> box;
  std::function<void(const msq_host_points& points, double* distances)> distance;
};

/// What fills a shape at one scale.
class Structure
    : public detail::Handle<msq_structure, msq_structure_retain, msq_structure_release> {
 public:
  Structure() = default;

  /// create(&handle) makes it by a function of msq.h.
  template <class Create>
  static Structure made_by(Create&& create) {
    return Structure(std::in_place, create);
  }

  static Structure lattice(const Context& context, const LatticeDef& def) {
    return Structure(std::in_place,
                     [&](auto** made) { return msq_structure_lattice(context.get(), &def, made); });
  }
  static Structure plate_lattice(const Context& context, const PlateLatticeDef& def) {
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_plate_lattice(context.get(), &def, made);
    });
  }
  static Structure foam(const Context& context, const FoamDef& def) {
    return Structure(std::in_place,
                     [&](auto** made) { return msq_structure_foam(context.get(), &def, made); });
  }
  static Structure functional(const Context& context, const FunctionalDef& def) {
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_functional(context.get(), &def, made);
    });
  }
  static Structure waves(const Context& context, const WavesDef& def) {
    return Structure(std::in_place,
                     [&](auto** made) { return msq_structure_waves(context.get(), &def, made); });
  }
  static Structure beams(const Context& context, const BeamsDef& def, const Job& job = {}) {
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_beams(context.get(), &def, made, job.get());
    });
  }
  /// operation: an msq_boolean_operation.
  static Structure boolean(int32_t operation, const std::vector<Structure>& structures) {
    std::vector<const msq_structure*> handles;
    for (const Structure& structure : structures) handles.push_back(structure.get());
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_boolean(operation, handles.data(), handles.size(), made);
    });
  }
  static Structure blend(const Structure& a, const Structure& b, msq_param fraction) {
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_blend(a.get(), b.get(), &fraction, made);
    });
  }
  /// operation: an msq_boolean_operation.
  static Structure smooth_boolean(int32_t operation, const Structure& a, const Structure& b,
                                  msq_param radius) {
    return Structure(std::in_place, [&](auto** made) {
      return msq_structure_smooth_boolean(operation, a.get(), b.get(), &radius, made);
    });
  }
  /// def: grid, concurrent, hash_key.
  static Structure host(const Context& context, HostStructureDef def,
                        StructureCallbacks callbacks) {
    using Callbacks = StructureCallbacks;
    if (callbacks.inside)
      def.inside = [](void* user, const msq_host_points* points, uint8_t* inside) {
        return detail::result_of([&] { static_cast<Callbacks*>(user)->inside(*points, inside); });
      };
    if (callbacks.build_cell)
      def.build_cell = [](void* user, const int32_t* cell, void** data, uint64_t* bytes) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->build_cell(cell, data, bytes); });
      };
    if (callbacks.evaluate_cell)
      def.evaluate_cell = [](void* user, const void* data, const msq_host_points* points,
                             uint8_t* inside) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->evaluate_cell(data, *points, inside); });
      };
    if (callbacks.free_cell)
      def.free_cell = [](void* user, void* data) {
        static_cast<Callbacks*>(user)->free_cell(data);
      };
    if (callbacks.box)
      def.box = [](void* user, const double* min, const double* max, int32_t* answer) {
        return detail::result_of([&] { *answer = static_cast<Callbacks*>(user)->box(min, max); });
      };
    if (callbacks.distance)
      def.distance = [](void* user, const msq_host_points* points, double* distances) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->distance(*points, distances); });
      };
    msq_structure* made = nullptr;
    detail::give(def, std::make_unique<Callbacks>(std::move(callbacks)),
                 [&](auto* d) { return msq_structure_host(context.get(), d, &made); });
    return Structure(made);
  }
  /// def: grid, kind, level, lipschitz, concurrent, hash_key; range may be NULL.
  static Structure host_function(const Context& context, HostFunctionDef def, ValuesFn evaluate,
                                 RangeFn range = nullptr) {
    struct Callbacks {
      ValuesFn evaluate;
      RangeFn range;
    };
    def.evaluate = [](void* user, const double* points, uint64_t count, double* values) {
      return detail::result_of(
          [&] { static_cast<Callbacks*>(user)->evaluate(points, count, values); });
    };
    if (range)
      def.range = [](void* user, const double* min, const double* max, double* low, double* high) {
        return detail::result_of(
            [&] { static_cast<Callbacks*>(user)->range(min, max, low, high); });
      };
    msq_structure* made = nullptr;
    detail::give(def, std::make_unique<Callbacks>(Callbacks{std::move(evaluate), std::move(range)}),
                 [&](auto* d) { return msq_structure_host_function(context.get(), d, &made); });
    return Structure(made);
  }

  Hash hash() const {
    Hash hash;
    check(msq_structure_hash(get(), hash.data()));
    return hash;
  }
  msq_lattice_faces_report lattice_faces(const Vec3& min, const Vec3& max,
                                         const Job& job = {}) const {
    return detail::report<msq_lattice_faces_report>(
        [&](auto* r) { return msq_lattice_faces(get(), min.data(), max.data(), r, job.get()); });
  }
  /// fn(const msq_strut* struts, uint64_t count)
  template <class F>
  void struts(const Context& context, const StrutsDef& def, F&& fn, const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    check(msq_structure_struts(context.get(), get(), &def,
                               callback.template call<const msq_strut*, uint64_t>, &callback,
                               job.get()));
  }
  StrutGraph strut_graph(const Context& context, const StrutsDef& def, const Job& job = {}) const {
    return StrutGraph(std::in_place, [&](auto** made) {
      return msq_structure_strut_graph(context.get(), get(), &def, made, job.get());
    });
  }
  /// onsets: one per point of the set. gradients: three per point, or empty. value: an
  /// msq_onset_value.
  void onset(const Context& context, const msq_points_def& points, int32_t value,
             Span<double> onsets, Span<double> gradients = {}, const Job& job = {}) const {
    check(msq_set_onset(context.get(), get(), &points, value, onsets.data(), onsets.size(),
                        gradients.data(), gradients.size(), job.get()));
  }

  /// A curve from volume fraction to parameter, and the parameter of the target.
  struct Calibration {
    msq_calibration_report report{};
    std::vector<double> parameters, fractions;
  };
  /// sample NULL: points of msq's choice. pairs: 0, or at least 2 points of the curve.
  Calibration calibrate(const Context& context, double target, uint64_t pairs = 0,
                        const msq_points_def* sample = nullptr, const Job& job = {}) const {
    Calibration made;
    made.report.struct_size = sizeof made.report;
    made.parameters.resize(pairs);
    made.fractions.resize(pairs);
    check(msq_structure_calibrate(
        context.get(), get(), sample, target, pairs ? made.parameters.data() : nullptr,
        pairs ? made.fractions.data() : nullptr, pairs, &made.report, job.get()));
    return made;
  }
  /// Cell sizes at which fill lines of a width have a density, see msq_fill_calibrate.
  Vec3 fill_calibrate(const Context& context, double line_width, double density,
                      const Job& job = {}) const {
    Vec3 size{};
    check(msq_fill_calibrate(context.get(), get(), line_width, density, size.data(), job.get()));
    return size;
  }

 private:
  template <class Create>
  Structure(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
  explicit Structure(msq_structure* made) : Handle(made) {}
};

/// Nodes and struts of a unit cell, for example of a named one.
struct UnitCell {
  std::vector<double> nodes;     // triples
  std::vector<uint32_t> struts;  // pairs of node indices
  std::vector<uint32_t> unmatched;
  msq_unit_cell_report report{};

  explicit UnitCell(const UnitCellDef& def) {
    report.struct_size = sizeof report;
    check(msq_unit_cell_info(&def, &report, nullptr, 0));
    unmatched.resize(report.unmatched_count);
    check(msq_unit_cell_info(&def, &report, unmatched.empty() ? nullptr : unmatched.data(),
                             unmatched.size()));
    nodes.resize(3 * report.node_count);
    struts.resize(2 * report.strut_count);
    check(msq_unit_cell_geometry(&def, nodes.data(), report.node_count, struts.data(),
                                 report.strut_count));
  }
};

// ---- Materials, models --------------------------------------------------------------------------

/// What solid points are made of.
class Material : public detail::Handle<msq_material, msq_material_retain, msq_material_release> {
 public:
  Material() = default;
  Material(const Context& context, const MaterialDef& def)
      : Handle(std::in_place,
               [&](auto** made) { return msq_material_create(context.get(), &def, made); }) {}
  static Material blend(const Context& context, uint32_t id, const Material& a, const Material& b,
                        const msq_param& fraction) {
    return Material(std::in_place, [&](auto** made) {
      return msq_material_blend(context.get(), id, a.get(), b.get(), &fraction, made);
    });
  }
  Hash hash() const {
    Hash hash;
    check(msq_material_hash(get(), hash.data()));
    return hash;
  }

 private:
  template <class Create>
  Material(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
};

/// One scale of a model: a shape for scale 0, a structure for the others.
struct Scale {
  Shape shape;
  Structure structure;
  /// Thickness of the skin; skin_field takes precedence if it is set.
  double skin = 0;
  Field skin_field;
  Material material, skin_material;

  Scale() = default;
  Scale(Shape of) : shape(std::move(of)) {}
  Scale(Structure of) : structure(std::move(of)) {}
};

/// The outline of a layer.
class Contours : public detail::Handle<msq_contours, msq_contours_retain, msq_contours_release> {
 public:
  Contours() = default;
  /// Takes a reference of its own: that of a layer lives until its callback returns.
  static Contours of(msq_contours* contours) {
    msq_contours_retain(contours);
    return Contours(contours);
  }
  /// The arrays live as long as the contours.
  msq_contours_report info() const {
    return detail::report<msq_contours_report>(
        [&](auto* r) { return msq_contours_info(get(), r); });
  }

 private:
  friend class Model;
  friend class Slicer;
  template <class Create>
  Contours(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
  explicit Contours(msq_contours* made) : Handle(made) {}
};

/// Membership, distance, material, statistics and pictures of a shape with its structures.
class Model : public detail::Handle<msq_model, msq_model_retain, msq_model_release> {
 public:
  Model() = default;
  Model(const Context& context, const std::vector<Scale>& scales)
      : Handle(std::in_place, [&](msq_model** made) { return create(context, scales, made); }) {}
  /// Models in order of priority.
  static Model regions(const Context& context, const std::vector<Model>& models) {
    std::vector<const msq_model*> handles;
    for (const Model& model : models) handles.push_back(model.get());
    return Model(std::in_place, [&](auto** made) {
      return msq_model_regions(context.get(), handles.data(), handles.size(), made);
    });
  }

  /// create(&handle) makes it by a function of msq.h.
  template <class Create>
  static Model made_by(Create&& create) {
    return Model(std::in_place, create);
  }

  Hash hash() const {
    Hash hash;
    check(msq_model_hash(get(), hash.data()));
    return hash;
  }
  std::pair<Vec3, Vec3> bounds() const {
    std::pair<Vec3, Vec3> box{};
    check(msq_model_bounds(get(), box.first.data(), box.second.data()));
    return box;
  }
  double scale_length(uint32_t scale) const {
    double length = 0;
    check(msq_model_scale_length(get(), scale, &length));
    return length;
  }
  /// The structure of a scale. Of scale 0: an empty handle.
  Structure structure(uint32_t scale = 1, uint32_t region = 0) const {
    return Structure::made_by(
        [&](auto** made) { return msq_model_scale(get(), region, scale, nullptr, made); });
  }
  /// The coarse shape of a region.
  Shape shape(uint32_t region = 0) const {
    return Shape::made_by(
        [&](auto** made) { return msq_model_scale(get(), region, 0, made, nullptr); });
  }

  /// As a document in JSON.
  std::string to_json(const JsonDef& def = JsonDef()) const {
    uint64_t bytes = 0;
    check(msq_model_to_json(get(), &def, nullptr, 0, &bytes));
    std::string text(bytes, '\0');
    check(msq_model_to_json(get(), &def, text.data(), text.size(), &bytes));
    return text;
  }

  bool inside(const Vec3& point, const QueryDef& query = QueryDef()) const {
    int32_t inside = 0;
    check(msq_point_membership(get(), point.data(), &query, &inside));
    return inside != 0;
  }
  /// inside: one byte per point of the set.
  void membership(const msq_points_def& points, Span<uint8_t> inside,
                  const QueryDef& query = QueryDef(), const Job& job = {}) const {
    check(msq_set_membership(get(), &points, &query, inside.data(), inside.size(), job.get()));
  }
  double distance(const Vec3& point, const QueryDef& query = QueryDef()) const {
    double distance = 0;
    check(msq_point_distance(get(), point.data(), &query, &distance));
    return distance;
  }
  void distance(const msq_points_def& points, Span<double> distances,
                const QueryDef& query = QueryDef(), const Job& job = {}) const {
    check(msq_set_distance(get(), &points, &query, distances.data(), distances.size(), job.get()));
  }
  /// -1: in no region.
  int32_t region(const Vec3& point) const {
    int32_t region = -1;
    check(msq_point_region(get(), point.data(), &region));
    return region;
  }
  void region(const msq_points_def& points, Span<int32_t> regions, const Job& job = {}) const {
    check(msq_set_region(get(), &points, regions.data(), regions.size(), job.get()));
  }
  /// values: one per channel, or empty with channels. Returns the id.
  uint32_t material(const Vec3& point, Span<const char* const> channels = {},
                    Span<double> values = {}, const QueryDef& query = QueryDef()) const {
    if (values.size() != channels.size())
      throw std::invalid_argument("msq::Model::material: there are " +
                                  std::to_string(channels.size()) + " channels and " +
                                  std::to_string(values.size()) + " values");
    uint32_t id = 0;
    check(msq_point_material(get(), point.data(), &query, channels.data(), channels.size(), &id,
                             values.data()));
    return id;
  }
  /// ids: one per point. values: one per point and channel.
  void material(const msq_points_def& points, Span<const char* const> channels, Span<uint32_t> ids,
                Span<double> values, const QueryDef& query = QueryDef(),
                const Job& job = {}) const {
    check(msq_set_material(get(), &points, &query, channels.data(), channels.size(), ids.data(),
                           ids.size(), values.data(), values.size(), job.get()));
  }

  /// phase: an msq_phase.
  msq_estimate volume_fraction(const msq_points_def& sample, int32_t phase = MSQ_PHASE_SOLID,
                               const QueryDef& query = QueryDef(), const Job& job = {}) const {
    msq_estimate estimate{};
    check(msq_volume_fraction(get(), &sample, &query, phase, &estimate, job.get()));
    return estimate;
  }
  std::vector<msq_estimate> two_point_correlation(const msq_points_def& sample,
                                                  const SegmentsDef& def,
                                                  const QueryDef& query = QueryDef(),
                                                  const Job& job = {}) const {
    std::vector<msq_estimate> estimates(def.length_count);
    check(msq_two_point_correlation(get(), &sample, &query, &def, estimates.data(),
                                    estimates.size(), job.get()));
    return estimates;
  }
  std::vector<msq_estimate> lineal_path(const msq_points_def& sample, const SegmentsDef& def,
                                        const QueryDef& query = QueryDef(),
                                        const Job& job = {}) const {
    std::vector<msq_estimate> estimates(def.length_count);
    check(msq_lineal_path(get(), &sample, &query, &def, estimates.data(), estimates.size(),
                          job.get()));
    return estimates;
  }

  /// The section at a height along the axis of the definition.
  Contours contours(double height, const ContoursDef& def, const Job& job = {}) const {
    return Contours(std::in_place, [&](auto** made) {
      return msq_layer_contours(get(), height, &def, made, job.get());
    });
  }

  /// fn(const msq_surface_slab&)
  template <class F>
  void surface_mesh(const SurfaceDef& def, F&& fn, const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    check(msq_surface_mesh(get(), &def, callback.template call_with<msq_surface_slab>, &callback,
                           job.get()));
  }
  /// fn(const msq_file_part&). format: an msq_surface_format.
  template <class F>
  void surface_file(const SurfaceDef& def, int32_t format, F&& fn, const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    check(msq_surface_file(get(), &def, format, callback.template call_with<msq_file_part>,
                           &callback, job.get()));
  }

  /// hits: one per ray.
  void cast(const RaysDef& rays, Span<msq_ray_hit> hits, const QueryDef& query = QueryDef(),
            const Job& job = {}) const {
    check(msq_ray_cast(get(), &rays, &query, hits.data(), hits.size(), job.get()));
  }
  Camera fit_camera(const Vec3& direction, const Vec3& up, uint32_t width, uint32_t height,
                    Camera camera = Camera()) const {
    check(msq_camera_fit(get(), direction.data(), up.data(), width, height, &camera));
    return camera;
  }
  void render(const Camera& camera, const RenderDef& def, const Frame& frame,
              const QueryDef& query = QueryDef(), const Job& job = {}) const {
    check(msq_render(get(), &camera, &def, &query, &frame, nullptr, nullptr, job.get()));
  }
  /// fn(const msq_render_pass&) after each pass.
  template <class F>
  void render(const Camera& camera, const RenderDef& def, const Frame& frame, const QueryDef& query,
              F&& fn, const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    check(msq_render(get(), &camera, &def, &query, &frame,
                     callback.template call_with<msq_render_pass>, &callback, job.get()));
  }

 private:
  template <class Create>
  Model(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}

  static msq_status create(const Context& context, const std::vector<Scale>& scales,
                           msq_model** made) {
    std::vector<msq_scale_def> known(scales.size());
    for (size_t i = 0; i < scales.size(); ++i) {
      const Scale& scale = scales[i];
      known[i].shape = scale.shape.get();
      known[i].structure = scale.structure.get();
      known[i].skin = scale.skin_field ? param(scale.skin_field) : param(scale.skin);
      known[i].material = scale.material.get();
      known[i].skin_material = scale.skin_material.get();
    }
    ModelDef def;
    def.scales = known.data();
    def.scale_count = static_cast<uint32_t>(known.size());
    def.scale_size = sizeof(msq_scale_def);
    return msq_model_create(context.get(), &def, made);
  }
};

// ---- Documents ----------------------------------------------------------------------------------

/// A model with settings for slices and pictures, from JSON.
class Document : public detail::Handle<msq_document, msq_document_retain, msq_document_release> {
 public:
  Document() = default;
  static Document from_json(const Context& context, const std::string& text,
                            const DocumentDef& def = DocumentDef(), const Job& job = {}) {
    return Document(std::in_place, [&](auto** made) {
      return msq_document_from_json(context.get(), text.data(), text.size(), &def, made, job.get());
    });
  }
  static Document from_file(const Context& context, const std::string& path,
                            const DocumentDef& def = DocumentDef(), const Job& job = {}) {
    return Document(std::in_place, [&](auto** made) {
      return msq_document_from_file(context.get(), path.c_str(), &def, made, job.get());
    });
  }
  /// Its title lives as long as the document.
  msq_document_report info() const {
    return detail::report<msq_document_report>(
        [&](auto* r) { return msq_document_info(get(), r); });
  }
  Model model() const {
    return Model::made_by([&](auto** made) { return msq_document_model(get(), made); });
  }
  /// Its pointers live as long as the document.
  SlicerDef slicing() const {
    SlicerDef def;
    check(msq_document_slicing(get(), &def));
    return def;
  }
  /// The pointers live as long as the document.
  std::pair<Camera, RenderDef> view() const {
    std::pair<Camera, RenderDef> view;
    check(msq_document_view(get(), &view.first, &view.second));
    return view;
  }

 private:
  template <class Create>
  Document(std::in_place_t, Create&& create) : Handle(std::in_place, create) {}
};

// ---- Layers -------------------------------------------------------------------------------------

/// Layers of a model.
class Slicer : public detail::Handle<msq_slicer, msq_slicer_retain, msq_slicer_release> {
 public:
  Slicer() = default;
  Slicer(const Model& model, const SlicerDef& def)
      : Handle(std::in_place,
               [&](auto** made) { return msq_slicer_create(model.get(), &def, made); }) {}

  msq_slicer_report info() const {
    return detail::report<msq_slicer_report>([&](auto* r) { return msq_slicer_info(get(), r); });
  }
  double layer_z(uint64_t index) const {
    double z = 0;
    check(msq_slicer_layer_z(get(), index, &z));
    return z;
  }

  /// fn(const msq_layer&), once per layer in ascending order, on this thread.
  template <class F>
  void run(uint64_t first, uint64_t count, F&& fn, const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    check(msq_slicer_run(get(), first, count, callback.template call_with<msq_layer>, &callback,
                         job.get()));
  }
  /// All layers.
  template <class F>
  void run(F&& fn, const Job& job = {}) const {
    run(0, info().layer_count, fn, job);
  }

  /// The first output of one layer: height rows of info().stride bytes.
  std::vector<uint8_t> layer(uint64_t index, const Job& job = {}) const {
    std::vector<uint8_t> bytes(info().layer_bytes);
    check(msq_slice_layer(get(), index, bytes.data(), bytes.size(), job.get()));
    return bytes;
  }
  Contours contours(uint64_t index, const ContoursDef& def, const Job& job = {}) const {
    return Contours(std::in_place, [&](auto** made) {
      return msq_slicer_contours(get(), index, &def, made, job.get());
    });
  }

  class Layers;
  /// `for (const Layer& layer : slicer.layers())`: each made when it is reached.
  Layers layers() const;
  Layers layers(uint64_t first, uint64_t count) const;

  /// fn(const msq_finding* findings, uint64_t count)
  template <class F>
  msq_printability_report printability(const PrintabilityDef& def, F&& fn,
                                       const Job& job = {}) const {
    detail::Callback<F> callback{fn};
    return detail::report<msq_printability_report>([&](auto* r) {
      return msq_printability(get(), &def, callback.template call<const msq_finding*, uint64_t>,
                              &callback, r, job.get());
    });
  }
  msq_printability_report printability(const PrintabilityDef& def = PrintabilityDef(),
                                       const Job& job = {}) const {
    return detail::report<msq_printability_report>(
        [&](auto* r) { return msq_printability(get(), &def, nullptr, nullptr, r, job.get()); });
  }
};

/// One layer of a range: the first output of the slicer.
struct Layer {
  uint64_t index = 0;
  double z = 0;
  std::vector<uint8_t> bytes;
};

/// A range over layers, for one pass.
class Slicer::Layers {
 public:
  Layers(Slicer slicer, uint64_t first, uint64_t count)
      : slicer_(std::move(slicer)), first_(first), count_(count) {}

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Layer;
    using difference_type = std::ptrdiff_t;
    using pointer = const Layer*;
    using reference = const Layer&;

    reference operator*() const {
      if (!made_) {
        layer_.index = index_;
        layer_.z = slicer_->layer_z(index_);
        layer_.bytes = slicer_->layer(index_);
        made_ = true;
      }
      return layer_;
    }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      ++index_;
      made_ = false;
      return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

   private:
    friend class Layers;
    Iterator(const Slicer* slicer, uint64_t index) : slicer_(slicer), index_(index) {}
    const Slicer* slicer_;
    uint64_t index_;
    mutable Layer layer_;
    mutable bool made_ = false;
  };

  Iterator begin() const { return {&slicer_, first_}; }
  Iterator end() const { return {&slicer_, first_ + count_}; }

 private:
  Slicer slicer_;
  uint64_t first_, count_;
};

inline Slicer::Layers Slicer::layers() const {
  return layers(0, info().layer_count);
}
inline Slicer::Layers Slicer::layers(uint64_t first, uint64_t count) const {
  return Layers(*this, first, count);
}

/// Fill lines of one layer, for filament.
class Fill : public detail::Handle<msq_fill, msq_fill_retain, msq_fill_release> {
 public:
  Fill() = default;
  Fill(const Context& context, const Structure& structure, const FillDef& def, const Job& job = {})
      : Handle(std::in_place, [&](auto** made) {
          return msq_fill_lines(context.get(), structure.get(), &def, made, job.get());
        }) {}
  /// The arrays live as long as the fill.
  msq_fill_report info() const {
    return detail::report<msq_fill_report>([&](auto* r) { return msq_fill_info(get(), r); });
  }
};

}  // namespace cpp
}  // namespace msq

#endif

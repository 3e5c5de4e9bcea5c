// SPDX-License-Identifier: Apache-2.0
// A host that never stops: it makes models, slices, queries and draws them, cancels calls, fails in
// its callbacks, runs into the memory limit and has cells evicted, again and again. Results are
// checked against those of the first time. At the end it prints by how much the process grew per
// hour.
//
// usage: soak [--seconds N] [--threads N]
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "msq.h"

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void stop(const std::string& what) {
  std::fprintf(stderr, "soak: %s: %s\n", what.c_str(), msq_error_message());
  std::exit(1);
}

void check(msq_status status, const char* what) {
  if (status != MSQ_OK) stop(std::string(what) + " returned " + msq_status_name(status));
}

/// SplitMix64.
class Random {
 public:
  uint64_t word() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(word() % count); }

 private:
  uint64_t state_ = 1;
};

/// FNV-1a.
void add(uint64_t* hash, const void* data, size_t bytes) {
  const auto* byte = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < bytes; ++i) *hash = (*hash ^ byte[i]) * 0x100000001b3;
}

/// Cancels a job after a while, on a thread of its own.
class Canceller {
 public:
  Canceller() : thread_([this] { run(); }) {}
  ~Canceller() {
    set(nullptr, {}, true);
    thread_.join();
  }
  void begin(msq_job* job, std::chrono::microseconds after) {
    set(job, Clock::now() + after, false);
  }
  /// The job may be released after this.
  void end() { set(nullptr, {}, false); }

 private:
  void set(msq_job* job, Clock::time_point at, bool is_over) {
    const std::lock_guard lock(mutex_);
    job_ = job;
    at_ = at;
    is_over_ = is_over;
    changed_.notify_one();
  }
  void run() {
    std::unique_lock lock(mutex_);
    while (!is_over_) {
      if (!job_) {
        changed_.wait(lock);
      } else if (Clock::now() < at_) {
        changed_.wait_until(lock, at_);
      } else {
        msq_job_cancel(job_);
        job_ = nullptr;
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  msq_job* job_ = nullptr;
  Clock::time_point at_;
  bool is_over_ = false;
  std::thread thread_;
};

/// What happens to a call.
enum class Fate { success, cancel, callback_fails, limit };

struct Counts {
  uint64_t calls = 0, done = 0, cancelled = 0, failed = 0, refused = 0, evictions = 0;
};

class Soak {
 public:
  explicit Soak(uint32_t threads) : threads_(threads) {}

  void iterate() {
    const Fate fate = static_cast<Fate>(random_.below(4));
    const uint32_t kind = random_.below(kinds), use = random_.below(uses);
    msq_context_def def;
    check(msq_context_def_init(&def, sizeof def), "msq_context_def_init");
    def.threads = threads_;
    def.cache_bytes = 256 << 10;  // a part of the cells of a foam
    def.memory_limit = fate == Fate::limit ? 64 << 10 : 64 << 20;
    msq_context* context;
    check(msq_context_create(&def, &context), "msq_context_create");
    msq_job* job;
    check(msq_job_create(&job), "msq_job_create");
    if (fate == Fate::cancel)
      canceller_.begin(job, std::chrono::microseconds(random_.below(30000)));
    if (msq_model* model = make_model(context, kind)) {
      fails_ = fate == Fate::callback_fails;
      uint64_t hash = 0xcbf29ce484222325;
      const msq_status status = run(model, use, job, &hash);
      count(status, fate, kind * uses + use, hash);
      msq_model_release(model);
    }
    canceller_.end();
    msq_cache_report cache{};
    cache.struct_size = sizeof cache;
    check(msq_cache_stats(context, &cache), "msq_cache_stats");
    counts_.evictions += cache.evictions;
    msq_job_release(job);
    msq_context_release(context);
  }

  const Counts& counts() const { return counts_; }

 private:
  static constexpr uint32_t kinds = 6, uses = 5;

  static int32_t radii(void* user, const double* points, uint64_t count, double* values) {
    auto* soak = static_cast<Soak*>(user);
    if (soak->fails_ && soak->asked_++ % 32 == 31) return -77;
    for (uint64_t i = 0; i < count; ++i) values[i] = 0.15 + 0.05 * std::tanh(points[3 * i]);
    return 0;
  }

  /// NULL if the memory limit refused a part of it.
  msq_model* make_model(msq_context* context, uint32_t kind) {
    std::vector<double> vertices;
    std::vector<uint32_t> triangles;
    // A wavy plate.
    constexpr uint32_t side = 24;
    for (uint32_t top = 0; top < 2; ++top)
      for (uint32_t j = 0; j <= side; ++j)
        for (uint32_t i = 0; i <= side; ++i) {
          vertices.push_back(0.2 * i - 2.4);
          vertices.push_back(0.2 * j - 2.4);
          vertices.push_back(top ? 1.5 + 0.2 * std::fmod(0.37 * i * j, 1.0) : -1.5);
        }
    const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
      triangles.insert(triangles.end(), {a, b, c, a, c, d});
    };
    constexpr uint32_t row = side + 1, layer = row * row;
    for (uint32_t j = 0; j < side; ++j)
      for (uint32_t i = 0; i < side; ++i) {
        const uint32_t at = i + row * j;
        quad(at, at + row, at + row + 1, at + 1);
        quad(layer + at, layer + at + 1, layer + at + row + 1, layer + at + row);
      }
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t x = i, y = i + row * side, left = row * i, right = row * i + side;
      quad(x, x + 1, layer + x + 1, layer + x);
      quad(y + 1, y, layer + y, layer + y + 1);
      quad(left + row, left, layer + left, layer + left + row);
      quad(right, right + row, layer + right + row, layer + right);
    }
    msq_mesh_def mesh;
    check(msq_mesh_def_init(&mesh, sizeof mesh), "msq_mesh_def_init");
    mesh.vertices = vertices.data();
    mesh.vertex_count = vertices.size() / 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size() / 3;
    msq_shape* shape;
    const msq_status status = msq_shape_from_mesh(context, &mesh, &shape);
    if (status == MSQ_E_LIMIT) {
      ++counts_.calls;
      ++counts_.refused;
      const double low[3] = {-2, -2, -1.5}, high[3] = {2, 2, 1.5};
      check(msq_shape_from_box(context, low, high, &shape), "msq_shape_from_box");
    } else {
      check(status, "msq_shape_from_mesh");
    }
    msq_host_field_def field_def;
    check(msq_host_field_def_init(&field_def, sizeof field_def), "msq_host_field_def_init");
    field_def.evaluate = radii;
    field_def.user = this;
    field_def.low = 0.1;
    field_def.high = 0.2;
    field_def.lipschitz = 0.05;
    msq_field* field;
    check(msq_field_host(context, &field_def, &field), "msq_field_host");
    msq_structure* structure = nullptr;
    if (kind < 2) {
      msq_lattice_def def;
      check(msq_lattice_def_init(&def, sizeof def), "msq_lattice_def_init");
      def.unit_cell = kind ? MSQ_UNIT_CELL_OCTET : MSQ_UNIT_CELL_BCC;
      def.radius.field = field;
      check(msq_structure_lattice(context, &def, &structure), "msq_structure_lattice");
    } else if (kind < 4) {
      msq_foam_def def;
      check(msq_foam_def_init(&def, sizeof def), "msq_foam_def_init");
      def.radius.field = field;
      if (kind == 3) def.wall_thickness.value = 0.1;
      check(msq_structure_foam(context, &def, &structure), "msq_structure_foam");
    } else {
      msq_functional_def def;
      check(msq_functional_def_init(&def, sizeof def), "msq_functional_def_init");
      def.kind = MSQ_FUNCTIONAL_SHEET;
      def.function = kind == 4 ? MSQ_FUNCTION_GYROID : MSQ_FUNCTION_EXPRESSION;
      if (kind == 5) def.expression = "sin(x)*cos(y)+z/7-0.4";
      def.level.field = field;
      check(msq_structure_functional(context, &def, &structure), "msq_structure_functional");
    }
    msq_scale_def scales[2] = {};
    scales[0].shape = shape;
    scales[1].structure = structure;
    scales[1].skin.value = 0.1;
    msq_model_def def;
    check(msq_model_def_init(&def, sizeof def), "msq_model_def_init");
    def.scales = scales;
    def.scale_count = 2;
    msq_model* model;
    check(msq_model_create(context, &def, &model), "msq_model_create");
    msq_structure_release(structure);
    msq_field_release(field);
    msq_shape_release(shape);
    // Another shape has other results.
    if (status == MSQ_E_LIMIT && model) {
      msq_model_release(model);
      return nullptr;
    }
    return model;
  }

  msq_status run(const msq_model* model, uint32_t use, msq_job* job, uint64_t* hash) {
    if (use < 2) {
      msq_slicer_def def;
      check(msq_slicer_def_init(&def, sizeof def), "msq_slicer_def_init");
      def.pitch[0] = def.pitch[1] = 0.05;
      def.layer_height = 0.2;
      if (use == 1) def.output = MSQ_LAYER_GREY;
      msq_slicer* slicer;
      check(msq_slicer_create(model, &def, &slicer), "msq_slicer_create");
      struct Taker {
        Soak* soak;
        uint64_t* hash;
      } taker = {this, hash};
      const msq_status status = msq_slicer_run(
          slicer, 0, UINT64_MAX,
          [](void* user, const msq_layer* layer) -> int32_t {
            const auto* to = static_cast<Taker*>(user);
            add(to->hash, layer->data, layer->stride * layer->height);
            return to->soak->fails_ && to->soak->asked_++ % 8 == 7 ? -78 : 0;
          },
          &taker, job);
      msq_slicer_release(slicer);
      return status;
    }
    if (use == 2) {
      msq_points_def points;
      check(msq_points_def_init(&points, sizeof points), "msq_points_def_init");
      points.kind = MSQ_POINTS_STRATIFIED;
      for (int axis = 0; axis < 3; ++axis) {
        points.counts[axis] = 12;
        points.origin[axis] = -1.8;
        points.spacing[axis] = 0.3;
      }
      points.per_cell = 4;
      std::vector<uint8_t> inside(12 * 12 * 12 * 4);
      const msq_status status =
          msq_set_membership(model, &points, nullptr, inside.data(), inside.size(), job);
      add(hash, inside.data(), inside.size());
      return status;
    }
    if (use == 3) {
      msq_contours_def def;
      check(msq_contours_def_init(&def, sizeof def), "msq_contours_def_init");
      def.tolerance = 0.02;
      def.pitch = 0.1;
      msq_contours* contours;
      const msq_status status = msq_layer_contours(model, 0.3, &def, &contours, job);
      if (status == MSQ_OK) {
        msq_contours_report report{};
        report.struct_size = sizeof report;
        check(msq_contours_info(contours, &report), "msq_contours_info");
        add(hash, report.points, 2 * sizeof(double) * report.point_count);
        msq_contours_release(contours);
      }
      return status;
    }
    msq_camera camera;
    check(msq_camera_init(&camera, sizeof camera), "msq_camera_init");
    const double direction[3] = {-0.5, 0.7, -0.4};
    check(msq_camera_fit(model, direction, nullptr, 96, 64, &camera), "msq_camera_fit");
    msq_render_def def;
    check(msq_render_def_init(&def, sizeof def), "msq_render_def_init");
    def.width = 96;
    def.height = 64;
    std::vector<float> depth(96 * 64);
    msq_frame frame;
    check(msq_frame_init(&frame, sizeof frame), "msq_frame_init");
    frame.depth = depth.data();
    const msq_status status =
        msq_render(model, &camera, &def, nullptr, &frame, nullptr, nullptr, job);
    add(hash, depth.data(), depth.size() * sizeof(float));
    return status;
  }

  void count(msq_status status, Fate fate, uint32_t what, uint64_t hash) {
    ++counts_.calls;
    switch (status) {
      case MSQ_OK: {
        ++counts_.done;
        const auto [first, is_new] = hashes_.emplace(what, hash);
        if (!is_new && first->second != hash)
          stop("a result differs from the first one, " + std::to_string(what));
        return;
      }
      case MSQ_E_CANCELLED:
        ++counts_.cancelled;
        if (fate != Fate::cancel) stop("a call was cancelled by nobody");
        return;
      case MSQ_E_HOST:
        ++counts_.failed;
        if (fate != Fate::callback_fails || msq_error_host_code() > -77)
          stop("a callback failed by itself");
        return;
      case MSQ_E_LIMIT:
        ++counts_.refused;
        if (fate != Fate::limit) stop("a limit was met by nobody");
        return;
      default:
        stop(std::string("a call returned ") + msq_status_name(status));
    }
  }

  const uint32_t threads_;
  Random random_;
  Canceller canceller_;
  bool fails_ = false;
  uint64_t asked_ = 0;
  std::map<uint32_t, uint64_t> hashes_;
  Counts counts_;
};

double resident_megabytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  long total = 0, resident = 0;
  if (!file || std::fscanf(file, "%ld %ld", &total, &resident) != 2)
    stop("/proc/self/statm cannot be read");
  std::fclose(file);
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576;
}

/// Least squares, per hour.
double slope_per_hour(const std::vector<double>& seconds, const std::vector<double>& values) {
  double t = 0, v = 0, tt = 0, tv = 0;
  const auto n = static_cast<double>(seconds.size());
  for (size_t i = 0; i < seconds.size(); ++i) {
    t += seconds[i] / n;
    v += values[i] / n;
  }
  for (size_t i = 0; i < seconds.size(); ++i) {
    tt += (seconds[i] - t) * (seconds[i] - t);
    tv += (seconds[i] - t) * (values[i] - v);
  }
  return tt > 0 ? 3600 * tv / tt : 0;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 60;
  uint32_t threads = 2;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--seconds")) {
      seconds = std::atof(argv[i + 1]);
    } else if (!std::strcmp(argv[i], "--threads")) {
      threads = static_cast<uint32_t>(std::atoi(argv[i + 1]));
    } else {
      std::fprintf(stderr, "usage: soak [--seconds N] [--threads N]\n");
      return 2;
    }
  }
  const Clock::time_point begin = Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  Soak soak(threads);
  // A quarter of the time is warm-up: memory that is kept for the next call, code and tables.
  std::vector<double> times, resident, live;
  double next = 0.25 * seconds, first = 0;
  while (now() < seconds || soak.counts().calls < 40) {
    soak.iterate();
    if (now() < next) continue;
    next += seconds / 400;
    times.push_back(now());
    resident.push_back(resident_megabytes());
    const struct mallinfo2 heap = mallinfo2();
    live.push_back(static_cast<double>(heap.uordblks + heap.hblkhd) / 1048576);
    if (times.size() == 1) first = resident[0];
  }
  const Counts& counts = soak.counts();
  std::printf(
      "%.0f s, %llu calls: %llu done, %llu cancelled, %llu stopped by a callback, %llu beyond the "
      "memory limit; "
      "%llu cells evicted\n",
      now(), static_cast<unsigned long long>(counts.calls),
      static_cast<unsigned long long>(counts.done),
      static_cast<unsigned long long>(counts.cancelled),
      static_cast<unsigned long long>(counts.failed),
      static_cast<unsigned long long>(counts.refused),
      static_cast<unsigned long long>(counts.evictions));
  if (times.size() > 2)
    std::printf(
        "resident: %.1f MB after the warm-up, %.1f MB at the end, slope %.2f MB/h; live in the "
        "heap: %.2f MB, "
        "slope %.2f MB/h\n",
        first, resident.back(), slope_per_hour(times, resident), live.back(),
        slope_per_hour(times, live));
  return 0;
}

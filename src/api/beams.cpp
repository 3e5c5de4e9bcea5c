// SPDX-License-Identifier: Apache-2.0
// Lists of beams.
#include "structure/beams/beams.h"

#include <atomic>
#include <limits>

#include "api/definitions.h"
#include "api/guard.h"
#include "base/run_parts.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr double max_length = 1e75, min_radius = 1e-100;
constexpr uint64_t beams_at_once = uint64_t{1} << 14;

msq_beams_def beams_defaults() {
  msq_beams_def def{};
  def.cap = MSQ_CAP_SPHERE;
  def.coordinate_type = MSQ_FLOAT64;
  return def;
}

/// `width` values for each element of an array of the host's.
template <class T>
class Column {
 public:
  Column(const T* data, uint64_t count, uint64_t stride, uint64_t width, const char* name)
      : data_(reinterpret_cast<const unsigned char*>(data)),
        stride_(stride ? stride : width * sizeof(T)) {
    if (stride_ < width * sizeof(T))
      fail(Status::argument, "the stride of %s is %llu bytes; an element has %llu", name,
           static_cast<unsigned long long>(stride),
           static_cast<unsigned long long>(width * sizeof(T)));
    checked_product(count, stride_, name);
  }
  T at(uint64_t i, uint64_t k) const {
    T value;  // may be unaligned
    std::memcpy(&value, data_ + i * stride_ + k * sizeof(T), sizeof value);
    return value;
  }

 private:
  const unsigned char* data_;
  uint64_t stride_;
};

/// The same of numbers of either type.
class Numbers {
 public:
  Numbers(const void* data, uint64_t count, uint64_t stride, uint64_t width, bool is_float32,
          const char* name)
      : is_given_(data),
        is_float32_(is_float32),
        floats_(static_cast<const float*>(data), count, is_float32 ? stride : 0, width, name),
        doubles_(static_cast<const double*>(data), count, is_float32 ? 0 : stride, width, name) {}
  bool is_given() const { return is_given_; }
  double at(uint64_t i, uint64_t k) const {
    return is_float32_ ? double{floats_.at(i, k)} : doubles_.at(i, k);
  }

 private:
  bool is_given_, is_float32_;
  Column<float> floats_;
  Column<double> doubles_;
};

void require_array(const void* data, uint64_t count, const char* name, const char* count_name) {
  if (!data && count > 0)
    fail(Status::argument, "%s is NULL, but %s is %llu", name, count_name,
         static_cast<unsigned long long>(count));
}

/// A radius for all elements, where the definition gives none of their own.
double read_beam_radius(double radius, bool is_needed, const char* name, const char* others) {
  if (is_needed && !(radius >= min_radius && radius <= max_length))
    fail(Status::argument, "%s is %g; without %s it must be from %g to %g", name, radius, others,
         min_radius, max_length);
  return require_finite(radius, name);
}

bool is_radius(double r) {
  return r == 0 || (r >= min_radius && r <= max_length);
}

/// A definition whose arrays are there, and what they hold: first the beams, then the balls.
class Given {
 public:
  explicit Given(const msq_beams_def& def)
      : def_(checked(def)),
        is_float32_(def.coordinate_type == MSQ_FLOAT32),
        nodes_(
            point_array(def.nodes, def.node_count, def.node_stride, def.coordinate_type, "nodes")),
        beams_(def.beams, def.beam_count, def.beam_stride, 2, "beams"),
        radii_(def.radii, def.beam_count, def.radius_stride, 2, is_float32_, "radii"),
        caps_(def.caps, def.beam_count, def.cap_stride, 2, "caps"),
        balls_(def.balls, def.ball_count, def.ball_stride, 1, "balls"),
        ball_radii_(def.ball_radii, def.ball_count, def.ball_radius_stride, 1, is_float32_,
                    "ball_radii"),
        radius_(read_beam_radius(def.radius, def.beam_count > 0 && !def.radii, "radius", "radii")),
        ball_radius_(read_beam_radius(def.ball_radius, def.ball_count > 0 && !def.ball_radii,
                                      "ball_radius", "ball_radii")) {}

  uint64_t count() const { return def_.beam_count + def_.ball_count; }

  /// Keeps the definition, packed, unless its arrays are large.
  void keep_in(Structure& made) const {
    constexpr uint64_t max_bytes = uint64_t{4} << 20;
    const auto pack = [](auto& packed, const auto& column, uint64_t elements, uint64_t width) {
      for (uint64_t i = 0; i < elements; ++i)
        for (uint64_t k = 0; k < width; ++k) packed.push_back(column.at(i, k));
    };
    // No product overflows: the arrays are in memory.
    if (24 * def_.node_count + 26 * def_.beam_count + 12 * def_.ball_count > max_bytes) return;
    msq_beams_def def = def_;
    std::vector<double> nodes, radii, ball_radii;
    std::vector<uint32_t> beams, balls;
    std::vector<uint8_t> caps;
    for (uint64_t i = 0; i < def.node_count; ++i) {
      const Vec3 p = nodes_.at(i);
      nodes.insert(nodes.end(), {p.x, p.y, p.z});
    }
    pack(beams, beams_, def.beam_count, 2);
    pack(balls, balls_, def.ball_count, 1);
    if (def.radii) pack(radii, radii_, def.beam_count, 2);
    if (def.caps) pack(caps, caps_, def.beam_count, 2);
    if (def.ball_radii) pack(ball_radii, ball_radii_, def.ball_count, 1);
    def.coordinate_type = MSQ_FLOAT64;
    def.node_stride = def.beam_stride = def.radius_stride = def.cap_stride = def.ball_stride =
        def.ball_radius_stride = 0;
    def.nodes = nodes.data();
    def.beams = beams.data();
    def.balls = balls.data();
    if (def.radii) def.radii = radii.data();
    if (def.caps) def.caps = caps.data();
    if (def.ball_radii) def.ball_radii = ball_radii.data();
    keep(made, def);
  }

  /// Throws Error(argument), which names the first of the nodes, beams and balls that is not
  /// right.
  void check(const Executor& executor, Job* job) const {
    first_of(
        def_.node_count, executor, job, {0, 0.05}, [&](uint64_t i) { return is_node(i); },
        [&](uint64_t i) { fail_node(i); });
    first_of(
        def_.beam_count, executor, job, {0.05, 0.1}, [&](uint64_t i) { return is_beam(i); },
        [&](uint64_t i) { fail_beam(i); });
    first_of(
        def_.ball_count, executor, job, {0.1, 0.1}, [&](uint64_t i) { return is_ball(i); },
        [&](uint64_t i) { fail_ball(i); });
  }

  bool get(uint64_t i, Beam& beam) const {
    if (i >= def_.beam_count) {
      i -= def_.beam_count;
      const Vec3 centre = nodes_.at(balls_.at(i, 0));
      const double radius = ball_radius(i);
      beam = {centre, centre, radius, radius, BeamCap::sphere, BeamCap::sphere};
      return true;
    }
    beam = {nodes_.at(beams_.at(i, 0)),
            nodes_.at(beams_.at(i, 1)),
            radius(i, 0),
            radius(i, 1),
            cap(i, 0),
            cap(i, 1)};
    return !(length(beam.b - beam.a) < def_.min_length) && beam.is_solid();
  }

 private:
  static const msq_beams_def& checked(const msq_beams_def& def) {
    require_range(def.cap, MSQ_CAP_SPHERE, MSQ_CAP_BUTT, "cap");
    require_range(def.coordinate_type, MSQ_FLOAT32, MSQ_FLOAT64, "coordinate_type");
    require_reserved(def.reserved, "reserved");
    require_array(def.nodes, def.node_count, "nodes", "node_count");
    require_array(def.beams, def.beam_count, "beams", "beam_count");
    require_array(def.balls, def.ball_count, "balls", "ball_count");
    if (def.beam_count == 0 && def.ball_count == 0)
      fail(Status::argument, "beam_count and ball_count are 0; there must be a beam or a ball");
    constexpr uint64_t max_beams = INT32_MAX;
    if (def.beam_count > max_beams || def.ball_count > max_beams - def.beam_count)
      fail(Status::limit, "beam_count is %llu and ball_count %llu; the limit is %llu together",
           static_cast<unsigned long long>(def.beam_count),
           static_cast<unsigned long long>(def.ball_count),
           static_cast<unsigned long long>(max_beams));
    require_not_negative(def.min_length, "min_length");
    require_not_negative(def.length_scale, "length_scale");
    return def;
  }

  double radius(uint64_t i, uint64_t end) const {
    return radii_.is_given() ? radii_.at(i, end) : radius_;
  }
  double ball_radius(uint64_t i) const {
    return ball_radii_.is_given() ? ball_radii_.at(i, 0) : ball_radius_;
  }
  BeamCap cap(uint64_t i, uint64_t end) const {
    return static_cast<BeamCap>(def_.caps ? caps_.at(i, end) : def_.cap);
  }

  bool is_node(uint64_t i) const {
    const Vec3 p = nodes_.at(i);
    return std::abs(p.x) <= max_length && std::abs(p.y) <= max_length &&
           std::abs(p.z) <= max_length;
  }
  bool is_beam(uint64_t i) const {
    const double a = radius(i, 0), b = radius(i, 1);
    return beams_.at(i, 0) < def_.node_count && beams_.at(i, 1) < def_.node_count && is_radius(a) &&
           is_radius(b) && a + b > 0 &&
           (!def_.caps || std::max(caps_.at(i, 0), caps_.at(i, 1)) <= MSQ_CAP_BUTT);
  }
  bool is_ball(uint64_t i) const {
    const double r = ball_radius(i);
    return balls_.at(i, 0) < def_.node_count && r > 0 && is_radius(r);
  }

  [[noreturn]] void fail_node(uint64_t i) const {
    const Vec3 p = nodes_.at(i);
    fail(Status::argument,
         "node %llu is (%g, %g, %g); it must be finite, and at most %g in magnitude",
         static_cast<unsigned long long>(i), p.x, p.y, p.z, max_length);
  }
  void check_index(uint32_t node, const char* what, uint64_t i) const {
    if (node >= def_.node_count)
      fail(Status::argument, "%s %llu is at node %u, but node_count is %llu", what,
           static_cast<unsigned long long>(i), node,
           static_cast<unsigned long long>(def_.node_count));
  }
  [[noreturn]] void fail_beam(uint64_t i) const {
    const auto number = static_cast<unsigned long long>(i);
    for (uint64_t end : {0, 1}) {
      check_index(beams_.at(i, end), "beam", i);
      if (!is_radius(radius(i, end)))
        fail(Status::argument, "radius %llu of beam %llu is %g; it must be 0 or from %g to %g",
             static_cast<unsigned long long>(end), number, radius(i, end), min_radius, max_length);
      if (def_.caps && caps_.at(i, end) > MSQ_CAP_BUTT)
        fail(Status::argument, "cap %llu of beam %llu is %d; it must be from %d to %d",
             static_cast<unsigned long long>(end), number, caps_.at(i, end), MSQ_CAP_SPHERE,
             MSQ_CAP_BUTT);
    }
    fail(Status::argument, "the radii of beam %llu are both 0; one must be positive", number);
  }
  [[noreturn]] void fail_ball(uint64_t i) const {
    check_index(balls_.at(i, 0), "ball", i);
    fail(Status::argument, "the radius of ball %llu is %g; it must be from %g to %g",
         static_cast<unsigned long long>(i), ball_radius(i), min_radius, max_length);
  }

  /// Calls fail_at(i) for the first i < count that is not right, if there is one.
  template <class IsRight, class FailAt>
  static void first_of(uint64_t count, const Executor& executor, Job* job, Interval progress,
                       IsRight&& is_right, FailAt&& fail_at) {
    std::atomic<uint64_t> first{count};
    run_parts(executor, (count + beams_at_once - 1) / beams_at_once, job, progress,
              [&](uint64_t n) {
                uint64_t i = n * beams_at_once;
                const uint64_t end = std::min(count, i + beams_at_once);
                while (i < end && is_right(i)) ++i;
                uint64_t known = first;
                while (i < end && i < known && !first.compare_exchange_weak(known, i)) {
                }
              });
    if (first < count) fail_at(first);
  }

  const msq_beams_def& def_;
  bool is_float32_;
  PointArray nodes_;
  Column<uint32_t> beams_;
  Numbers radii_;
  Column<uint8_t> caps_;
  Column<uint32_t> balls_;
  Numbers ball_radii_;
  double radius_, ball_radius_;
};

}  // namespace

msq_status msq_beams_def_init(msq_beams_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, beams_defaults(), "msq_beams_def"); });
}

msq_status msq_structure_beams(msq_context* context, const msq_beams_def* def,
                               msq_structure** structure, msq_job* job) {
  return guard([&] {
    const Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // memory may be short: it gives way until the end
    require(structure, "structure");
    const msq_beams_def known = read_def(def, beams_defaults(), "def");
    Job* work = job ? &object(job, "job") : nullptr;
    const Given given(known);
    JobScope scope(work);
    given.check(owner.executor, work);
    const BeamSource source{given.count(),
                            [&](uint64_t i, Beam& beam) { return given.get(i, beam); }};
    Ref<Structure> made =
        Beams::make(source, known.length_scale, owner.executor, owner.budget, work);
    given.keep_in(*made);
    scope.done();
    *structure = new_handle<msq_structure>(std::move(made));
  });
}

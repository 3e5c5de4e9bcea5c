// SPDX-License-Identifier: Apache-2.0
// Rays hit where membership first changes, against dense samples of membership: at random, along
// the axes, and past surfaces that they only just touch or miss, found by halving between rays that
// hit and rays that go on. Some are aimed at a point inside, which they must not pass. Normals are
// the gradient of the onset, and point out.
//
// 10^5 rays of one structure: contract_test_ray_hits "octet, thin" 100000; of every kind,
// scripts/test_rays.
#include <vector>

#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

size_t asked_rays = 0;  // of each row, on the command line
struct Failed {};       // a ray of those, which are counted

constexpr size_t ray_samples = 256, window_samples = 64;
constexpr size_t part_samples = 1024;  // of a part too short for windows: most parts fail soon

class Checker {
 public:
  Checker(const StructureRow& row, const Structure& structure, Parameter radius)
      : row_(row),
        structure_(structure),
        radius_(std::move(radius)),
        cell_(min_component(structure.neighbourhood().cell_size)),
        // Parts that are shorter may be overlooked.
        part_(std::max(structure.least_ray_step(), structure.ray_tolerance())),
        normal_limit_(row.is_lattice() && !row.kind.vary ? 3e-8 : 1e-5) {}

  RaySearch cast(const Ray& ray, double to) const {
    RaySearch search{ray, 0, to};
    structure_.enter(&search, 1);
    return search;
  }

  void check(const RaySearch& search) {
    const Ray& ray = search.ray;
    const double end = search.found ? search.t : search.to;
    window(ray, 0, end, ray_samples);
    if (!search.found) return;
    ++hits;
    const double t = search.t, tolerance = structure_.ray_tolerance();
    if (t < 0 || t > search.to) fail_at(ray, t, "is out of range");
    if (!structure_.inside(ray.at(t)) && !structure_.inside(ray.at(t + tolerance)))
      fail_at(ray, t, "is outside");
    if (t > 2 * part_ && is_inside(ray, t - 2 * part_, t - tolerance, part_samples))
      fail_at(ray, t, "comes late");
    // Where the ray came from, ever nearer.
    for (double width = 0.1 * cell_; width > 1e-8 * cell_; width *= 0.1)
      window(ray, std::max(0.0, t - width), t, window_samples);
    if (t > 0) check_normal(search);
  }

  /// A point on the ray lies in a part that rays must not overlook.
  bool is_seen(const Ray& ray, double t) const {
    for (double away : {0.0, -1.0, -0.5, 0.5, 1.0})
      if (!structure_.inside(ray.at(t + away * part_))) return false;
    return is_inside(ray, t - part_, t + part_, window_samples);
  }

  /// It hits at t or before.
  void check_aimed(const RaySearch& search, double t) const {
    if (!search.found || search.t > t + part_) fail_at(search.ray, t, "is inside, and passed");
  }

  /// Between two rays, one beside the other, that meet different surfaces: near the nearer surface.
  void check_graze(Ray near, Ray far, double to, double apart) {
    RaySearch a = cast(near, to), b = cast(far, to);
    const auto end_of = [](const RaySearch& s) { return s.found ? s.t : s.to; };
    if (end_of(a) > end_of(b)) std::swap(a, b);
    while (length(a.ray.origin - b.ray.origin) > apart) {
      Ray middle = a.ray;
      middle.origin = (a.ray.origin + b.ray.origin) * 0.5;
      const RaySearch m = cast(middle, to);
      (std::abs(end_of(m) - end_of(a)) < std::abs(end_of(m) - end_of(b)) ? a : b) = m;
      if (end_of(a) > end_of(b)) std::swap(a, b);
    }
    if (end_of(b) - end_of(a) < 0.01 * cell_) return;  // the same surface
    ++grazes;
    check(a);
    for (double width = 0.1 * cell_; width > 1e-6 * cell_; width *= 0.25)
      window(b.ray, std::max(0.0, end_of(a) - width), std::min(end_of(b), end_of(a) + width),
             window_samples);
  }

  size_t hits = 0, grazes = 0, normals = 0;
  size_t outward = 0, inward = 0;  // normals

 private:
  /// All samples in [from, to] are inside. Few do not say so: for some tolerances before a ray that
  /// grazes is inside for good, rounding decides, and membership changes from one number to the
  /// next.
  bool is_inside(const Ray& ray, double from, double to, size_t samples) const {
    for (size_t i = 0; i <= samples; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(samples);
      if (!structure_.inside(ray.at(from + (to - from) * part))) return false;
    }
    return true;
  }

  /// All samples in [from, to) are outside, but for parts that may be lost.
  void window(const Ray& ray, double from, double to, size_t samples) {
    points_.clear();
    const auto at = [&](size_t i) {
      return from + (to - from) * static_cast<double>(i) / static_cast<double>(samples);
    };
    for (size_t i = 0; i < samples; ++i) points_.push_back(ray.at(at(i)));
    alive_.assign(samples, 1);
    structure_.keep_points(points_.data(), alive_.data(), samples);
    for (size_t i = 0; i < samples; ++i) {
      if (!alive_[i] || at(i) > to - part_) continue;
      if (is_seen(ray, at(i))) fail_at(ray, to, "has a point inside before it", at(i));
    }
  }

  /// The gradient of the onset by differences, where that is smooth.
  void check_normal(const RaySearch& search) {
    const Vec3 n = search.normal, p = search.ray.at(search.t);
    if (!(std::abs(length(n) - 1) < 1e-9)) {
      if (dot(n, n) == 0) return;  // left to others
      fail_at(search.ray, search.t, "has a normal of another length");
    }
    const double step = 1e-5 * cell_;
    const bool is_out = !structure_.inside(p + n * step) && structure_.inside(p - n * step);
    ++(is_out ? outward : inward);
    if (!structure_.has_onset()) return;
    Vec3 gradient;
    bool is_smooth = true;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 along;
      along[axis] = step;
      const Difference wide = differ(p, along), narrow = differ(p, along * 0.6);
      gradient[axis] = wide.slope;
      const double off = std::abs(wide.slope - narrow.slope) + wide.kink;
      is_smooth = is_smooth && off < 0.1 * normal_limit_ * (std::abs(wide.slope) + 1);
    }
    const double size = length(gradient);
    if (!is_smooth || !(size > 0.1)) return;
    ++normals;
    const double off = length(n - gradient * (1 / size));
    if (!(off < normal_limit_)) fail_at(search.ray, search.t, "has another normal", off);
  }

  /// By how much the onset rises above the radius along an axis, and how much that jumps.
  struct Difference {
    double slope, kink;
  };
  Difference differ(Vec3 p, Vec3 step) const {
    double v[5];
    for (int i = 0; i < 5; ++i) {
      const Vec3 q = p + step * (i - 2);
      v[i] = structure_.onset(q) - radius_.at(q);
    }
    const double h = length(step);
    const double bend = v[1] - 2 * v[2] + v[3], wide_bend = v[0] - 2 * v[2] + v[4];
    return {(8 * (v[3] - v[1]) - (v[4] - v[0])) / (12 * h),
            std::abs(wide_bend - 4 * bend) / (4 * h)};
  }

  void fail_at(const Ray& ray, double t, const char* what, double at = 0) const {
    print_error("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): t = %.17g %s (%.17g)\n",
                row_.name.c_str(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                ray.direction.y, ray.direction.z, t, what, at);
    if (asked_rays) throw Failed{};
    _fail(__FILE__, __LINE__);
  }

  const StructureRow& row_;
  const Structure& structure_;
  const Parameter radius_;
  const double cell_, part_, normal_limit_;
  std::vector<Vec3> points_;
  std::vector<uint8_t> alive_;
};

/// Casts a ray, one in four at a point inside, and one in two with another beside it.
void test_ray(const StructureRow& row, const Structure& structure, Checker& checker, size_t i,
              Random& random) {
  const Neighbourhood& grid = row.variant.grid;
  const double to = 2.5 * row.unit();
  const auto point = [&] {
    return grid.from_grid(random.in_box({{-1, -1, -1}, {2, 2, 2}}) * grid.cell_size);
  };
  const Vec3 from = point();
  Vec3 target = point();
  if (i % 8 == 0) {  // along an axis of the grid
    Vec3 along;
    along[static_cast<int>(random.below(3))] = 1;
    target = from + grid.rotation.apply(along);
  }
  Ray ray{from, (target - from) * (1 / length(target - from))};
  double aimed = -1;
  for (int tries = 0; i % 4 == 1 && tries < 500 && aimed < 0; ++tries) {
    const Vec3 p = point();
    if (!structure.inside(p)) continue;
    const double t = random.between(0.1, 0.9) * to;
    ray.origin = p - ray.direction * t;
    if (checker.is_seen(ray, t)) aimed = t;
  }
  const RaySearch search = checker.cast(ray, to);
  if (aimed >= 0) checker.check_aimed(search, aimed);
  checker.check(search);
  if (i % 2) return;
  Ray beside = ray;
  const Vec3 across{random.normal(), random.normal(), random.normal()};
  beside.origin = ray.origin + across * (0.1 * row.unit());
  checker.check_graze(ray, beside, to, std::exp2(-random.between(4, 30)) * row.unit());
}

/// Rays that graze a strut, by name of row. Those that are inside at `inside` are for some 10^-5
/// cells around it, though no deeper than 10^-8 below the surface; of the other about one number
/// in two is inside in the last tolerances before its hit, and never a hundred in a row.
struct Graze {
  const char* row;
  Ray ray;
  double inside;  // or -1
};
constexpr Graze grazes[] = {
    {"cubic, ties, turned",
     {{-0.94520947975099712, -0.2411891513291588, 1.6900650912750186},
      {0.50162867075469952, 0.86212209465818002, -0.071513429361663702}},
     -1},
    {"octet, ties, turned, graded",
     {{1.9496972455690804, 1.0776144132603105, -1.0955140224842412},
      {0.0085023846776999933, 0.79066003807606833, 0.61219638486709704}},
     0.26852113580415443},
    {"octet, ties, turned, graded",
     {{-3.578522017986308, 1.0546618022806282, -3.8332355580592656},
      {0.76484218728448861, 0.64421768723769102, 0}},
     4.4534265316017416},
    {"foam DIRECT, jitter 0 r 0.1",
     {{1.2851384441127873, -1.0045542991754357, 1.0998971912549012},
      {0.1281784581470522, 0.99091028507381407, 0.040830011045517103}},
     0.00041476002988929397},
};

void test_graze(const StructureRow& row, Checker& checker, const Graze& graze) {
  const RaySearch search = checker.cast(graze.ray, 2.5 * row.unit());
  if (graze.inside >= 0) {
    assert_true(checker.is_seen(graze.ray, graze.inside));
    checker.check_aimed(search, graze.inside);
  }
  checker.check(search);
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(grid.cell_size * 0.5);
  const Ref<const Structure> structure = row.make(centre);
  Checker checker(row, *structure, row.parameter(centre));
  Random random(row.index + 17);
  const size_t count =
      asked_rays ? asked_rays : row.samples((row.is_lattice() ? 60 : 8) * row.family_rows);
  size_t failures = 0;
  const auto count_failure = [&](auto&& test) {
    try {
      test();
    } catch (const Failed&) {
      ++failures;
    }
  };
  for (const Graze& graze : grazes)
    if (row.name == graze.row) count_failure([&] { test_graze(row, checker, graze); });
  for (size_t i = 0; i < count; ++i)
    count_failure([&] { test_ray(row, *structure, checker, i, random); });
  if (asked_rays) {
    print_message("rays %zu hits %zu grazes %zu normals %zu failures %zu\n", count, checker.hits,
                  checker.grazes, checker.normals, failures);
    assert_int_equal(failures, 0);
  }
  assert_true(checker.hits > 0);
  if (count < 50) return;
  if (structure->has_onset()) assert_true(checker.normals > 0);
  if (checker.inward * 10 > checker.outward)
    fail_msg("%zu normals point in, %zu out", checker.inward, checker.outward);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<StructureRow> rows = structures_by_point();
  if (argc > 2) asked_rays = std::strtoull(argv[2], nullptr, 10);
  if (argc > 1)
    cmocka_set_test_filter(argv[1]);
  else  // the others by name only: their edges are dear, and test_rays.cpp asks a few
    std::erase_if(rows, [](const StructureRow& row) {
      const std::string tried = "foam DIRECT, density 1 to 30, jitter 1 r 0.06";
      return row.name.find("density") != std::string::npos && row.name != tried &&
             row.name != tried + ", graded";
    });
  return run_for_each("ray_hits", rows, test_row);
}

// SPDX-License-Identifier: Apache-2.0
// Seeds against make_seeds.py, which computes them from docs/seeds.md alone: see there for the
// meaning of the lines. The engine's numbers must be those of the file, to the last bit.
#include <bit>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "api/neighbourhood.h"
#include "msq_test.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/cell_seeds.h"
#include "structure/foam/seeds/seed_tile.h"
#include "structure/foam/seeds/seed_trees.h"

using namespace msq;

namespace {

/// The numbers of a line, in turn.
class Line {
 public:
  explicit Line(const std::string& text) : text_(text), in_(text) { in_ >> name; }

  std::string name;

  std::string word() {
    std::string w;
    if (!(in_ >> w)) fail_msg("too short: %s", text_.c_str());
    return w;
  }
  double number() {
    const std::string w = word();
    char* end;
    const double value = std::strtod(w.c_str(), &end);
    if (*end) fail_msg("%s is no number: %s", w.c_str(), text_.c_str());
    return value;
  }
  uint64_t bits() { return std::strtoull(word().c_str(), nullptr, 10); }
  int32_t index() { return static_cast<int32_t>(std::strtol(word().c_str(), nullptr, 10)); }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  CellIndex cell() {
    const int32_t x = index(), y = index(), z = index();
    return {x, y, z};
  }
  msq_neighbourhood grid() {
    msq_neighbourhood grid;
    for (double& v : grid.origin) v = number();
    for (double& v : grid.cell_size) v = number();
    for (double& v : grid.rotation) v = number();
    return grid;
  }
  void expect(bool is_met) const {
    if (!is_met) fail_msg("not so: %s", text_.c_str());
  }
  bool is_at_end() { return (in_ >> std::ws).eof(); }

 private:
  std::string text_;
  std::istringstream in_;
};

/// Words to one, as the file has it.
struct Hash {
  uint64_t value = 0;

  void add(uint64_t word) { value = splitmix_finalise(value ^ word); }
  void add(Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<uint64_t>(v[axis]));
  }
};

/// A field by a function alone.
class TestField final : public Field {
 public:
  TestField(double (*at)(const double* constants, Vec3 p), std::vector<double> constants,
            Interval range)
      : at_(at), constants_(std::move(constants)), range_(range) {}
  double at(Vec3 p) const override { return at_(constants_.data(), p); }
  Interval range() const override { return range_; }
  Interval range(const Box3&) const override { return range_; }
  void describe(HashInput&) const override {}

 private:
  double (*at_)(const double* constants, Vec3 p);
  std::vector<double> constants_;
  Interval range_;
};

double ramp(const double* c, Vec3 p) {
  return std::min(std::max(c[0] + c[1] * p.x + c[2] * p.y + c[3] * p.z, c[4]), c[5]);
}

double power_by_bits(const double*, Vec3 p) {
  Hash hash;
  for (double c : {p.z, p.y, p.x}) hash.add(std::bit_cast<uint64_t>(c));
  return std::ldexp(1.0, static_cast<int>(hash.value % 17) - 1);
}

Parameter read_density(Line& line) {
  const std::string kind = line.word();
  if (kind == "1") return Parameter(1);
  if (kind == "constant") return Parameter(line.number());
  if (kind == "bits")
    return Parameter(Ref<const Field>(
        make_ref<TestField>(power_by_bits, std::vector<double>{}, Interval{0.5, 32768})));
  line.expect(kind == "ramp");
  std::vector<double> constants;
  for (int i = 0; i < 6; ++i) constants.push_back(line.number());
  const Interval range{constants[4], constants[5]};
  return Parameter(Ref<const Field>(make_ref<TestField>(ramp, constants, range)));
}

Ref<const Foam> make_foam(const msq_neighbourhood& grid, uint64_t seed, double jitter,
                          const Parameter& density, double radius) {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{16} << 20, uint64_t{0});
  return make_ref<Foam>(context, api::read_neighbourhood(grid), Parameter(radius), jitter, seed,
                        FoamMethod::direct, density);
}

/// Whether the seeds around a cell, which vectors compute too, have the bits of FoamSeeds::at().
bool has_seeds_around(const FoamSeeds& seeds, CellIndex cell) {
  CellSeeds around;
  around.move_to(seeds, cell);
  std::vector<uint32_t> found;
  const CellSeeds::Block& block = around.find_near({0, 0, 0}, 0.5, found);
  uint32_t i = 0;
  for (int z = -block.half[2]; z <= block.half[2]; ++z)
    for (int y = -block.half[1]; y <= block.half[1]; ++y)
      for (int x = -block.half[0]; x <= block.half[0]; ++x, ++i)
        if (!(block.position(i) == seeds.at(cell, x, y, z))) return false;
  return i == block.count;
}

/// Of cells from a corner on, by the vectors that fill tiles. 0 if others differ.
uint64_t hash_of_tile(const FoamSeeds& seeds, CellIndex corner, int side) {
  if (!has_seeds_around(seeds, corner)) return 0;
  SeedTile tile;
  tile.build(seeds, corner, {side, side, side}, {0, 0, 0});
  Hash hash;
  for (int n = 0; n < side * side * side; ++n) {
    const CellIndex cell{corner.x + n % side, corner.y + n / side % side,
                         corner.z + n / side / side};
    const size_t i = tile.index(cell);
    const Vec3 seed{tile.fraction(0)[i], tile.fraction(1)[i], tile.fraction(2)[i]};
    if (!(seed == seeds.fractions(seeds.bits(cell)))) return 0;
    hash.add(seed);
  }
  return hash.value;
}

/// The leaves of a cell as searches find them.
struct Leaves {
  std::vector<LeafSeed> found;
  std::vector<uint32_t> paths;
  std::vector<Vec3> in_cell;
};
void append_leaves(const GradedSeeds& seeds, const GradedSeeds::Node& node, Leaves& leaves) {
  if (!seeds.splits(node)) {
    leaves.paths.push_back(node.path);
    leaves.in_cell.push_back(seeds.in_leaf(node));
    return;
  }
  for (uint32_t octant = 0; octant < 8; ++octant) append_leaves(seeds, node.child(octant), leaves);
}
Leaves leaves_of(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell) {
  Leaves leaves;
  append_leaves(*seeds, {cell}, leaves);
  SeedTrees trees;
  trees.move_to(seeds);
  const CellIndex home{cell.x - 2, cell.y + 3, cell.z - 1};
  trees.visit_cell(home, cell, [&](const LeafSeed& seed) { leaves.found.push_back(seed); });
  return leaves;
}

using PointSetOfBits = std::set<std::array<uint64_t, 3>>;

std::array<uint64_t, 3> as_bits(Vec3 p) {
  return {std::bit_cast<uint64_t>(p.x), std::bit_cast<uint64_t>(p.y), std::bit_cast<uint64_t>(p.z)};
}

int32_t note_points(void* seen, const double* points, uint64_t count, uint8_t* inside) {
  for (uint64_t i = 0; i < count; ++i) {
    const double* p = points + 3 * i;
    static_cast<PointSetOfBits*>(seen)->insert(as_bits({p[0], p[1], p[2]}));
    inside[i] = 1;
  }
  return 0;
}

/// What a statistic over segments of length 1 asks a shape of the host's.
PointSetOfBits segment_ends(const msq_points_def& sample) {
  PointSetOfBits seen;
  msq_context* context;
  assert_ok(msq_context_create(nullptr, &context));
  msq_host_shape_def shape_def;
  assert_ok(msq_host_shape_def_init(&shape_def, sizeof shape_def));
  shape_def.inside = note_points;
  shape_def.user = &seen;
  for (int axis = 0; axis < 3; ++axis) shape_def.min[axis] = -(shape_def.max[axis] = 1e6);
  msq_shape* shape;
  assert_ok(msq_shape_from_host(context, &shape_def, &shape));
  msq_scale_def scale{};
  scale.shape = shape;
  msq_model_def model_def;
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scale_count = 1;
  model_def.scales = &scale;
  msq_model* model;
  assert_ok(msq_model_create(context, &model_def, &model));
  msq_segments_def segments;
  assert_ok(msq_segments_def_init(&segments, sizeof segments));
  const double length = 1;
  segments.lengths = &length;
  segments.length_count = 1;
  msq_estimate estimate;
  assert_ok(msq_two_point_correlation(model, &sample, nullptr, &segments, &estimate, 1, nullptr));
  msq_model_release(model);
  msq_shape_release(shape);
  msq_context_release(context);
  return seen;
}

class Checker {
 public:
  void check(Line line) {
    ++counts_[line.name];
    if (line.name == "foam") return read_foam(line);
    if (line.name == "sample") return read_sample(line);
    const std::map<std::string, void (Checker::*)(Line&)> checks{
        {"mix", &Checker::check_mix},         {"turn", &Checker::check_turn},
        {"place", &Checker::check_place},     {"cell", &Checker::check_cell},
        {"from", &Checker::check_from},       {"block", &Checker::check_block},
        {"leaves", &Checker::check_leaves},   {"leaf", &Checker::check_leaf},
        {"nearest", &Checker::check_nearest}, {"inside", &Checker::check_inside},
        {"point", &Checker::check_point},     {"direction", &Checker::check_direction}};
    const auto found = checks.find(line.name);
    line.expect(found != checks.end());
    (this->*found->second)(line);
    line.expect(line.is_at_end());
  }

  /// Each kind of line occurs; both answers of "inside" do.
  void finish() const {
    for (const char* name : {"mix", "turn", "foam", "place", "cell", "from", "block", "leaves",
                             "leaf", "nearest", "inside", "sample", "point", "direction"}) {
      const auto count = counts_.find(name);
      if (count == counts_.end()) fail_msg("no line begins with %s", name);
      print_message("%s: %zu\n", name, count->second);
    }
    assert_in_range(inside_, 100, counts_.at("inside") - 100);
  }

 private:
  void read_foam(Line& line) {
    seed_ = line.bits();
    jitter_ = line.number();
    grid_ = line.grid();
    density_ = read_density(line);
    foam_ = make_foam(grid_, seed_, jitter_, density_, 0.1);
  }
  const FoamSeeds& seeds() const { return foam_->seeds(); }

  void check_mix(Line& line) {
    const uint64_t x = line.bits();
    line.expect(splitmix_finalise(x) == line.bits());
    line.expect(splitmix_output(x, 7) == line.bits());
    line.expect(random_fraction(x) == line.number());
  }

  void check_turn(Line& line) {
    msq_neighbourhood grid = api::neighbourhood_defaults();
    for (double& v : grid.rotation) v = line.number();
    for (double v : api::read_neighbourhood(grid).rotation.m) line.expect(v == line.number());
  }

  void check_place(Line& line) {
    const Neighbourhood::Located located = foam_->neighbourhood().locate(line.vector());
    line.expect(located.cell == line.cell());
    line.expect(located.fraction == line.vector());
  }

  void check_cell(Line& line) {
    const CellIndex cell = line.cell();
    const uint64_t bits = line.bits();
    line.expect(seeds().bits(cell) == bits);
    line.expect(seeds().fractions(bits) == line.vector());
  }

  void check_from(Line& line) {
    const CellIndex home = line.cell(), cell = line.cell();
    line.expect(seeds().at(home, cell.x - home.x, cell.y - home.y, cell.z - home.z) ==
                line.vector());
  }

  void check_block(Line& line) {
    const CellIndex corner = line.cell();
    const int side = line.index();
    line.expect(hash_of_tile(seeds(), corner, side) == line.bits());
  }

  void check_leaves(Line& line) {
    const CellIndex cell = line.cell();
    leaves_ = leaves_of(foam_->graded(), cell);
    leaf_ = 0;
    line.expect(leaves_.paths.size() == line.bits());
    line.expect(leaves_.found.size() == leaves_.paths.size());
    Hash hash;
    for (size_t i = 0; i < leaves_.paths.size(); ++i) {
      hash.add(leaves_.paths[i]);
      hash.add(leaves_.in_cell[i]);
      // From a cell beside it.
      const Vec3 in_cell = leaves_.in_cell[i];
      line.expect(leaves_.found[i].position ==
                  Vec3{2 + in_cell.x, -3 + in_cell.y, 1 + in_cell.z} * seeds().scale());
      line.expect(i == 0 || leaves_.found[i].order > leaves_.found[i - 1].order);
    }
    line.expect(hash.value == line.bits());
  }

  void check_leaf(Line& line) {
    line.cell();
    line.expect(leaves_.paths[leaf_] == line.bits());
    line.expect(leaves_.in_cell[leaf_] == line.vector());
    ++leaf_;
  }

  void check_nearest(Line& line) {
    const Vec3 p = line.vector();
    const CellIndex cell = line.cell();
    const uint64_t path = line.bits();
    const Neighbourhood::Located located = foam_->neighbourhood().locate(p);
    const Vec3 q = located.fraction * seeds().scale();
    SeedTrees trees;
    trees.move_to(foam_->graded());
    LeafSeed nearest = trees.at(located.cell, q);
    const Vec3 d = nearest.position - q;
    double squared = dot(d, d);
    trees.nearest(located.cell, q, squared, nearest, [](const LeafSeed&) { return true; });
    const Leaves there = leaves_of(foam_->graded(), cell);
    const CellIndex from{cell.x - located.cell.x, cell.y - located.cell.y, cell.z - located.cell.z};
    for (size_t i = 0; i < there.paths.size(); ++i) {
      if (there.paths[i] != path) continue;
      const Vec3 in_cell = there.in_cell[i];
      return line.expect(nearest.position ==
                         Vec3{from.x + in_cell.x, from.y + in_cell.y, from.z + in_cell.z} *
                             seeds().scale());
    }
    line.expect(false);
  }

  void check_inside(Line& line) {
    const Vec3 p = line.vector();
    const double radius = line.number();
    const bool is_inside = make_foam(grid_, seed_, jitter_, density_, radius)->inside(p);
    line.expect(is_inside == (line.bits() == 1));
    inside_ += is_inside;
  }

  void read_sample(Line& line) {
    assert_ok(msq_points_def_init(&sample_, sizeof sample_));
    sample_.kind = MSQ_POINTS_STRATIFIED;
    sample_.seed = line.bits();
    sample_.per_cell = static_cast<uint32_t>(line.bits());
    for (uint64_t& count : sample_.counts) count = line.bits();
    const msq_neighbourhood grid = line.grid();
    std::copy_n(grid.origin, 3, sample_.origin);
    std::copy_n(grid.cell_size, 3, sample_.spacing);
    std::copy_n(grid.rotation, 9, sample_.rotation);
    ends_.clear();
  }

  void check_point(Line& line) {
    const Vec3 p = point(line.bits());
    line.expect(p == line.vector());
  }
  Vec3 point(uint64_t number) const {
    Vec3 p;
    assert_ok(msq_points_generate(&sample_, number, 1, &p.x));
    return p;
  }

  void check_direction(Line& line) {
    if (ends_.empty()) ends_ = segment_ends(sample_);
    const Vec3 p = point(line.bits()), direction = line.vector();
    line.expect(ends_.count(as_bits(p + direction)) == 1);
  }

  std::map<std::string, size_t> counts_;
  uint64_t seed_ = 0;
  double jitter_ = 0;
  msq_neighbourhood grid_ = {};
  Parameter density_;
  Ref<const Foam> foam_;
  Leaves leaves_;
  size_t leaf_ = 0, inside_ = 0;
  msq_points_def sample_ = {};
  PointSetOfBits ends_;  // of segments of length 1
};

void test_golden(void**) {
  std::ifstream file(MSQ_SOURCE_DIR "/tests/golden/seeds.txt");
  Checker checker;
  for (std::string text; std::getline(file, text);)
    if (!text.empty() && text[0] != '#') checker.check(Line(text));
  checker.finish();
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_golden)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

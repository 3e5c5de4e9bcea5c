// SPDX-License-Identifier: Apache-2.0
// Many beams in one place. Equal beams count once, but each is listed. Rows of samples among beams
// that are nearly equal, or that cross in one point, look at few of them for each sample.
#include <set>

#include "base/digest.h"
#include "beam_lists.h"
#include "bit_rows.h"
#include "msq_test.h"
#include "random.h"
#include "structure/beams/beam_samples.h"
#include "structure/common/struts.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Beams> make(const std::vector<Beam>& beams, unsigned threads = 2) {
  const Executor executor(threads);
  return Beams::make(source_of(beams), 0, executor, std::make_shared<MemoryBudget>(uint64_t{0}),
                     nullptr);
}

Beam slanting() {
  return {{0.1, 0.2, 0.1}, {0.9, 0.7, 0.9}, 0.02, 0.02, BeamCap::sphere, BeamCap::sphere};
}

/// Beams through the middle of the unit cube.
std::vector<Beam> star(size_t count) {
  Random random(1);
  std::vector<Beam> beams;
  while (beams.size() < count) {
    const Vec3 d = random.in_box({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}), middle{0.5, 0.5, 0.5};
    beams.push_back({middle - d, middle + d, 0.002, 0.002, BeamCap::sphere, BeamCap::butt});
  }
  return beams;
}

/// Copies of one beam that differ in the last digits.
std::vector<Beam> bundle(size_t count) {
  std::vector<Beam> beams(count, slanting());
  for (size_t i = 0; i < count; ++i) beams[i].b.x += 1e-12 * static_cast<double>(i);
  return beams;
}

/// Each of `different` beams `times` times, one after another or all of them again and again.
std::vector<Beam> repeated(const std::vector<Beam>& different, size_t times, bool in_turns) {
  std::vector<Beam> beams;
  for (size_t i = 0; i < different.size() * times; ++i)
    beams.push_back(different[in_turns ? i % different.size() : i / times]);
  return beams;
}

void equal_beams_count_once(void**) {
  std::vector<Beam> different = star(300);
  different.push_back(slanting());
  for (int change = 0; change < 5; ++change) {  // that differ in one number
    Beam beam = slanting();
    if (change == 0) beam.radius_b = 0.03;
    if (change == 1) beam.cap_a = BeamCap::butt;
    if (change == 2) beam.cap_b = BeamCap::hemisphere;
    if (change == 3) std::swap(beam.a, beam.b);
    if (change == 4) beam.radius_a = std::nextafter(beam.radius_a, 1);
    different.push_back(beam);
  }
  for (const bool in_turns : {false, true})
    for (const size_t times : {size_t{1}, size_t{2}, size_t{300}}) {
      const std::vector<Beam> beams = repeated(different, times, in_turns);
      const Ref<Beams> made = make(beams), alone = make(beams, 1);
      assert_int_equal(made->beams().size(), different.size());
      assert_int_equal(made->repeats().size(), (times - 1) * different.size());
      assert_true(made->repeats() == alone->repeats());
      size_t visited = 0;
      made->tree().find_overlapping(made->tree().box(), [&](size_t begin, size_t end) {
        visited += end - begin;
        return true;
      });
      assert_int_equal(visited, different.size());
    }
}

void equal_beams_are_listed_each(void**) {
  const std::vector<Beam> beams = repeated(bundle(7), 3000, true);
  const Ref<Beams> made = make(beams);
  for (const bool is_owned : {false, true}) {
    const std::unique_ptr<StrutParts> parts = made->struts({{{0, 0, 0}, {1, 1, 1}}, is_owned});
    std::set<uint64_t> numbers;
    for (uint64_t part = 0; part < parts->count(); ++part) {
      StrutList list;
      parts->append(part, list);
      assert_in_range(list.struts.size(), 1, 4096);
      for (const Strut& strut : list.struts) {
        const Beam& beam = beams.at(strut.id.low);
        assert_true(strut.a == beam.a && strut.b == beam.b && strut.radii[1] == beam.radius_b);
        assert_true(numbers.insert(strut.id.low).second);
      }
    }
    assert_int_equal(numbers.size(), beams.size());
  }
}

void the_hash_counts_each_beam(void**) {
  if (!can_hash()) return;
  const std::vector<Beam> two = bundle(2);
  const auto hash_of = [](const std::vector<Beam>& beams) { return make(beams)->hash(); };
  const Hash once = hash_of(two), twice = hash_of({two[0], two[1], two[0]}),
             other = hash_of({two[0], two[1], two[1]});
  assert_true(once != twice && once != other && twice != other);
  assert_true(twice == hash_of({two[0], two[1], two[0]}));
}

/// Compares the samples of a layer with the definition. Returns how many beams were looked at.
uint64_t check_samples(const std::vector<Beam>& beams, double pitch, uint64_t layers,
                       size_t& held) {
  const Ref<Beams> made = make(beams);
  SampleGrid grid;
  grid.origin = {0, 0, 0.453};
  grid.spacing = {pitch, pitch, pitch};
  grid.nx = grid.ny = static_cast<uint64_t>(1 / pitch);
  grid.nz = layers;
  BitRows rows(grid);
  const RowBlock& block = rows.block();
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j) set_bits(block.row(j, k), j % 3, grid.nx - 1);
  BeamSamples samples(*made, block, nullptr);
  samples.keep();
  assert_int_equal(rows.damage(), 0);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const bool expected = i >= j % 3 && made->inside(grid.at(i, j, k));
        held += expected;
        if (rows.get(i, j, k) != expected)
          fail_msg("sample %d, %d, %d is %d", int(i), int(j), int(k), !expected);
      }
  return samples.looks();
}

void samples_among_many_beams_look_at_few(void**) {
  constexpr size_t count = 4000;
  for (const uint64_t layers : {1, 3}) {
    size_t held = 0;
    const uint64_t side = 64, samples = side * side * layers;
    // One by one, each sample in the boxes of all looks at all.
    const uint64_t in_bundle = check_samples(bundle(count), 1.0 / side, layers, held);
    assert_in_range(held, 1, samples / 10);
    const uint64_t in_star = check_samples(star(count), 1.0 / side, layers, held);
    assert_in_range(held, samples / 40, samples * 9 / 10);
    print_message("%g and %g beams looked at for a sample\n", double(in_bundle) / double(samples),
                  double(in_star) / double(samples));
    assert_in_range(in_bundle, 1, samples * count / 8);
    assert_in_range(in_star, 1, samples * count / 8);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(equal_beams_count_once),
      cmocka_unit_test(equal_beams_are_listed_each),
      cmocka_unit_test(the_hash_counts_each_beam),
      cmocka_unit_test(samples_among_many_beams_look_at_few),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

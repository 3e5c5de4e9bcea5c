// SPDX-License-Identifier: Apache-2.0
// Components of stacks of layers, and thin samples, against flood fills and loops over samples.
#include "printability/components.h"

#include <algorithm>
#include <array>
#include <deque>
#include <tuple>

#include <hwy/targets.h>

#include "msq_test.h"
#include "printability/bit_row.h"
#include "printability/thin.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

using Index = std::array<int, 3>;

/// A stack of samples.
struct Volume {
  Volume(int nx, int ny, int nz)
      : n{nx, ny, nz}, samples(static_cast<size_t>(nx) * static_cast<size_t>(ny * nz)) {}

  bool holds(const Index& p) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] >= n[axis]) return false;
    return true;
  }
  size_t at(const Index& p) const {
    return static_cast<size_t>(p[0]) +
           static_cast<size_t>(n[0]) *
               (static_cast<size_t>(p[1]) + static_cast<size_t>(n[1]) * static_cast<size_t>(p[2]));
  }
  bool get(const Index& p) const { return holds(p) && samples[at(p)]; }

  std::vector<uint64_t> layer(int k) const {
    const size_t words = words_for(static_cast<uint64_t>(n[0]));
    std::vector<uint64_t> rows(words * static_cast<size_t>(n[1]));
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (get({i, j, k}))
          rows[static_cast<size_t>(j) * words + static_cast<size_t>(i) / 64] |= uint64_t{1}
                                                                                << i % 64;
    return rows;
  }

  Index n;
  std::vector<uint8_t> samples;
};

/// What a component must be found as.
using Found = std::tuple<uint64_t, uint64_t, uint64_t, std::array<uint32_t, 6>>;

Found found_of(const ComponentTotals& totals) {
  return {totals.first_layer,
          totals.last_layer,
          totals.samples,
          {totals.place[0], totals.place[1], totals.low[0], totals.low[1], totals.high[0],
           totals.high[1]}};
}

struct FoundAll {
  std::vector<Found> ended, islands, cups;
};

/// Neighbours of a sample; within its layer alone if `flat`.
std::vector<Index> neighbours(const Index& p, bool joins_corners, bool flat) {
  std::vector<Index> all;
  for (int dj = -1; dj <= 1; ++dj)
    for (int di = -1; di <= 1; ++di)
      if ((di || dj) && (joins_corners || !(di && dj))) all.push_back({p[0] + di, p[1] + dj, p[2]});
  if (flat) return all;
  all.push_back({p[0], p[1], p[2] - 1});
  all.push_back({p[0], p[1], p[2] + 1});
  return all;
}

template <class Take>
void flood(const Volume& volume, bool joins_corners, bool flat, Take&& take) {
  std::vector<uint8_t> seen(volume.samples.size());
  for (int k = 0; k < volume.n[2]; ++k)
    for (int j = 0; j < volume.n[1]; ++j)
      for (int i = 0; i < volume.n[0]; ++i) {
        const Index start{i, j, k};
        if (!volume.get(start) || seen[volume.at(start)]) continue;
        std::vector<Index> all;
        std::deque<Index> queue{start};
        seen[volume.at(start)] = 1;
        while (!queue.empty()) {
          const Index p = queue.front();
          queue.pop_front();
          all.push_back(p);
          for (const Index& q : neighbours(p, joins_corners, flat))
            if (volume.get(q) && !seen[volume.at(q)]) {
              seen[volume.at(q)] = 1;
              queue.push_back(q);
            }
        }
        take(start, all);
      }
}

Found found_of(const Index& start, const std::vector<Index>& all) {
  ComponentTotals totals;
  totals.first_layer = totals.last_layer = static_cast<uint64_t>(start[2]);
  totals.place[0] = static_cast<uint32_t>(start[0]);
  totals.place[1] = static_cast<uint32_t>(start[1]);
  for (const Index& p : all) {
    totals.add_run(static_cast<uint32_t>(p[0]), static_cast<uint32_t>(p[0]),
                   static_cast<uint32_t>(p[1]));
    totals.last_layer = std::max(totals.last_layer, static_cast<uint64_t>(p[2]));
  }
  return found_of(totals);
}

bool is_anchored(const Volume& volume, const Components::Rules& rules, const Index& p) {
  if (rules.anchors_first_layer && p[2] == 0) return true;
  return rules.anchors_sides &&
         (p[0] == 0 || p[1] == 0 || p[0] == volume.n[0] - 1 || p[1] == volume.n[1] - 1);
}

/// The layers up to k.
Volume lower_part(const Volume& volume, int k) {
  Volume part(volume.n[0], volume.n[1], k + 1);
  std::copy_n(volume.samples.begin(), part.samples.size(), part.samples.begin());
  return part;
}

/// By the definition: components of the layers up to k, which the next layer joins to an anchor.
std::vector<Found> cups_by_flood(const Volume& volume, const Components::Rules& rules) {
  std::vector<Found> cups;
  for (int k = 0; k + 1 < volume.n[2]; ++k) {
    const Volume lower = lower_part(volume, k), upper = lower_part(volume, k + 1);
    std::vector<uint8_t> opens(upper.samples.size());
    flood(upper, rules.joins_corners, false, [&](const Index&, const std::vector<Index>& all) {
      bool anchored = false;
      for (const Index& p : all) anchored = anchored || is_anchored(volume, rules, p);
      if (anchored)
        for (const Index& p : all) opens[upper.at(p)] = 1;
    });
    flood(lower, rules.joins_corners, false,
          [&](const Index& start, const std::vector<Index>& all) {
            bool reaches = false;
            for (const Index& p : all) {
              if (is_anchored(volume, rules, p)) return;
              reaches = reaches || p[2] == k;
            }
            if (reaches && opens[lower.at(start)]) cups.push_back(found_of(start, all));
          });
  }
  return cups;
}

FoundAll by_flood(const Volume& volume, const Components::Rules& rules) {
  FoundAll result;
  flood(volume, rules.joins_corners, false, [&](const Index& start, const std::vector<Index>& all) {
    for (const Index& p : all)
      if (is_anchored(volume, rules, p)) return;
    result.ended.push_back(found_of(start, all));
  });
  if (rules.finds_islands)
    flood(volume, rules.joins_corners, true,
          [&](const Index& start, const std::vector<Index>& all) {
            if (start[2] == 0) return;
            for (const Index& p : all)
              if (volume.get({p[0], p[1], p[2] - 1})) return;
            result.islands.push_back(found_of(start, all));
          });
  if (rules.finds_cups) result.cups = cups_by_flood(volume, rules);
  return result;
}

/// In the order in which they are found.
FoundAll by_layers(const Volume& volume, const Components::Rules& rules, unsigned bands) {
  FoundAll result;
  double heights = 0, samples = 0;
  Components components(static_cast<uint64_t>(volume.n[0]), static_cast<uint64_t>(volume.n[1]),
                        rules, bands);
  const auto take = [&](const Components::Events& events) {
    for (const ComponentTotals& totals : events.ended) {
      result.ended.push_back(found_of(totals));
      heights += totals.height_sum;
      samples += static_cast<double>(totals.samples);
    }
    for (const ComponentTotals& totals : events.islands) result.islands.push_back(found_of(totals));
    for (const ComponentTotals& totals : events.cups) result.cups.push_back(found_of(totals));
  };
  for (int k = 0; k < volume.n[2]; ++k) {
    const std::vector<uint64_t> rows = volume.layer(k);
    // Bands may come in any order.
    for (unsigned b = bands; b-- > 0;) components.scan(b, rows.data());
    components.join(0.5);
    for (unsigned b = 0; b < bands; ++b) components.settle((b + 1) % bands);
    take(components.finish());
  }
  take(components.end());
  assert_true(heights == 0.5 * samples);
  return result;
}

void assert_same(std::vector<Found> got, std::vector<Found> wanted, const char* what) {
  std::sort(got.begin(), got.end());
  std::sort(wanted.begin(), wanted.end());
  if (got != wanted) fail_msg("%s: %zu found, %zu wanted", what, got.size(), wanted.size());
}

/// Kernels use one of the machine's instruction sets meanwhile.
class AnyInstructionSet {
 public:
  explicit AnyInstructionSet(Random& random) {
    std::vector<int64_t> sets;
    for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1)
      sets.push_back(all & -all);
    hwy::SetSupportedTargetsForTest(sets[random.below(sets.size())]);
  }
  ~AnyInstructionSet() { hwy::SetSupportedTargetsForTest(0); }
};

void check(const Volume& volume) {
  static Random random(7);
  for (int bits = 0; bits < 16; ++bits) {
    Components::Rules rules;
    rules.joins_corners = bits & 1;
    rules.anchors_sides = bits & 2;
    rules.anchors_first_layer = bits & 4;
    rules.finds_islands = bits & 8;
    // The flood of each layer's cups takes long.
    rules.finds_cups = rules.anchors_sides && volume.samples.size() < 10000;
    // Anchored samples at a side have nothing below them.
    if (rules.anchors_sides && rules.finds_islands) continue;
    const FoundAll wanted = by_flood(volume, rules);
    FoundAll first;
    const auto most = static_cast<unsigned>(strips_for(static_cast<uint64_t>(volume.n[1])));
    for (const unsigned bands : {1u, std::min(2u, most), std::min(5u, most), most}) {
      const AnyInstructionSet set(random);
      const FoundAll got = by_layers(volume, rules, bands);
      if (bands == 1) {
        assert_same(got.ended, wanted.ended, "components");
        assert_same(got.islands, wanted.islands, "islands");
        assert_same(got.cups, wanted.cups, "cups");
        first = got;
      }
      // In the same order, too.
      if (got.ended != first.ended || got.islands != first.islands || got.cups != first.cups)
        fail_msg("%d x %d x %d samples, rules %d: %u bands find others than one", volume.n[0],
                 volume.n[1], volume.n[2], bits, bands);
    }
  }
}

void test_random_volumes(void**) {
  Random random(1);
  const size_t count = std::max<size_t>(test_count(400), 40);
  for (size_t n = 0; n < count; ++n) {
    // Now and then rows of several words, also of whole ones.
    const bool is_wide = n % 4 == 0, has_whole_words = n % 8 == 0;
    const int width = has_whole_words ? 64 * (1 + static_cast<int>(random.below(3)))
                                      : 1 + static_cast<int>(random.below(is_wide ? 200 : 12));
    Volume volume(width, 1 + static_cast<int>(random.below(is_wide ? 6 : 12)),
                  1 + static_cast<int>(random.below(6)));
    const double density = random.unit();
    for (uint8_t& sample : volume.samples) sample = random.unit() < density;
    check(volume);
  }
}

/// Long corridors: walls of a maze, in which floods by rows do not see everything.
void test_mazes(void**) {
  Random random(2);
  const size_t count = std::max<size_t>(test_count(60), 12);
  for (size_t n = 0; n < count; ++n) {
    Volume volume(9 + 2 * static_cast<int>(random.below(60)),
                  9 + 2 * static_cast<int>(random.below(6)), 3);
    for (int k = 0; k < volume.n[2]; ++k)
      for (int j = 0; j < volume.n[1]; ++j)
        for (int i = 0; i < volume.n[0]; ++i) {
          const bool is_wall = (i % 2 == 0 && j % 2 == 0) || (i % 2 == 0 && random.unit() < 0.6) ||
                               (j % 2 == 0 && random.unit() < 0.6);
          volume.samples[volume.at({i, j, k})] = is_wall != (n % 2 == 0);
        }
    check(volume);
  }
}

/// Sticks of random directions, as structures have them.
void test_sticks(void**) {
  Random random(3);
  const size_t count = std::max<size_t>(test_count(16), 4);
  for (size_t n = 0; n < count; ++n) {
    Volume volume(90, 30, 24);
    for (int stick = 0; stick < 40; ++stick) {
      double p[3], step[3];
      for (size_t axis = 0; axis < 3; ++axis) {
        p[axis] = random.unit() * volume.n[axis];
        step[axis] = random.between(-1, 1);
      }
      for (int at = 0; at < 30; ++at) {
        const Index index{static_cast<int>(p[0]), static_cast<int>(p[1]), static_cast<int>(p[2])};
        if (volume.holds(index)) volume.samples[volume.at(index)] = 1;
        for (size_t axis = 0; axis < 3; ++axis) p[axis] += step[axis];
      }
    }
    if (n % 2)
      for (uint8_t& sample : volume.samples) sample = !sample;
    check(volume);
  }
}

/// A spiral, which no flood by rows follows to its end, on a stick at its inner end.
void test_spiral(void**) {
  Volume volume(70, 19, 2);
  int low[2] = {0, 0}, high[2] = {69, 18};
  Index p{0, 0, 1};
  const auto go = [&](int axis, int to) {
    const auto a = static_cast<size_t>(axis);
    while (p[a] != to) {
      volume.samples[volume.at(p)] = 1;
      p[a] += to > p[a] ? 1 : -1;
    }
    volume.samples[volume.at(p)] = 1;
  };
  while (low[1] + 4 <= high[1]) {
    go(0, high[0]);
    go(1, high[1]);
    go(0, low[0]);
    low[0] += 2, low[1] += 2;
    go(1, low[1]);
    high[0] -= 2, high[1] -= 2;
  }
  check(volume);
  volume.samples[volume.at({p[0], p[1], 0})] = 1;
  check(volume);
}

bool is_thin(const Volume& volume, int i, int j, const unsigned across[2]) {
  const int nx = static_cast<int>(across[0]), ny = static_cast<int>(across[1]);
  const auto square = [](int index, int count) {
    const double offset = (2.0 * index + 1) / count - 1;
    return offset * offset;
  };
  // Discs whose block begins at (x, y).
  for (int y = j - 2 * ny; y <= j + ny; ++y)
    for (int x = i - 2 * nx; x <= i + nx; ++x) {
      if (square(i - x, nx) + square(j - y, ny) > 2 * (1 + 1e-9)) continue;
      bool fits = true;
      for (int b = 0; b < ny && fits; ++b)
        for (int a = 0; a < nx && fits; ++a)
          if (square(a, nx) + square(b, ny) <= 1 + 1e-9) fits = volume.get({x + a, y + b, 0});
      if (fits) return false;
    }
  return true;
}

/// Thin samples, found in bands.
std::vector<uint64_t> thin_of(const ThinSamples& thin, const Volume& volume, unsigned bands) {
  const std::vector<uint64_t> rows = volume.layer(0);
  std::vector<uint64_t> found(rows.size(), ~uint64_t{0});
  const auto ny = static_cast<uint64_t>(volume.n[1]);
  const size_t words = words_for(static_cast<uint64_t>(volume.n[0]));
  for (unsigned b = 0; b < bands; ++b) {
    const uint64_t begin = ny * b / bands, end = ny * (b + 1) / bands;
    std::vector<uint64_t> scratch(thin.scratch_words(words), ~uint64_t{0});
    thin.find({rows.data(), words, ny}, begin, end, scratch.data(), found.data());
  }
  return found;
}

void test_overhangs(void**) {
  Random random(7);
  const size_t count = std::max<size_t>(test_count(200), 30);
  for (size_t n = 0; n < count; ++n) {
    Volume volume(1 + static_cast<int>(random.below(n % 8 == 7 ? 1200 : 150)),
                  1 + static_cast<int>(random.below(40)), 2);
    const double density[2] = {n % 3 ? 0.01 : 0.3, 0.7};
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < volume.n[1]; ++j)
        for (int i = 0; i < volume.n[0]; ++i)
          volume.samples[volume.at({i, j, k})] = random.unit() < density[k];
    const double pitch[2] = {random.between(0.5, 2), random.between(0.5, 2)};
    const double distance = n % 5 == 0   ? static_cast<double>(random.below(4)) * pitch[0]
                            : n % 7 == 0 ? 31 * std::min(pitch[0], pitch[1])
                                         : random.between(0, 6) * std::min(pitch[0], pitch[1]);
    const OverhangSamples overhangs(distance, pitch);
    const size_t words = words_for(static_cast<uint64_t>(volume.n[0]));
    const std::vector<uint64_t> below = volume.layer(0), rows = volume.layer(1);
    std::vector<uint64_t> found(rows.size(), ~uint64_t{0}),
        scratch(overhangs.scratch_words(words), ~uint64_t{0});
    const auto ny = static_cast<uint64_t>(volume.n[1]);
    const unsigned bands = std::min(1 + static_cast<unsigned>(n % 3), static_cast<unsigned>(ny));
    for (unsigned b = 0; b < bands; ++b)
      overhangs.find({rows.data(), words, ny}, below.data(), ny * b / bands, ny * (b + 1) / bands,
                     scratch.data(), found.data());
    const int reach[2] = {static_cast<int>(distance / pitch[0]) + 1,
                          static_cast<int>(distance / pitch[1]) + 1};
    for (int j = 0; j < volume.n[1]; ++j)
      for (int i = 0; i < static_cast<int>(words * 64); ++i) {
        bool wanted = volume.get({i, j, 1});
        for (int b = -reach[1]; b <= reach[1] && wanted; ++b)
          for (int a = -reach[0]; a <= reach[0] && wanted; ++a)
            if (a * a * pitch[0] * pitch[0] + b * b * pitch[1] * pitch[1] <=
                distance * distance * (1 + 1e-9))
              wanted = !volume.get({i + a, j + b, 0});
        const bool got =
            found[static_cast<size_t>(j) * words + static_cast<size_t>(i) / 64] >> i % 64 & 1;
        if (got != wanted)
          fail_msg("%d x %d, distance %g of pitches %g, %g: sample %d, %d is wrong", volume.n[0],
                   volume.n[1], distance, pitch[0], pitch[1], i, j);
      }
  }
}

void test_thin(void**) {
  Random random(4);
  const size_t count = std::max<size_t>(test_count(80), 12);
  for (size_t n = 0; n < count; ++n) {
    const bool is_wide = n % 8 == 7;
    Volume volume(1 + static_cast<int>(random.below(is_wide ? 1200 : 150)),
                  1 + static_cast<int>(random.below(20)), 1);
    // Boxes and noise, so that some discs fit.
    for (int box = 0; box < 6; ++box) {
      const int x = static_cast<int>(random.below(is_wide ? 1200 : 150)),
                y = static_cast<int>(random.below(20));
      const int w = static_cast<int>(random.below(40)), h = static_cast<int>(random.below(20));
      for (int j = y; j < y + h; ++j)
        for (int i = x; i < x + w; ++i)
          if (volume.holds({i, j, 0}) && random.unit() < 0.995)
            volume.samples[volume.at({i, j, 0})] = 1;
    }
    unsigned across[2];
    for (unsigned& a : across) a = 2 + static_cast<unsigned>(random.below(n % 20 ? 6 : 31));
    const ThinSamples thin(across);
    for (unsigned bands = 1; bands <= std::min(3u, static_cast<unsigned>(volume.n[1])); ++bands) {
      const size_t words = words_for(static_cast<uint64_t>(volume.n[0]));
      const std::vector<uint64_t> found = thin_of(thin, volume, bands);
      for (int j = 0; j < volume.n[1]; ++j)
        for (int i = 0; i < static_cast<int>(words * 64); ++i) {
          const bool got =
              found[static_cast<size_t>(j) * words + static_cast<size_t>(i) / 64] >> i % 64 & 1;
          if (got != (volume.get({i, j, 0}) && is_thin(volume, i, j, across)))
            fail_msg("%d x %d, disc of %u x %u: sample %d, %d is wrong", volume.n[0], volume.n[1],
                     across[0], across[1], i, j);
        }
    }
  }
}

/// Strips in any direction and at any place: those more than 1.5 pixels wider than the width are
/// never thin, those 2.5 pixels narrower are all over.
void test_width_of_strips(void**) {
  Random random(5);
  const size_t count = std::max<size_t>(test_count(400), 30);
  for (size_t n = 0; n < count; ++n) {
    const double width = random.between(3, 12), angle = random.between(0, 3.1416);
    const bool is_wide = n % 2;
    const double own = is_wide ? width + 1.5 : width - 2.5;
    const double offset = random.between(-1, 1);
    Volume volume(100, 100, 1);
    for (int j = 0; j < 100; ++j)
      for (int i = 0; i < 100; ++i) {
        const double across = (i - 50) * std::cos(angle) + (j - 50) * std::sin(angle) - offset;
        volume.samples[volume.at({i, j, 0})] = std::abs(across) <= own / 2;
      }
    const unsigned count_across[2] = {static_cast<unsigned>(width), static_cast<unsigned>(width)};
    const std::vector<uint64_t> found = thin_of(ThinSamples(count_across), volume, 1);
    for (int j = 25; j < 75; ++j)
      for (int i = 25; i < 75; ++i)
        if (volume.get({i, j, 0}))
          if ((found[static_cast<size_t>(j) * 2 + static_cast<size_t>(i) / 64] >> i % 64 & 1) ==
              is_wide)
            fail_msg("a strip of %g pixels at %g, width %g: sample %d, %d is wrong", own, angle,
                     width, i, j);
  }
}

/// Rows of many words, whose runs cross them or fill them.
void test_wide_volumes(void**) {
  Random random(8);
  const size_t count = std::max<size_t>(test_count(40), 8);
  for (size_t n = 0; n < count; ++n) {
    Volume volume(400 + static_cast<int>(random.below(1000)), 1 + static_cast<int>(random.below(5)),
                  1 + static_cast<int>(random.below(4)));
    const double length = n % 3 ? random.between(1, 20) : random.between(20, 200);
    for (int k = 0; k < volume.n[2]; ++k)
      for (int j = 0; j < volume.n[1]; ++j) {
        bool is_set = random.below(2);
        for (int i = 0; i < volume.n[0]; ++i) {
          if (random.unit() * length < 1) is_set = !is_set;
          volume.samples[volume.at({i, j, k})] = is_set;
        }
      }
    check(volume);
  }
}

/// Without an anchor, the largest component is listed last where it ends. In the layer after its
/// first one, the last of the others is listed in its place.
void test_order(void**) {
  for (const int layers : {1, 2}) {
    Volume volume(40, 2, 3);
    for (int k = 0; k < layers; ++k)
      for (int i = 0; i < 18; ++i)
        if (i < 12 || i % 3 != 0) volume.samples[volume.at({i, 0, k})] = 1;
    const FoundAll got = by_layers(volume, {}, 1);
    std::vector<uint32_t> places;
    for (const Found& found : got.ended) places.push_back(std::get<3>(found)[0]);
    const std::vector<uint32_t> wanted =
        layers == 1 ? std::vector<uint32_t>{16, 13, 0} : std::vector<uint32_t>{13, 16, 0};
    assert_true(places == wanted);
  }
}

/// Runs of a word that hold seeds.
void test_filled_words(void**) {
  Random random(6);
  const size_t count = std::max<size_t>(test_count(20000), 1000);
  for (size_t n = 0; n < count; ++n) {
    const uint64_t word = random.bits() | (n % 3 ? random.bits() : 0) | (n % 7 ? 0 : ~uint64_t{0});
    const uint64_t seeds =
        word & random.bits() & random.bits() & (n % 2 ? random.bits() & random.bits() : 0);
    uint64_t wanted = 0;
    for (unsigned begin = 0; begin < 64; ++begin) {
      unsigned end = begin;
      while (end < 64 && word >> end & 1) ++end;
      uint64_t run = 0;
      if (begin < end) set_bits(&run, begin, end - 1);
      if (seeds & run) wanted |= run;
      begin = end;
    }
    assert_true(filled_down(word, filled_up(word, seeds)) == wanted);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_filled_words),    cmocka_unit_test(test_random_volumes),
      cmocka_unit_test(test_wide_volumes),    cmocka_unit_test(test_order),
      cmocka_unit_test(test_mazes),           cmocka_unit_test(test_sticks),
      cmocka_unit_test(test_spiral),          cmocka_unit_test(test_thin),
      cmocka_unit_test(test_width_of_strips), cmocka_unit_test(test_overhangs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

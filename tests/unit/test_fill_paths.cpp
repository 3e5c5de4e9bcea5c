// SPDX-License-Identifier: Apache-2.0
// Paths of fill lines: matchings against the least one, the fewest paths that hold each line once,
// and an order with little travel.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "fill/matching.h"
#include "fill/near_points.h"
#include "fill/order.h"
#include "fill/trails.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

using Key = std::pair<int64_t, int64_t>;
using Segment = std::pair<Key, Key>;

Key key(IntPoint p) {
  return {p.x, p.y};
}

CountedVector<Vec2> random_points(Random& random, size_t count) {
  CountedVector<Vec2> points(count);
  for (Vec2& p : points) p = {random.unit(), random.unit()};
  return points;
}

double total(const CountedVector<Vec2>& points, const CountedVector<uint32_t>& partners) {
  double sum = 0;
  for (uint32_t i = 0; i < partners.size(); ++i) {
    assert_true(partners[i] < partners.size() && partners[i] != i && partners[partners[i]] == i);
    sum += 0.5 * length(points[i] - points[partners[i]]);
  }
  return sum;
}

/// Of all matchings, by the sets of points that are matched.
double least_total(const CountedVector<Vec2>& points) {
  std::vector<double> least(size_t{1} << points.size(), 1e300);
  least[0] = 0;
  for (size_t set = 0; set + 1 < least.size(); ++set) {
    size_t i = 0;
    while (set >> i & 1) ++i;
    for (size_t j = i + 1; j < points.size(); ++j) {
      const size_t with = set | size_t{1} << i | size_t{1} << j;
      if (!(set >> j & 1))
        least[with] = std::min(least[with], least[set] + length(points[i] - points[j]));
    }
  }
  return least.back();
}

void test_near_points(void**) {
  Random random(5);
  for (size_t round = 0; round < 40; ++round) {
    CountedVector<Vec2> points = random_points(random, 1 + random.below(200));
    // Also on a line, far apart, and several at one place.
    if (round % 4 == 1)
      for (Vec2& p : points) p.y = 0.5;
    if (round % 4 == 2)
      for (Vec2& p : points) p = {std::floor(4 * p.x), std::floor(4 * p.y)};
    if (round % 4 == 3) points[0] = {1e9, 3};
    NearPoints grid(points);
    std::vector<bool> is_left(points.size(), true);
    for (size_t i = 0; i < points.size(); i += 3) {
      grid.remove(static_cast<uint32_t>(i));
      is_left[i] = false;
    }
    for (int n = 0; n < 20; ++n) {
      const Vec2 p = n % 2 ? points[random.below(points.size())]
                           : Vec2{random.between(-1, 2), random.between(-1, 2)};
      std::vector<std::pair<double, uint32_t>> wanted;
      for (uint32_t i = 0; i < points.size(); ++i)
        if (is_left[i]) wanted.emplace_back(dot(points[i] - p, points[i] - p), i);
      std::sort(wanted.begin(), wanted.end());
      CountedVector<uint32_t> found;
      const size_t count = 1 + random.below(9);
      grid.find(p, count, found);
      assert_int_equal(found.size(), std::min(count, wanted.size()));
      for (size_t i = 0; i < found.size(); ++i) assert_int_equal(found[i], wanted[i].second);
    }
  }
}

void test_matchings_are_near_the_least(void**) {
  Random random(7);
  double sum = 0, least = 0;
  for (size_t round = 0; round < 20 + test_count(80); ++round) {
    const CountedVector<Vec2> points = random_points(random, 2 * random.below(7));
    const double found = total(points, match(points)), best = least_total(points);
    assert_true(found >= best - 1e-12 && found <= 1.5 * best + 1e-12);
    sum += found;
    least += best;
  }
  print_message("%g times the least\n", sum / least);
  assert_true(sum <= 1.02 * least);
  // The least one of many random points is about 0.31 sqrt(n) on the unit square.
  const CountedVector<Vec2> many = random_points(random, 4000);
  const double found = total(many, match(many));
  print_message("%g sqrt(n)\n", found / std::sqrt(4000));
  assert_true(found < 0.335 * std::sqrt(4000));
}

/// Points of a square grid with gaps, joined to their neighbours; some lines bend.
CountedVector<IntPath> random_lines(Random& random, int64_t side, double share) {
  CountedVector<IntPath> lines;
  const auto place = [](int64_t i, int64_t j) { return IntPoint{1000 * i + 37 * j, 1000 * j}; };
  for (int64_t j = 0; j < side; ++j)
    for (int64_t i = 0; i < side; ++i)
      for (const auto& [a, b] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        if (i + a >= side || j + b >= side || random.unit() > share) continue;
        IntPath line{{place(i, j), place(i + a, j + b)}, false};
        if (random.below(3) == 0) {
          const IntPoint p = line.points[0], q = line.points[1];
          line.points.insert(line.points.begin() + 1,
                             {(p.x + q.x) / 2 + 100, (p.y + q.y) / 2 + 50});
        }
        if (random.below(2)) std::reverse(line.points.begin(), line.points.end());
        lines.push_back(line);
      }
  return lines;
}

template <class Visit>
void visit_segments(const IntPath& path, Visit visit) {
  const size_t count = path.points.size();
  for (size_t i = 1; i < count + path.is_closed; ++i) {
    Key a = key(path.points[i - 1]), b = key(path.points[i % count]);
    if (b < a) std::swap(a, b);
    visit(Segment(a, b));
  }
}

void test_paths_are_the_fewest(void**) {
  Random random(11);
  for (size_t round = 0; round < 60; ++round) {
    const CountedVector<IntPath> lines =
        random_lines(random, 2 + static_cast<int64_t>(random.below(12)), random.between(0.1, 1));
    std::multiset<Segment> segments;
    std::map<Key, int> degrees;
    for (const IntPath& line : lines) {
      visit_segments(line, [&](const Segment& segment) { segments.insert(segment); });
      ++degrees[key(line.points.front())];
      ++degrees[key(line.points.back())];
    }
    const auto odd = std::count_if(degrees.begin(), degrees.end(),
                                   [](const auto& degree) { return degree.second % 2 == 1; });
    const CountedVector<Tour> tours = find_trails(lines, 0);
    std::ptrdiff_t open = 0;
    std::map<Key, size_t> tour_at;
    for (size_t t = 0; t < tours.size(); ++t) {
      assert_false(tours[t].empty());
      double first_way = 0, longest = 0;
      for (size_t i = 0; i < tours[t].size(); ++i) {
        const IntPath& path = tours[t][i];
        open += !path.is_closed;
        assert_true(!path.is_closed || tours[t].size() == 1);
        assert_true(path.points.size() >= (path.is_closed ? 3u : 2u));
        visit_segments(path, [&](const Segment& segment) {
          const auto at = segments.find(segment);
          assert_true(at != segments.end());
          segments.erase(at);
        });
        const IntPath& before = tours[t][i > 0 ? i - 1 : tours[t].size() - 1];
        const double way = distance(before.points.back(), path.points.front());
        if (i == 0) first_way = way;
        longest = std::max(longest, way);
        // What is connected is one tour.
        for (const IntPoint p : path.points)
          assert_int_equal(tour_at.emplace(key(p), t).first->second, t);
      }
      if (!tours[t][0].is_closed) assert_true(first_way == longest);
    }
    assert_true(segments.empty());
    assert_int_equal(2 * open, odd);
  }
}

IntPath line(std::initializer_list<IntPoint> points) {
  return {points, false};
}

void test_paths_go_straight_on(void**) {
  // A T with a bend in its bar, and a triangle.
  CountedVector<Tour> tours =
      find_trails({line({{1000, 100}, {1000, 1000}}), line({{0, 0}, {1000, 100}}),
                   line({{1000, 100}, {2000, 0}}), line({{5000, 5000}, {6000, 5000}}),
                   line({{6000, 5000}, {5000, 6000}, {5000, 5000}})},
                  0);
  std::sort(tours.begin(), tours.end(),
            [](const Tour& a, const Tour& b) { return a.size() > b.size(); });
  assert_int_equal(tours.size(), 2);
  assert_int_equal(tours[0].size(), 2);
  std::sort(tours[0].begin(), tours[0].end(),
            [](const IntPath& a, const IntPath& b) { return a.points.size() < b.points.size(); });
  assert_int_equal(tours[0][0].points.size(), 2);
  assert_int_equal(tours[0][1].points.size(), 3);
  assert_true((tours[0][1].points[1] == IntPoint{1000, 100}));
  assert_true(tours[1][0].is_closed);
  assert_int_equal(tours[1][0].points.size(), 3);

  // Two circles that touch twice are one ring, which goes on straight where it can.
  tours = find_trails(
      {line({{0, 0}, {1000, 800}, {2000, 0}}), line({{0, 0}, {1000, 100}, {2000, 0}}),
       line({{0, 0}, {1000, -100}, {2000, 0}}), line({{0, 0}, {1000, -800}, {2000, 0}})},
      0);
  assert_int_equal(tours.size(), 1);
  assert_int_equal(tours[0].size(), 1);
  assert_true(tours[0][0].is_closed);
  assert_int_equal(tours[0][0].points.size(), 8);

  // There and back is no ring.
  tours = find_trails({line({{0, 0}, {5, 0}}), line({{5, 0}, {0, 0}})}, 0);
  assert_int_equal(tours.size(), 1);
  assert_false(tours[0][0].is_closed);
  assert_int_equal(tours[0][0].points.size(), 3);

  // Many lines at a point, and none.
  CountedVector<IntPath> star;
  for (int64_t i = 0; i < 41; ++i) star.push_back(line({{0, 0}, {100 + i, 2000 - 97 * i}}));
  tours = find_trails(star, 0);
  assert_int_equal(tours.size(), 1);
  assert_int_equal(tours[0].size(), 21);
  assert_true(find_trails({}, 1).empty());
}

void test_short_lines_between_junctions_are_left_out(void**) {
  // An H with a short bar: without it there are two paths in place of three.
  const CountedVector<IntPath> h = {line({{0, 0}, {0, 1000}}), line({{0, 1000}, {0, 2000}}),
                                    line({{90, 0}, {90, 1000}}), line({{90, 1000}, {90, 2000}}),
                                    line({{0, 1000}, {90, 1000}})};
  const auto count = [](const CountedVector<Tour>& tours) {
    size_t sum = 0;
    for (const Tour& tour : tours) sum += tour.size();
    return sum;
  };
  assert_int_equal(count(find_trails(h, 0)), 3);
  assert_int_equal(count(find_trails(h, 89)), 3);
  const CountedVector<Tour> two = find_trails(h, 91);
  assert_int_equal(count(two), 2);
  for (const Tour& tour : two)
    for (const IntPath& path : tour) assert_true(length_of(path) == 2000);
  // A short line with a loose end stays in its path; alone, it is left out, as a short ring is.
  assert_int_equal(count(find_trails({line({{0, 0}, {50, 0}}), line({{50, 0}, {900, 0}})}, 91)), 1);
  assert_int_equal(count(find_trails({line({{0, 0}, {50, 0}})}, 91)), 0);
  assert_int_equal(count(find_trails({IntPath{{{0, 0}, {50, 0}, {0, 1}}, true}}, 200)), 0);
}

void test_pairs_join_paths(void**) {
  // Two junctions of three lines: one path through each side of the pair, or one path that crosses.
  const CountedVector<IntPath> y = {line({{0, 0}, {1000, 0}}), line({{0, 0}, {-500, 900}}),
                                    line({{0, 0}, {-500, -900}}), line({{1000, 0}, {1500, 900}}),
                                    line({{1000, 0}, {1500, -900}})};
  const FillPolygon wide({{{-5000, -5000}, {5000, -5000}, {5000, 5000}, {-5000, 5000}}});
  const auto paths_of = [](const CountedVector<Tour>& tours) {
    CountedVector<IntPath> paths;
    for (const Tour& tour : tours) paths.insert(paths.end(), tour.begin(), tour.end());
    return paths;
  };
  assert_int_equal(paths_of(find_trails(y, 0)).size(), 3);
  const CountedVector<IntPath> two = paths_of(find_trails(y, 0, {200, &wide}));
  assert_int_equal(two.size(), 2);
  // Both lines of the pair are 100 from its middle, and its corners are on the lines that go on.
  std::set<Key> corners;
  for (const IntPath& path : two) {
    assert_int_equal(path.points.size(), 4);
    for (const size_t i : {size_t{1}, size_t{2}}) corners.insert(key(path.points[i]));
  }
  const std::set<Key> expected = {{-56, 100}, {-56, -100}, {1056, 100}, {1056, -100}};
  assert_true(corners == expected);
  // No room beside the lines: no pair.
  const FillPolygon narrow({{{-5000, -50}, {5000, -50}, {5000, 50}, {-5000, 50}}});
  assert_int_equal(paths_of(find_trails(y, 0, {200, &narrow})).size(), 3);
  // A single line, and two that meet, have no junction.
  assert_int_equal(paths_of(find_trails({y[0], y[1]}, 0, {200, &wide}))[0].points.size(), 3);
  assert_int_equal(paths_of(find_trails({y[0]}, 0, {200, &wide}))[0].points.size(), 2);
  // A line with a loose end is printed to it and back; there its two lines meet.
  const CountedVector<IntPath> back = paths_of(
      find_trails({line({{0, 0}, {0, 300}}), line({{-900, 0}, {0, 0}}), line({{0, 0}, {900, 0}})},
                  0, {200, &wide}));
  assert_int_equal(back.size(), 1);
  assert_int_equal(back[0].points.size(), 5);
  assert_true((back[0].points[2] == IntPoint{0, 300}));
  assert_true(std::abs(back[0].points[1].x) == 100 && back[0].points[1].y == 0);
}

/// Each junction of a random graph is passed as often as before, and fewer paths are left.
void test_pairs_of_random_lines(void**) {
  Random random(12);
  const FillPolygon wide({{{-1000000, -1000000}, {1000000, -1000000}, {0, 1000000}}});
  for (size_t round = 0; round < 40; ++round) {
    const CountedVector<IntPath> lines =
        random_lines(random, 3 + static_cast<int64_t>(random.below(8)), random.between(0.3, 1));
    const auto measure = [](const CountedVector<Tour>& tours) {
      std::pair<size_t, double> sum{0, 0};
      for (const Tour& tour : tours)
        for (const IntPath& path : tour) {
          ++sum.first;
          sum.second += length_of(path);
        }
      return sum;
    };
    // A distance so small that corners hardly move: what is longer is printed twice.
    const auto [count, length] = measure(find_trails(lines, 0));
    const auto [fewer, longer] = measure(find_trails(lines, 0, {2, &wide}));
    assert_true(fewer <= count);
    double whole = 0;
    for (const IntPath& line : lines) whole += length_of(line);
    assert_true(longer >= length - 4 * static_cast<double>(lines.size()) &&
                longer <= 2 * whole + 4 * static_cast<double>(lines.size()));
  }
}

double travel(const CountedVector<IntPath>& paths) {
  double sum = 0;
  for (size_t i = 1; i < paths.size(); ++i) {
    const IntPath& before = paths[i - 1];
    sum += distance(before.is_closed ? before.points.front() : before.points.back(),
                    paths[i].points.front());
  }
  return sum;
}

void test_order_shortens_travel(void**) {
  Random random(3);
  CountedVector<Tour> tours;
  CountedVector<IntPath> given;
  for (size_t i = 0; i < 1500; ++i) {
    const auto place = [&](int64_t about) {
      return about + static_cast<int64_t>(random.below(2000));
    };
    const int64_t x = static_cast<int64_t>(random.below(100000)),
                  y = static_cast<int64_t>(random.below(100000));
    Tour tour;
    for (size_t n = 0; n < 1 + i % 3; ++n)
      tour.push_back({{{place(x), place(y)}, {place(x), place(y)}, {place(x), place(y)}},
                      i % 3 == 0 && i % 2 == 0});
    given.insert(given.end(), tour.begin(), tour.end());
    tours.push_back(tour);
  }
  const CountedVector<IntPath> ordered = order_paths(tours, {0, 0});
  // The same paths: by their points, from the least one on.
  const auto names = [](const CountedVector<IntPath>& paths) {
    std::vector<std::vector<Key>> all;
    for (const IntPath& path : paths) {
      std::vector<Key> keys;
      for (const IntPoint p : path.points) keys.push_back(key(p));
      if (path.is_closed) {
        std::rotate(keys.begin(), std::min_element(keys.begin(), keys.end()), keys.end());
      } else if (keys.back() < keys.front()) {
        std::reverse(keys.begin(), keys.end());
      }
      all.push_back(keys);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  assert_true(names(ordered) == names(given));
  // The nearest path each time, of all that are left.
  CountedVector<IntPath> nearest = given;
  IntPoint at{0, 0};
  for (size_t n = 0; n < nearest.size(); ++n) {
    double least = 1e300;
    std::pair<size_t, size_t> best;
    for (size_t i = n; i < nearest.size(); ++i)
      for (size_t k = 0; k < 3; ++k)
        if ((nearest[i].is_closed || k != 1) && distance(at, nearest[i].points[k]) < least) {
          least = distance(at, nearest[i].points[k]);
          best = {i, k};
        }
    std::swap(nearest[n], nearest[best.first]);
    CountedVector<IntPoint>& points = nearest[n].points;
    if (nearest[n].is_closed)
      std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(best.second),
                  points.end());
    else if (best.second)
      std::reverse(points.begin(), points.end());
    at = nearest[n].is_closed ? points.front() : points.back();
  }
  print_message("travel %.3g, nearest first %.3g, as given %.3g\n", travel(ordered),
                travel(nearest), travel(given));
  assert_true(travel(ordered) < 0.9 * travel(nearest));
  // Few, where there is nothing to be gained or no neighbour.
  for (size_t count = 0; count < 4; ++count) {
    const CountedVector<Tour> few(tours.begin(),
                                  tours.begin() + static_cast<std::ptrdiff_t>(count));
    size_t paths = 0;
    for (const Tour& tour : few) paths += tour.size();
    assert_int_equal(order_paths(few, {7, 7}).size(), paths);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_near_points),
      cmocka_unit_test(test_matchings_are_near_the_least),
      cmocka_unit_test(test_paths_are_the_fewest),
      cmocka_unit_test(test_paths_go_straight_on),
      cmocka_unit_test(test_short_lines_between_junctions_are_left_out),
      cmocka_unit_test(test_pairs_join_paths),
      cmocka_unit_test(test_pairs_of_random_lines),
      cmocka_unit_test(test_order_shortens_travel),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

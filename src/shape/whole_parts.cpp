// SPDX-License-Identifier: Apache-2.0
#include "shape/whole_parts.h"

#include "base/job.h"

namespace msq {

namespace {

bool is_up_to(const SamplePart& p, uint64_t size) {
  return std::max({p.count(0), p.count(1), p.count(2)}) <= size;
}

constexpr size_t batch = 64;  // of expansions
constexpr size_t max_kept_doubtful = 4096;

}  // namespace

WholeParts::WholeParts(const OpenMesh& mesh, const SampleGrid& grid, const SamplePart& all)
    : mesh_(mesh), grid_(grid), all_(all) {
  coarse_.reset(all);
  find_coarse(all);
  coarse_.find_runs();
}

template <uint64_t least, class Use>
bool WholeParts::halve(const SamplePart& p, Use&& use) const {
  const Vec3 extent = box_of(p).extent();
  size_t longest = 3;
  for (size_t axis = 0; axis < 3; ++axis)
    if (p.count(axis) > least &&
        (longest == 3 || extent[static_cast<int>(axis)] > extent[static_cast<int>(longest)]))
      longest = axis;
  if (longest == 3) return false;
  SamplePart lower = p, upper = p;
  lower.high[longest] = upper.low[longest] =
      p.low[longest] + (p.count(longest) + 2 * least - 1) / (2 * least) * least;
  use(lower);
  use(upper);
  return true;
}

void WholeParts::find_coarse(const SamplePart& p) {
  check_cancelled();
  const Ball ball = ball_about(box_of(p));
  int64_t whole;
  if (mesh_.is_whole_about(ball.centre, ball.radius, whole))
    coarse_.fill(p, whole);
  else if (!halve<band>(p, [&](const SamplePart& half) { find_coarse(half); }))
    coarse_.fill(p, not_proven);
}

void WholeParts::set(uint64_t first_row) {
  SamplePart part = all_;
  part.low[1] = first_row;
  part.high[1] = std::min(all_.high[1], first_row + band);
  fine_.reset(part);
  single_.clear();
  // All layers are in one coarse cube.
  for (uint64_t i = part.low[0], next; i < part.high[0]; i = next) {
    const int64_t whole = coarse_.run(i, first_row, part.low[2], next);
    SamplePart run = part;
    run.low[0] = i;
    run.high[0] = next;
    if (whole != not_proven)
      fine_.fill(run, whole);
    else
      find_fine(run);
  }
  find_kept();
  settle_doubtful();
  fine_.find_runs();
}

void WholeParts::find_fine(const SamplePart& p) {
  check_cancelled();
  if (is_up_to(p, block)) return kept_.push_back(p);
  const Ball ball = ball_about(box_of(p));
  int64_t whole;
  if (mesh_.is_whole_about(ball.centre, ball.radius, whole)) return fine_.fill(p, whole);
  halve<side>(p, [&](const SamplePart& half) { find_fine(half); });
}

void WholeParts::find_kept() {
  std::array<SamplePart, batch> parts;
  std::array<Ball, batch> balls;
  std::array<Expansion, batch> expansions;
  while (!kept_.empty()) {
    check_cancelled();
    const size_t count = std::min(batch, kept_.size());
    std::copy(kept_.end() - count, kept_.end(), parts.begin());
    kept_.resize(kept_.size() - count);
    for (size_t i = 0; i < count; ++i) balls[i] = ball_about(box_of(parts[i]));
    mesh_.expand(balls.data(), count, expansions.data());
    for (size_t i = 0; i < count; ++i) {
      look_into(parts[i], balls[i], expansions[i]);
      if (doubtful_.size() >= max_kept_doubtful) settle_doubtful();
    }
  }
}

void WholeParts::look_into(const SamplePart& p, const Ball& ball, const Expansion& expansion) {
  int64_t whole;
  if (mesh_.find_field(ball, expansion, field_)) {
    if (look_by_field(p, is_up_to(p, side))) return;
  } else if (mesh_.is_whole_about(ball.centre, ball.radius, whole)) {
    return fine_.fill(p, whole);
  }
  if (!halve<side>(p, [&](const SamplePart& half) { kept_.push_back(half); }))
    look_by_views(p, ball);
}

WholeParts::Points WholeParts::points_of(const SamplePart& p) const {
  Points points;
  for (uint64_t k = p.low[2]; k < p.high[2]; ++k)
    for (uint64_t j = p.low[1]; j < p.high[1]; ++j)
      for (uint64_t i = p.low[0]; i < p.high[0]; ++i) points.at[points.count++] = grid_.at(i, j, k);
  return points;
}

bool WholeParts::look_by_field(const SamplePart& p, bool is_least) {
  int64_t whole;
  if (field_.is_constant(whole)) {
    fine_.fill(p, whole);
    return true;
  }
  // Halves cost an expansion each, as do samples that are not known.
  constexpr double max_doubtful = 12;
  const double count = static_cast<double>(p.count(0) * p.count(1) * p.count(2));
  if (!is_least && count * field_.doubtful_part() > max_doubtful) return false;
  const auto end_of = [&](uint64_t begin, size_t axis) {
    return std::min(begin + side, p.high[axis]);
  };
  for (uint64_t z = p.low[2]; z < p.high[2]; z += side)
    for (uint64_t y = p.low[1]; y < p.high[1]; y += side)
      for (uint64_t x = p.low[0]; x < p.high[0]; x += side) {
        const SamplePart cube{{x, y, z}, {end_of(x, 0), end_of(y, 1), end_of(z, 2)}};
        const Points points = points_of(cube);
        Numbers numbers;
        for (size_t n = 0; n < points.count; ++n)
          if (!field_.whole_at(points.at[n], numbers[n])) numbers[n] = not_proven;
        keep_cube(cube, numbers);
      }
  return true;
}

void WholeParts::look_by_views(const SamplePart& p, const Ball& ball) {
  mesh_.caps().gather(ball.centre, ball.radius, near_);
  const Points points = points_of(p);
  std::array<Caps::View, cube_samples> views;
  mesh_.caps().find_views(points.at.data(), points.count, near_, views.data());
  Numbers numbers;
  for (size_t n = 0; n < points.count; ++n)
    numbers[n] = views[n].margin() > 0 ? views[n].whole() : not_proven;
  keep_cube(p, numbers);
}

void WholeParts::keep_cube(const SamplePart& p, const Numbers& numbers) {
  const size_t count = p.count(0) * p.count(1) * p.count(2);
  const bool is_one = std::all_of(numbers.begin() + 1, numbers.begin() + count,
                                  [&](int64_t number) { return number == numbers[0]; });
  if (is_one && numbers[0] != not_proven) return fine_.fill(p, numbers[0]);
  fine_.fill(p, not_proven + static_cast<int64_t>(single_.size()));
  Cube& cube = single_.emplace_back();
  size_t n = 0;
  for (uint64_t k = p.low[2]; k < p.high[2]; ++k)
    for (uint64_t j = p.low[1]; j < p.high[1]; ++j)
      for (uint64_t i = p.low[0]; i < p.high[0]; ++i, ++n) {
        const size_t place = fine_.place(i, j, k);
        cube[place] = to_single(numbers[n]);
        if (cube[place] == single_not_proven)
          doubtful_.push_back({grid_.at(i, j, k), single_.size() - 1, place});
      }
}

void WholeParts::settle_doubtful() {
  std::array<Ball, batch> balls;
  std::array<Expansion, batch> expansions;
  for (size_t begin = 0; begin < doubtful_.size(); begin += batch) {
    check_cancelled();
    const Doubtful* const samples = &doubtful_[begin];
    const size_t count = std::min(batch, doubtful_.size() - begin);
    for (size_t i = 0; i < count; ++i) balls[i] = {samples[i].at, 0};
    mesh_.expand(balls.data(), count, expansions.data());
    int64_t whole;
    for (size_t i = 0; i < count; ++i)
      if (mesh_.find_whole(balls[i].centre, expansions[i], whole))
        single_[samples[i].cube][samples[i].place] = to_single(whole);
  }
  doubtful_.clear();
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/warp_seeds.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "base/status.h"

namespace msq {

namespace {

/// Own seeds of boxes beyond the outermost ring are in the outer eighth of their box, so that they
/// hardly come into the rings.
constexpr double outer_part = 0.125;
/// Seeds of boxes are kept in the cache where more cells may have them.
constexpr int32_t few_cells = 256;

struct BoxSeeds final : CellData {
  std::vector<PlacedSeed> seeds;

  uint64_t bytes() const override { return sizeof *this + seeds.capacity() * sizeof(PlacedSeed); }
};

Warp in_grid(const Warp& warp) {
  Neighbourhood grid = warp.grid();
  grid.origin = {};
  grid.rotation = {};
  return {warp.kind(), grid, warp.shell()};
}

const Warp& check(const Warp& warp) {
  const Warp::Shell& shell = warp.shell();
  if (!(shell.outer > 0))
    fail(Status::argument,
         "warp.outer_radius is %g; in a foam it must be above inner_radius, as cells grow outwards",
         shell.outer);
  const double thick = warp.grid().cell_size.x, turn = two_pi / shell.count;
  const bool is_round = warp.kind() == Warp::Kind::spherical;
  // Fewer seeds may all be on one line, and then have no edges.
  if (is_round && (shell.count < 3 || shell.count_polar < 2))
    fail(
        Status::limit,
        "warp.count is %u and count_polar %u; in a foam around a point they must be at least 3 and "
        "2",
        shell.count, shell.count_polar);
  const auto height = [&](double radius) {
    return is_round ? pi / shell.count_polar * radius : warp.grid().cell_size.z;
  };
  const double narrow = std::min({thick, height(shell.inner), turn * shell.inner}),
               wide = std::max({thick, height(shell.outer), turn * shell.outer});
  // A ratio of the limit may be rounded up.
  if (wide <= WarpSeeds::max_ratio * narrow * (1 + 1e-12)) return warp;
  if (is_round)
    fail(
        Status::limit,
        "warp.count is %u and count_polar %u: at inner_radius, cells are %g wide and %g from south "
        "to north, at outer_radius %g and %g, and with grid.cell_size[0], %g, their sizes run from "
        "%g to %g; in a foam, the largest may be %g times the smallest",
        shell.count, shell.count_polar, turn * shell.inner, height(shell.inner), turn * shell.outer,
        height(shell.outer), thick, narrow, wide, WarpSeeds::max_ratio);
  fail(Status::limit,
       "warp.count is %u: cells are %g wide at inner_radius and %g at outer_radius, and with "
       "grid.cell_size[0], %g, and [2], %g, their sizes run from %g to %g; in a foam, the largest "
       "may be %g times the smallest",
       shell.count, turn * shell.inner, turn * shell.outer, thick, warp.grid().cell_size.z, narrow,
       wide, WarpSeeds::max_ratio);
}

}  // namespace

double WarpSeeds::width(double radius) const {
  return radius * (two_pi / warp_.shell().count);
}

double WarpSeeds::height(double radius) const {
  return is_round_ ? radius * (pi / warp_.shell().count_polar) : warp_.grid().cell_size.z;
}

double WarpSeeds::diagonal(double radius) const {
  const double thick = warp_.grid().cell_size.x;
  return length(Vec3{thick, width(radius + thick) * swell_, height(radius + thick)}) *
         (1 + 0x1p-13);
}

double WarpSeeds::box_volume() const {
  return grid_.cell_size.x * grid_.cell_size.y * grid_.cell_size.z;
}

WarpSeeds::WarpSeeds(Ref<Context> context, const Warp& warp, double jitter, uint64_t seed)
    : context_(std::move(context)),
      id_(context_->new_structure_id()),
      warp_(in_grid(check(warp))),
      grid_(warp.grid()),
      smallest_(warp.grid()),
      is_round_(warp.kind() == Warp::Kind::spherical),
      swell_(1 + std::abs(warp.shell().shear_outwards) + std::abs(warp.shell().shear_along)),
      cells_(seed, jitter, {1, 1, 1}),
      own_(seed ^ border_stream, 1, {1, 1, 1}) {
  const Warp::Shell& shell = warp_.shell();
  const double thick = smallest_.cell_size.x;
  smallest_.cell_size = {thick, width(shell.inner), height(shell.inner)};
  reach_ = min_component(smallest_.cell_size);
  largest_ = std::max({thick, width(shell.outer), height(shell.outer)});
  const auto too_many = [&](double cells) {
    const char* const why = "seeds would be in one box of the search; the limit is";
    if (is_round_)
      fail(Status::limit,
           "warp.count is %u, count_polar %u, inner_radius %g and outer_radius %g, and "
           "grid.cell_size[0] is %g: about %.3g %s %g",
           shell.count, shell.count_polar, shell.inner, shell.outer, thick, cells, why, max_in_box);
    fail(
        Status::limit,
        "warp.count is %u, inner_radius %g, outer_radius %g, shear_outwards %g and shear_along %g, "
        "and grid.cell_size[0] is %g and [2] %g: about %.3g %s %g",
        shell.count, shell.inner, shell.outer, shell.shear_outwards, shell.shear_along, thick,
        smallest_.cell_size.z, cells, why, max_in_box);
  };
  const auto side_at = [&](double radius) {
    const double high = is_round_ ? height(radius) : 0.25 * height(radius);
    return std::max({thick, high, width(radius) * swell_}) * (1 + room);
  };
  // By how much own seeds beyond the outermost ring may come into it, and those within the
  // innermost one, in sides of boxes.
  const double across_box = std::sqrt(is_round_ ? 3.0 : 2.0) * 1.001,
               dip_outside = outer_part * across_box;
  const double at_outer = diagonal(shell.outer + reach_);
  const double needed = shell.outer + reach_ + at_outer;
  double rings = 0, side = 0;
  for (;;) {
    side = side_at(shell.inner + rings * thick);
    const double more = std::ceil((needed + dip_outside * side - shell.inner) / thick);
    if (more <= rings) break;
    rings = more;
    // Few cells around: rings get wider faster than they get farther from the shell.
    constexpr double max_rings = 1 << 24;
    if (!(rings <= max_rings)) too_many(side / thick * (side / thick));
  }
  last_ = static_cast<int32_t>(rings) - 1;
  high_ = shell.inner + rings * thick;
  const double tall = std::max(smallest_.cell_size.z * (1 + room), 0.25 * side);
  grid_.cell_size = {side, side, is_round_ ? side : tall};
  const double low =
      std::max(reach_ + diagonal(shell.inner), at_outer - (shell.outer + reach_ - shell.inner)) +
      across_box * side;
  first_ = -static_cast<int32_t>(std::ceil(std::min(low, shell.inner) / thick));
  // Where rings go to the axis, rounding leaves no gap.
  low_ = low < shell.inner ? std::max(0.0, shell.inner + first_ * thick) : 0;
  const double across = across_box * side, nearest = low_ - across;
  const double outwards = across / thick + 5;
  const auto within = [](double cells, double size) { return cells / size * (1 + 1e-6) + 3; };
  double around = shell.count, up = 0;
  if (is_round_) {  // all cells around where the box is at a pole
    up = shell.count_polar;
    if (nearest > 0) up = std::min(up, within(across, height(nearest)));
  } else {
    up = within(grid_.cell_size.z, smallest_.cell_size.z);
    const double by_shear =
        std::abs(shell.shear_outwards) * outwards + std::abs(shell.shear_along) * up;
    if (nearest > 0) around = std::min(around, across / width(nearest) + 3 + by_shear);
  }
  const double cells = outwards * around * up;
  if (!(cells <= max_in_box)) too_many(cells);
}

WarpSeeds::~WarpSeeds() {
  context_->cache.drop(id_);
}

CellIndex WarpSeeds::canonical(CellIndex cell) const {
  const auto count = static_cast<int32_t>(warp_.shell().count);
  cell.y %= count;
  if (cell.y < 0) cell.y += count;
  return cell;
}

Interval WarpSeeds::radii_of(const Box3& box) const {
  const auto nearest = [](double low, double high) { return std::max({0.0, low, -high}); };
  const auto farthest = [](double low, double high) { return std::max(-low, high); };
  const double x0 = nearest(box.min.x, box.max.x), y0 = nearest(box.min.y, box.max.y),
               x1 = farthest(box.min.x, box.max.x), y1 = farthest(box.min.y, box.max.y),
               z0 = is_round_ ? nearest(box.min.z, box.max.z) : 0,
               z1 = is_round_ ? farthest(box.min.z, box.max.z) : 0;
  return {std::sqrt(x0 * x0 + y0 * y0 + z0 * z0), std::sqrt(x1 * x1 + y1 * y1 + z1 * z1)};
}

Box3 WarpSeeds::bounds_of(CellIndex box) const {
  const Vec3 low{double(box.x), double(box.y), double(box.z)};
  return {low * grid_.cell_size, (low + Vec3{1, 1, 1}) * grid_.cell_size};
}

bool WarpSeeds::has_own(CellIndex box) const {
  const Interval radii = radii_of(bounds_of(box));
  return radii.low < low_ || radii.high > high_;
}

PlacedSeed WarpSeeds::own_seed(CellIndex box) const {
  Vec3 f = own_.fractions(own_.bits(box));
  const Box3 bounds = bounds_of(box);
  if (radii_of(bounds).high > high_)
    for (int axis = 0; axis < (is_round_ ? 3 : 2); ++axis)
      f[axis] = outer_part * f[axis] + (bounds.max[axis] >= -bounds.min[axis] ? 1 - outer_part : 0);
  return {box, f, 0, 0};
}

PlacedSeed WarpSeeds::place(CellIndex cell) const {
  const Vec3 f = cells_.fractions(cells_.bits(cell));
  const Vec3 at = Vec3{double(cell.x), double(cell.y), double(cell.z)} + f;
  const Vec3 g = warp_.from_cells(at);
  int32_t box[3];
  PlacedSeed seed{};
  for (int axis = 0; axis < 3; ++axis) {
    const double boxes = g[axis] / grid_.cell_size[axis];
    box[axis] = static_cast<int32_t>(std::floor(boxes));
    seed.in_box[axis] = place_in_box(boxes);
  }
  seed.box = {box[0], box[1], box[2]};
  const double thick = warp_.grid().cell_size.x;
  const double radius = std::abs(warp_.shell().inner + at.x * thick), high = height(radius);
  // Around a point, cells are narrower towards the poles.
  const double from_axis =
      is_round_ ? std::max(std::sqrt(g.x * g.x + g.y * g.y), 0.5 * high) : radius;
  seed.level = seed_level(box_volume(), thick * high * width(from_axis) * 2.828);
  return seed;
}

// The exact coordinates of a cell's place are those of a point that is nearer to the computed place
// than `slack`, and the computed place is in the box up to rounding.
WarpSeeds::Block WarpSeeds::block_of(CellIndex box) const {
  const Box3 bounds = bounds_of(box);
  const double reach = std::max(max_magnitude(bounds.min), max_magnitude(bounds.max));
  const double slack = 1e-9 * grid_.cell_size.x + 0x1p-43 * reach +
                       4 * warp_.slack({reach, reach, reach}, grid_.cell_size.x);
  const Warp::Image image = warp_.image(bounds.grown(slack));
  const auto count = static_cast<int32_t>(warp_.shell().count);
  const auto whole = [](double cells) {
    return static_cast<int32_t>(std::floor(std::clamp(cells, -0x1p30, 0x1p30)));
  };
  Block block{};
  block.first = {std::max(first_, whole(image.cells.min.x)), whole(image.cells.min.y),
                 whole(image.cells.min.z)};
  const int32_t last = std::min(last_, whole(image.cells.max.x));
  int32_t top = whole(image.cells.max.z);
  block.count[1] = whole(image.cells.max.y) - block.first.y + 1;
  // The first ring may go on through the axis or the point.
  const bool goes_through = low_ == 0 && image.radius.low <= warp_.grid().cell_size.x;
  if (goes_through) {
    block.first.x = first_;
    block.count[1] = count;
  }
  if (is_round_) {
    const auto most = static_cast<int32_t>(warp_.shell().count_polar) - 1;
    block.first.z = goes_through ? 0 : std::clamp(block.first.z, 0, most);
    top = goes_through ? most : std::clamp(top, 0, most);
  }
  block.count[2] = top - block.first.z + 1;
  if (block.count[1] >= count) {
    block.first.y = 0;
    block.count[1] = count;
  }
  block.count[0] = std::max(0, last - block.first.x + 1);
  return block;
}

CellIndex WarpSeeds::cell_in(const Block& block, uint32_t number) const {
  const auto n = static_cast<int32_t>(number - 1);
  const int32_t row = n / block.count[0];
  return canonical({block.first.x + n % block.count[0], block.first.y + row % block.count[1],
                    block.first.z + row / block.count[1]});
}

void WarpSeeds::find(CellIndex box, std::vector<PlacedSeed>& seeds) const {
  if (has_own(box)) seeds.push_back(own_seed(box));
  const Block block = block_of(box);
  if (block.cells() <= few_cells) return place_all(box, block, seeds);
  const CellCache::Data data = context_->cache.fetch(id_, box, [&] {
    auto made = std::make_shared<BoxSeeds>();
    place_all(box, block, made->seeds);
    made->seeds.shrink_to_fit();
    return made;
  });
  const std::vector<PlacedSeed>& kept = static_cast<const BoxSeeds&>(*data).seeds;
  seeds.insert(seeds.end(), kept.begin(), kept.end());
}

void WarpSeeds::place_all(CellIndex box, const Block& block, std::vector<PlacedSeed>& seeds) const {
  const int32_t count = block.cells();
  for (int32_t n = 1; n <= count; ++n) {
    PlacedSeed seed = place(cell_in(block, static_cast<uint32_t>(n)));
    if (!(seed.box == box)) continue;
    seed.number = static_cast<uint32_t>(n);
    seeds.push_back(seed);
  }
}

PlacedSeed WarpSeeds::seed(CellIndex box, uint32_t number) const {
  if (number == 0) return own_seed(box);
  PlacedSeed seed = place(cell_in(block_of(box), number));
  seed.number = number;
  return seed;
}

CellIndex WarpSeeds::cell_of(CellIndex box, uint32_t number) const {
  if (number > 0) return cell_in(block_of(box), number);
  const Vec3 low{double(box.x), double(box.y), double(box.z)};
  return cell_of((low + own_seed(box).in_box) * grid_.cell_size);
}

CellIndex WarpSeeds::cell_of(Vec3 g) const {
  return warp_.locate(warp_.to_cells(g)).cell;
}

PlacedSeed WarpSeeds::near(Vec3 g) const {
  const Warp::Place at = warp_.place(g);
  if (at.radius < low_ || at.radius > high_) {
    const auto box_at = [&](int axis) {
      return static_cast<int32_t>(std::floor(g[axis] / grid_.cell_size[axis]));
    };
    const CellIndex box{box_at(0), box_at(1), box_at(2)};
    if (has_own(box)) return own_seed(box);
  }
  CellIndex cell = canonical(warp_.locate(at.cells).cell);
  cell.x = std::clamp(cell.x, first_, last_);
  if (is_round_) cell.z = std::max(cell.z, 0);
  PlacedSeed seed = place(cell);
  const Block block = block_of(seed.box);
  const CellIndex from =
      canonical({cell.x - block.first.x, cell.y - block.first.y, cell.z - block.first.z});
  seed.number =
      static_cast<uint32_t>(1 + from.x + block.count[0] * (from.y + block.count[1] * from.z));
  return seed;
}

double WarpSeeds::max_distance(const Box3& box) const {
  const double most = length(grid_.cell_size) * (1 + 1e-9);
  const Interval radii = radii_of(box);
  if (radii.low < low_ || radii.high > high_) return most;
  return std::min(most, diagonal(radii.high));
}

Interval WarpSeeds::density(const Box3& box) const {
  const Interval radii = radii_of(box);
  const double thick = warp_.grid().cell_size.x;
  const auto at = [&](double radius) {
    const double r = std::max(radius, 0.5 * thick);
    return box_volume() / (thick * height(r) * width(r));
  };
  Interval density{at(radii.high), at(std::max(radii.low, low_))};
  if (radii.low < low_ || radii.high > high_) density.low = std::min(density.low, 1.0);
  return {density.low, std::max(density.low, density.high)};
}

double WarpSeeds::max_density() const {
  const Vec3 size = smallest_.cell_size;
  return box_volume() / (size.x * size.y * size.z);
}

// As in the constructor: points where the foam is needed are within that of their nearest seeds.
bool WarpSeeds::is_needed(const Box3& box) const {
  const Warp::Shell& shell = warp_.shell();
  const Interval radii = radii_of(box);
  const double most = reach_ + diagonal(shell.outer + reach_);
  return radii.high >= shell.inner - most && radii.low <= shell.outer + most;
}

void WarpSeeds::describe(HashInput& input) const {
  input.text("warp");
  warp_.describe(input);
  input.number(warp_.grid().cell_size.x);
  if (!is_round_) input.number(warp_.grid().cell_size.z);
}

}  // namespace msq

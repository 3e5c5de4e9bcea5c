// SPDX-License-Identifier: Apache-2.0
// The faces are those of the cells of the seeds (edges/brick_cells.h). Where rounding defeats both
// the walk and the cuts, the planes of all seeds that may matter stand for the faces: planes that
// do not cut a cell are no nearer to its points than those that bound it.
#include "structure/foam/walls/face_brick.h"

#include <array>
#include <cmath>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/edges/brick_cells.h"
#include "structure/foam/edges/graded_cells.h"
#include "structure/foam/edges/weighted_cells.h"
#include "structure/foam/walls/face_areas.h"
#include "structure/foam/walls/facet_faces.h"

namespace msq {

namespace {

/// Half-way to a neighbour.
void add_face(Vec3 apart, std::vector<FaceBrick::Face>& faces) {
  const double distance = length(apart);
  const Vec3 n = apart * (1 / distance);
  faces.push_back({{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                   static_cast<float>(0.5 * distance)});
}

/// The face towards each neighbour, cut by the planes of the others. Positions are from the seed,
/// whose cell is within `empty_radius`.
void add_areas(const std::vector<Vec3>& neighbours, double empty_radius, FacePolygon& polygon,
               std::vector<WallFace>& areas) {
  for (const Vec3& face : neighbours) {
    polygon.start({}, face, empty_radius * (1 + 1e-9));
    for (const Vec3& other : neighbours) {
      if (polygon.is_empty()) break;
      if (!(other == face)) polygon.cut(other);
    }
    areas.push_back(polygon.face());
  }
}

using PlanesUsed = std::array<bool, VoronoiCell::max_planes>;

/// Which planes have an edge.
PlanesUsed planes_used(const VoronoiCell& cell) {
  PlanesUsed used{};
  cell.for_each_edge(0, [&](size_t, size_t, uint32_t a, uint32_t b) { used[a] = used[b] = true; });
  return used;
}

/// The same after a walk, in lengths of `unit`; false if they are not known.
bool add_areas(const VoronoiCell& cell, double unit, FaceAreas& of_cell,
               std::vector<WallFace>& areas) {
  if (!of_cell.find(cell)) return false;
  for (size_t i = 0; i < cell.count(); ++i) {
    if (!of_cell.has_edge(i)) continue;
    const WallFace face = of_cell.face(i);
    areas.push_back({face.area * (unit * unit), face.middle * unit});
  }
  return true;
}

class FaceBuilder {
 public:
  /// `areas`: null where they are not wanted. `stretch`: of the cells, or null; not with areas.
  void build(const FoamSeeds& seeds, CellIndex corner, const Stretch* stretch,
             std::vector<FaceBrick::Cell>& cells, std::vector<FaceBrick::Face>& faces,
             std::vector<WallFace>* areas) {
    constexpr int side = FaceBrick::side;
    is_stretched_ = stretch != nullptr;
    if (stretch) factor_ = stretch->factor() * (1 / stretch->max_factor());
    cells_.move_to(seeds, corner, side);
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y) {
        check_cancelled();
        for (int x = 0; x < side; ++x) {
          const size_t own = cells_.block().index(x, y, z);
          planes_.clear();
          low_ = Vec3{1, 1, 1} * 1e300;
          high_ = low_ * -1.0;
          const bool is_walked = find_by_walk(own);
          if (!is_walked && !find_by_cuts(own)) take_all();
          add(cells_.block().position(own), cells, faces);
          if (areas && !(is_walked && add_areas(cells_.walked(), 1, areas_, *areas)))
            add_areas(planes_, cells_.empty_radius(), polygon_, *areas);
        }
      }
  }

  size_t bytes() const { return sizeof *this - sizeof cells_ + cells_.bytes(); }

 private:
  void enclose(Vec3 vertex) {
    low_ = min(low_, vertex);
    high_ = max(high_, vertex);
  }

  bool find_by_walk(size_t own) {
    if (cells_.walk(own) < 0) return false;
    const VoronoiCell& cell = cells_.walked();
    const BrickSeeds& block = cells_.block();
    const PlanesUsed used = planes_used(cell);
    const Vec3 seed = block.position(own);
    for (size_t i = 0; i < cell.count(); ++i)
      if (used[i]) planes_.push_back(block.position(cell.planes().seed[i]) - seed);
    for (size_t v = 0; v < cell.vertex_count(); ++v) enclose(cell.vertex(v));
    return true;
  }

  bool find_by_cuts(size_t own) {
    if (!cells_.cut(own)) return false;
    const std::vector<BrickCells::Neighbour>& neighbours = cells_.neighbours();
    used_.assign(neighbours.size(), false);
    for (const ClippedCell::Vertex& vertex : cells_.clipped().vertices()) {
      if (!vertex.is_there) continue;
      enclose(vertex.position);
      for (const uint32_t plane : vertex.plane)
        if (plane >= ClippedCell::first_neighbour)
          used_[plane - ClippedCell::first_neighbour] = true;
    }
    for (size_t i = 0; i < used_.size(); ++i)
      if (used_[i]) planes_.push_back(neighbours[i].position);
    return true;
  }

  void take_all() {
    planes_.clear();
    for (const BrickCells::Neighbour& n : cells_.neighbours()) planes_.push_back(n.position);
    high_ = Vec3{1, 1, 1} * cells_.empty_radius();
    low_ = high_ * -1.0;
  }

  void add(Vec3 seed, std::vector<FaceBrick::Cell>& cells, std::vector<FaceBrick::Face>& faces) {
    if (is_stretched_) {
      seed = seed * factor_;
      low_ = low_ * factor_;
      high_ = high_ * factor_;
    }
    FaceBrick::Cell cell{seed, {}, {}, static_cast<uint32_t>(faces.size()), 0};
    cell.set_box({low_, high_});
    for (const Vec3& apart : planes_)
      is_stretched_ ? add_stretched(apart, faces) : msq::add_face(apart, faces);
    cell.count = static_cast<uint32_t>(faces.size()) - cell.first;
    cells.push_back(cell);
  }

  /// A plane apart . x = |apart|^2 / 2 of the diagram is (apart / factor) . X = |apart|^2 / 2 where
  /// X = factor x.
  void add_stretched(Vec3 apart, std::vector<FaceBrick::Face>& faces) const {
    const Vec3 normal{apart.x / factor_.x, apart.y / factor_.y, apart.z / factor_.z};
    const double size = length(normal);
    const Vec3 n = normal * (1 / size);
    faces.push_back({{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                     static_cast<float>(0.5 * dot(apart, apart) / size)});
  }

  BrickCells cells_;
  FacePolygon polygon_;
  FaceAreas areas_;
  std::vector<bool> used_;
  std::vector<Vec3> planes_;  // of the cell at hand: neighbours, from the own seed
  Vec3 low_, high_;           // of its vertices
  bool is_stretched_ = false;
  Vec3 factor_;  // from the space of the diagram; at most 1
};

/// The same of a power diagram.
class WeightedFaceBuilder {
 public:
  void build(const FoamSeeds& seeds, CellIndex corner, std::vector<FaceBrick::Cell>& cells,
             std::vector<FaceBrick::Face>& faces) {
    constexpr int side = FaceBrick::side;
    cells_.move_to(seeds, corner, side);
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y) {
        check_cancelled();
        for (int x = 0; x < side; ++x) {
          const size_t own = cells_.block().index(x, y, z);
          const WeightedCells::Found found = cells_.find(own);
          if (found == WeightedCells::Found::none) continue;
          found == WeightedCells::Found::walked
              ? add_walked(own, cells, faces)
              : add(own, found == WeightedCells::Found::cell, cells, faces);
        }
      }
  }

  size_t bytes() const { return sizeof *this - sizeof cells_ + cells_.bytes(); }

 private:
  void add_walked(size_t own, std::vector<FaceBrick::Cell>& cells,
                  std::vector<FaceBrick::Face>& faces) {
    const VoronoiCell& walked = cells_.walked();
    const Vec3 seed = cells_.block().position(own);
    const PlanesUsed used = planes_used(walked);
    Vec3 low = Vec3{1, 1, 1} * 1e300, high = low * -1.0;
    for (size_t v = 0; v < walked.vertex_count(); ++v) {
      low = min(low, walked.vertex(v));
      high = max(high, walked.vertex(v));
    }
    begin(own, low, high, cells, faces);
    for (size_t i = 0; i < walked.count(); ++i) {
      if (!used[i]) continue;
      const uint32_t other = walked.planes().seed[i];
      const Vec3 d = cells_.block().position(other) - seed;
      const double size = length(d);
      add_face(d * (1 / size), 0.5 * (dot(d, d) + (cells_.lift(other) - cells_.lift(own))) / size,
               faces);
    }
    cells.back().count = static_cast<uint32_t>(faces.size()) - cells.back().first;
  }

  void begin(size_t own, Vec3 low, Vec3 high, std::vector<FaceBrick::Cell>& cells,
             const std::vector<FaceBrick::Face>& faces) const {
    FaceBrick::Cell cell{
        cells_.block().position(own), {}, {}, static_cast<uint32_t>(faces.size()), 0};
    cell.set_box({low, high});
    cells.push_back(cell);
  }

  static void add_face(Vec3 n, double distance, std::vector<FaceBrick::Face>& faces) {
    faces.push_back({{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                     static_cast<float>(distance)});
  }

  /// knows_cell: otherwise all planes stand for the faces, in a cube that holds the cell.
  void add(size_t own, bool knows_cell, std::vector<FaceBrick::Cell>& cells,
           std::vector<FaceBrick::Face>& faces) {
    const std::vector<WeightedCells::Neighbour>& neighbours = cells_.neighbours();
    Vec3 high = Vec3{1, 1, 1} * cells_.empty_radius(), low = high * -1.0;
    used_.assign(neighbours.size(), !knows_cell);
    if (knows_cell) {
      std::swap(low, high);
      for (const ClippedCell::Vertex& vertex : cells_.clipped().vertices()) {
        if (!vertex.is_there) continue;
        low = min(low, vertex.position);
        high = max(high, vertex.position);
        for (const uint32_t plane : vertex.plane)
          if (plane >= ClippedCell::first_neighbour)
            used_[plane - ClippedCell::first_neighbour] = true;
      }
    }
    begin(own, low, high, cells, faces);
    for (size_t i = 0; i < used_.size(); ++i)
      if (used_[i])
        add_face(neighbours[i].position * (1 / length(neighbours[i].position)), neighbours[i].plane,
                 faces);
    cells.back().count = static_cast<uint32_t>(faces.size()) - cells.back().first;
  }

  WeightedCells cells_;
  std::vector<bool> used_;
};

}  // namespace

void FaceBrick::Cell::set_box(const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = static_cast<float>(box.min[axis] - 2 * box_slack);
    high[axis] = static_cast<float>(box.max[axis] + 2 * box_slack);
  }
}

bool FaceBrick::walk(const FoamSeeds& seeds, CellIndex corner, Vec3 factor) {
  const Borrowed<FacetFaces> faces;
  return faces->build(seeds, corner, factor, cells_, faces_);
}

FaceBrick::FaceBrick(const FoamSeeds& seeds, CellIndex corner, bool with_areas) {
  cells_.reserve(size_t{side} * side * side);
  faces_.reserve(size_t{side} * side * side * 17);
  if (!with_areas && walk(seeds, corner, {1, 1, 1})) return;
  const Borrowed<FaceBuilder> builder;
  if (with_areas) areas_.reserve(faces_.capacity());
  builder->build(seeds, corner, nullptr, cells_, faces_, with_areas ? &areas_ : nullptr);
}

FaceBrick::FaceBrick(Weighted, const FoamSeeds& seeds, CellIndex corner) {
  const Borrowed<WeightedFaceBuilder> builder;
  cells_.reserve(size_t{side} * side * side);
  faces_.reserve(size_t{side} * side * side * 17);
  builder->build(seeds, corner, cells_, faces_);
}

FaceBrick::FaceBrick(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex corner,
                     bool with_areas) {
  // The density field may be the host's, which may call msq again.
  const Borrowed<GradedCells> borrowed;
  GradedCells& graded = *borrowed;
  graded.move_to(seeds, corner);
  const int brick_side = seeds->brick_side();
  std::vector<LeafSeed> owners;
  for (int z = 0; z < brick_side; ++z)
    for (int y = 0; y < brick_side; ++y)
      for (int x = 0; x < brick_side; ++x)
        graded.append_seeds({corner.x + x, corner.y + y, corner.z + z}, owners);
  cells_.reserve(owners.size());
  faces_.reserve(owners.size() * 17);
  if (with_areas) areas_.reserve(faces_.capacity());
  FacePolygon polygon;
  FaceAreas of_cell;
  std::vector<Vec3> neighbours;
  for (const LeafSeed& own : owners) {
    check_cancelled();
    graded.find(own);
    Box3 box;
    graded.find_faces(neighbours, box);
    Cell cell{own.position, {}, {}, static_cast<uint32_t>(faces_.size()), 0};
    cell.set_box(box);
    for (const Vec3& apart : neighbours) add_face(apart, faces_);
    const VoronoiCell* const walked = graded.walked();
    if (with_areas && !(walked && add_areas(*walked, graded.unit(), of_cell, areas_)))
      add_areas(neighbours, seeds->cells().empty_radius(), polygon, areas_);
    cell.count = static_cast<uint32_t>(faces_.size()) - cell.first;
    cells_.push_back(cell);
  }
}

FaceBrick::FaceBrick(const Stretch& stretch, CellIndex corner) {
  cells_.reserve(size_t{side} * side * side);
  faces_.reserve(size_t{side} * side * side * 17);
  if (walk(stretch.seeds(), corner, stretch.factor() * (1 / stretch.max_factor()))) return;
  const Borrowed<FaceBuilder> builder;
  builder->build(stretch.seeds(), corner, &stretch, cells_, faces_, nullptr);
}

}  // namespace msq

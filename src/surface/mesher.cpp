// SPDX-License-Identifier: Apache-2.0
#include "surface/mesher.h"

#include <algorithm>
#include <optional>

#include "base/memory.h"
#include "base/status.h"
#include "query/reach.h"
#include "surface/mesh_edges.h"
#include "surface/mesh_topology.h"
#include "surface/mesh_vertices.h"

namespace msq {

namespace {

/// Nodes that are found at once.
constexpr uint64_t max_node_bytes = uint64_t{32} << 20, max_node_layers = 64;
/// Crossings of a part, if it has more than one layer.
constexpr uint64_t max_crossings = uint64_t{1} << 18;
/// About as many vertices as crossings, and two triangles for each.
constexpr uint64_t bytes_of_crossing =
    sizeof(Crossing) + MeshVertices::bytes + 3 * sizeof(float) + 6 * sizeof(uint32_t);

/// The part of a box in which the model is. False if there is none.
bool find_box(const Model& model, const MeshPlan& plan, Box3& box) {
  box = plan.has_box ? plan.box : model.bounds();
  box.min = max(box.min, model.bounds().min);
  box.max = min(box.max, model.bounds().max);
  return box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
}

class Mesher {
 public:
  Mesher(const Model& model, const MeshPlan& plan, const Box3& box, JobPart progress)
      : model_(model),
        progress_(progress),
        resolved_(model.resolved(plan.length_scale)),
        grid_(box, plan.pitch),
        nodes_(model, resolved_, grid_),
        topology_(model, resolved_, nodes_),
        edges_(model, resolved_, nodes_),
        vertices_(model, resolved_, nodes_) {
    require_reach(model, resolved_, box, "the box");
    const uint64_t layer = nodes_.row_words() * sizeof(uint64_t) * grid_.nodes(1);
    const uint64_t fit = std::clamp<uint64_t>(max_node_bytes / layer, 1, max_node_layers);
    deep_ = static_cast<uint32_t>(
        std::min<uint64_t>(plan.slab_layers ? plan.slab_layers : fit, grid_.nodes(2) - 1));
    max_crossings_ = plan.slab_layers ? UINT64_MAX : max_crossings;
  }

  /// Without `take` only the connections are found.
  MeshSize run(const std::function<void(const MeshSlab&)>& take) {
    const uint32_t layers = grid_.nodes(2) - 1;
    const std::shared_ptr<MemoryBudget>& budget = model_.context().budget;
    const Reservation room(budget, nodes_.bytes(deep_), "the nodes of a mesh");
    for (uint32_t k = 0; k < layers; k += deep_) {
      const uint32_t end = std::min(layers, k + deep_);
      nodes_.load(k, end, progress_.job);
      for (uint32_t first = k; first < end;) {
        check_cancelled(progress_.job);
        uint64_t crossings = take ? edges_.count(first) : 0;
        uint32_t part_end = first + 1;
        for (; part_end < end; ++part_end) {
          const uint64_t more = take ? edges_.count(part_end) : 0;
          if (crossings + more > max_crossings_) break;
          crossings += more;
        }
        topology_.add(first, part_end, progress_.job);
        if (take) {
          const Reservation part(budget, crossings * bytes_of_crossing, "the crossings of a mesh");
          edges_.find(first, part_end, progress_.job);
          vertices_.find(topology_, edges_, first, part_end, progress_.job);
          deliver(first, part_end, take);
        }
        first = part_end;
        progress_.set_progress(static_cast<double>(first) / static_cast<double>(layers));
      }
    }
    return {topology_.vertices(), topology_.triangles()};
  }

 private:
  void deliver(uint32_t first, uint32_t end, const std::function<void(const MeshSlab&)>& take) {
    std::vector<uint64_t> starts{0};
    for (uint32_t k = first; k < end; ++k)
      starts.push_back(starts.back() + topology_.layer(k).triangles);
    triangles_.resize(3 * starts.back());
    model_.executor().for_each(end - first, [&](uint64_t n) {
      check_cancelled(progress_.job);
      connect(first + static_cast<uint32_t>(n), triangles_.data() + 3 * starts[n]);
    });
    const uint64_t begin = topology_.layer(first).first_vertex;
    const uint64_t known = begin - vertices_.first();
    const std::vector<Vec3>& normals = vertices_.normals();
    normals_.clear();
    for (size_t i = known; i < normals.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) normals_.push_back(static_cast<float>(normals[i][axis]));
    const MeshSlab slab{begin,
                        vertices_.places().size() - known,
                        vertices_.places().data() + known,
                        normals_.data(),
                        first_triangle_,
                        starts.back(),
                        triangles_.data(),
                        vertices_.first(),
                        vertices_.places().data()};
    first_triangle_ += slab.triangle_count;
    if (slab.vertex_count > 0 || slab.triangle_count > 0) take(slab);
  }

  Vec3 place(uint32_t vertex) const { return vertices_.places()[vertex - vertices_.first()]; }

  /// The polygons of a layer: two triangles for each edge in order, then the rest of those that
  /// have more.
  void connect(uint32_t k, uint32_t* out) const {
    const std::vector<GridEdge>& special = topology_.layer(k).middles;
    uint64_t plain = 0;
    for (int axis = 0; axis < 3; ++axis) plain += edges_.edges(axis, k).crossings.size();
    uint32_t* rest = out + 6 * plain;
    auto next = special.begin();
    const auto put = [](uint32_t*& to, uint32_t a, uint32_t b, uint32_t c) {
      *to++ = a;
      *to++ = b;
      *to++ = c;
    };
    for (int axis = 0; axis < 3; ++axis)
      for (const Crossing& c : edges_.edges(axis, k).crossings) {
        // Counter-clockwise as seen from the high end, which is outside if the low one is inside.
        const bool up = nodes_.inside(c.column, c.row, k);
        const GridEdge edge{k, axis, c.row, c.column};
        if (next != special.end() && *next == edge) {
          ++next;
          const uint32_t middle = topology_.middle(edge);
          uint32_t around[8];
          size_t count = 0;
          for (unsigned side = 0; side < 4; ++side) {
            around[count++] = c.vertices[side];
            if (topology_.find_arc(edge, side, around[count])) ++count;
          }
          for (size_t n = 0; n < count; ++n) {
            const uint32_t a = around[n], b = around[(n + 1) % count];
            put(n < 2 ? out : rest, middle, up ? a : b, up ? b : a);
          }
          continue;
        }
        uint32_t v[4] = {c.vertices[0], c.vertices[1], c.vertices[2], c.vertices[3]};
        if (!up) std::swap(v[1], v[3]);
        if (cuts_from_first(v, c.normal)) {
          put(out, v[0], v[1], v[2]);
          put(out, v[0], v[2], v[3]);
        } else {
          put(out, v[1], v[2], v[3]);
          put(out, v[1], v[3], v[0]);
        }
      }
  }

  /// Which diagonal cuts a polygon of four: the one whose triangles look along the normal of the
  /// crossing, or else the shorter.
  bool cuts_from_first(const uint32_t v[4], Vec3 normal) const {
    const Vec3 p[4] = {place(v[0]), place(v[1]), place(v[2]), place(v[3])};
    const auto along = [&](int a, int b, int c) {
      return dot(cross(p[b] - p[a], p[c] - p[a]), normal);
    };
    const bool first = std::min(along(0, 1, 2), along(0, 2, 3)) > 0;
    const bool second = std::min(along(1, 2, 3), along(1, 3, 0)) > 0;
    if (first != second) return first;
    const Vec3 d = p[2] - p[0], e = p[3] - p[1];
    return dot(d, d) <= dot(e, e);
  }

  const Model& model_;
  const JobPart progress_;
  const Scales resolved_;
  const MeshGrid grid_;
  MeshNodes nodes_;
  MeshTopology topology_;
  MeshEdges edges_;
  MeshVertices vertices_;
  uint32_t deep_ = 1;
  uint64_t max_crossings_ = 0, first_triangle_ = 0;
  std::vector<uint32_t> triangles_;
  std::vector<float> normals_;
};

MeshSize run_mesher(const Model& model, const MeshPlan& plan,
                    const std::function<void(const MeshSlab&)>& take, JobPart progress) {
  if (!plan.has_box && !model.shape().is_bounded())
    fail(Status::argument, "has_box is 0; a model of all space has no bounds, so give a box");
  Box3 box;
  if (!find_box(model, plan, box)) return {};
  return Mesher(model, plan, box, progress).run(take);
}

}  // namespace

void make_mesh(const Model& model, const MeshPlan& plan,
               const std::function<void(const MeshSlab&)>& take, JobPart progress) {
  run_mesher(model, plan, take, progress);
}

MeshSize count_mesh(const Model& model, const MeshPlan& plan, JobPart progress) {
  return run_mesher(model, plan, nullptr, progress);
}

}  // namespace msq

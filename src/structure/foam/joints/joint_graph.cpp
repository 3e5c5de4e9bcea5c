// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/joint_graph.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/job.h"

namespace msq {

void JointGraph::start(NamedSeeds& seeds, CellIndex corner, int side, size_t expected) {
  finder_.move_to(seeds);
  corner_ = corner;
  side_ = side;
  is_certain_ = true;
  joints_.clear();
  by_id_.reset(expected);
}

void JointGraph::add_at(Vec3 p, double error) {
  const bool is_certain = finder_.find(p, error, [&](Joint& joint) { add(std::move(joint)); });
  is_certain_ = is_certain_ && is_certain;
}

void JointGraph::add(Joint&& joint) {
  const auto number = static_cast<uint32_t>(joints_.size());
  if (by_id_.find_or_add(joint.id, number) == number) joints_.push_back(std::move(joint));
}

bool JointGraph::is_in_brick(CellIndex cell) const {
  const auto is_in = [&](int32_t low, int32_t at) { return at >= low && at - low < side_; };
  return is_in(corner_.x, cell.x) && is_in(corner_.y, cell.y) && is_in(corner_.z, cell.z);
}

const NamedSeed& JointGraph::owner(const Edge& edge) const {
  return joints_[edge.ends[0]].seeds[static_cast<size_t>(std::countr_zero(edge.face))];
}

void JointGraph::add_faces(uint32_t joint, bool all) {
  const std::vector<NamedSeed>& seeds = joints_[joint].seeds;
  JointFace inside = 0;
  for (size_t i = 0; i < seeds.size(); ++i)
    if (is_in_brick(seeds[i].cell)) inside |= JointFace{1} << i;
  if (inside == 0) return;
  finder_.for_each_face(joints_[joint], [&](JointFace face) {
    if (!(inside & (all ? face : face & (~face + 1)))) return;
    IdHash hash(4);
    for (JointFace rest = face; rest; rest &= rest - 1)
      seeds[static_cast<size_t>(std::countr_zero(rest))].add_name(hash);
    const Id id = hash.id();
    const auto number = static_cast<uint32_t>(edges_.size());
    const uint32_t known = by_seeds_.find_or_add(id, number);
    if (known == number)
      edges_.push_back({id, {joint, joint}, face});
    else if (edges_[known].ends[0] == edges_[known].ends[1])
      edges_[known].ends[1] = joint;
  });
}

void JointGraph::add_all_faces(bool all) {
  edges_.clear();
  by_seeds_.reset(4 * joints_.size());
  for (uint32_t joint = 0; joint < joints_.size(); ++joint) add_faces(joint, all);
}

bool JointGraph::has_open() const {
  return std::any_of(edges_.begin(), edges_.end(),
                     [](const Edge& edge) { return edge.ends[0] == edge.ends[1]; });
}

void JointGraph::follow_faces(bool all) {
  for (size_t i = 0; i < edges_.size(); ++i) {
    const Edge edge = edges_[i];
    if (edge.ends[0] != edge.ends[1]) continue;
    check_cancelled();
    Joint other;
    if (!finder_.follow(joints_[edge.ends[0]], edge.face, other)) continue;
    const auto number = static_cast<uint32_t>(joints_.size());
    add(std::move(other));
    if (joints_.size() > number) add_faces(number, all);
  }
}

void JointGraph::find_edges() {
  add_all_faces(false);
  if (is_certain_ && !has_open()) return;
  add_all_faces(true);
  follow_faces(true);
}

}  // namespace msq

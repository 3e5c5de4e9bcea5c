// SPDX-License-Identifier: Apache-2.0
#include "query/strut_graph.h"

#include <algorithm>

namespace msq {

namespace {

constexpr uint64_t strut_bytes = 2 * sizeof(uint32_t) + 2 * sizeof(double) + sizeof(Id) +
                                 sizeof(CellIndex) + 4 * sizeof(uint8_t);
constexpr uint64_t node_bytes = sizeof(Vec3) + sizeof(Id);
constexpr const char* what = "the graph of struts";
constexpr size_t max_nodes = 0xfffffffe;

}  // namespace

StrutGraph::StrutGraph(const Context& context, const StrutQuery& query, Job* job)
    : budget_(context.budget) {
  for_each_strut(context, query, job,
                 [&](const Strut* struts, size_t count) { add(struts, count); });
  numbers_ = {};
  of_table_ = {};
  set_room(ids_.size(), nodes_.size());
}

void StrutGraph::add(const Strut* struts, size_t count) {
  make_room(ids_.size() + count, nodes_.size() + 2 * count);
  for (size_t i = 0; i < count; ++i) {
    const Strut& s = struts[i];
    const uint32_t a = number_of(s.nodes[0], s.a), b = number_of(s.nodes[1], s.b);
    ends_.push_back({a, b});
    radii_.push_back({s.radii[0], s.radii[1]});
    ids_.push_back(s.id);
    cells_.push_back(s.cell);
    caps_.push_back({s.caps[0], s.caps[1]});
    cuts_.push_back({s.cut[0], s.cut[1]});
  }
}

uint32_t StrutGraph::number_of(Id id, Vec3 position) {
  if (nodes_.size() >= max_nodes)
    fail(Status::limit, "the struts have more than %zu nodes; the limit is that many", max_nodes);
  const auto next = static_cast<uint32_t>(nodes_.size());
  const uint32_t number = numbers_.find_or_add(id, next);
  if (number == next) {
    nodes_.push_back(position);
    node_ids_.push_back(id);
  }
  return number;
}

/// Room grows by doubling, and is accounted before it is taken.
void StrutGraph::make_room(size_t struts, size_t nodes) {
  if (struts > ids_.capacity() || nodes > nodes_.capacity())
    set_room(
        struts > ids_.capacity() ? std::max(struts, 2 * ids_.capacity()) : ids_.capacity(),
        nodes > nodes_.capacity() ? std::max(nodes, 2 * nodes_.capacity()) : nodes_.capacity());
}

void StrutGraph::set_room(size_t struts, size_t nodes) {
  Reservation for_struts(budget_, struts * strut_bytes, what);
  Reservation for_nodes(budget_, nodes * node_bytes, what);
  const auto resize = [](auto& array, size_t room) {
    if (array.capacity() == room) return;
    auto moved = std::move(array);
    array = {};
    array.reserve(room);
    array.assign(moved.begin(), moved.end());
  };
  resize(ends_, struts);
  resize(radii_, struts);
  resize(ids_, struts);
  resize(cells_, struts);
  resize(caps_, struts);
  resize(cuts_, struts);
  if (nodes != nodes_.capacity() && nodes > nodes_.size())
    of_table_ = Reservation(budget_, IdTable::bytes(nodes), what);
  resize(nodes_, nodes);
  resize(node_ids_, nodes);
  of_struts_ = std::move(for_struts);
  of_nodes_ = std::move(for_nodes);
}

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// Struts as arrays, joined at numbered nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/id_table.h"
#include "base/memory.h"
#include "base/ref.h"
#include "query/struts.h"

namespace msq {

class StrutGraph final : public RefCounted {
 public:
  StrutGraph(const Context& context, const StrutQuery& query, Job* job);

  const std::vector<Vec3>& nodes() const { return nodes_; }
  const std::vector<Id>& node_ids() const { return node_ids_; }
  /// Of each strut, as in Strut: the numbers of its nodes, its radii, and so on.
  const std::vector<std::array<uint32_t, 2>>& ends() const { return ends_; }
  const std::vector<std::array<double, 2>>& radii() const { return radii_; }
  const std::vector<Id>& ids() const { return ids_; }
  const std::vector<CellIndex>& cells() const { return cells_; }
  const std::vector<std::array<uint8_t, 2>>& caps() const { return caps_; }
  const std::vector<std::array<uint8_t, 2>>& cuts() const { return cuts_; }

 private:
  void add(const Strut* struts, size_t count);
  void make_room(size_t struts, size_t nodes);
  void set_room(size_t struts, size_t nodes);
  uint32_t number_of(Id id, Vec3 position);

  const std::shared_ptr<MemoryBudget> budget_;
  Reservation of_struts_, of_nodes_, of_table_;
  IdTable numbers_;
  std::vector<Vec3> nodes_;
  std::vector<Id> node_ids_;
  std::vector<std::array<uint32_t, 2>> ends_;
  std::vector<std::array<double, 2>> radii_;
  std::vector<Id> ids_;
  std::vector<CellIndex> cells_;
  std::vector<std::array<uint8_t, 2>> caps_, cuts_;
};

}  // namespace msq

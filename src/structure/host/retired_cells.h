// SPDX-License-Identifier: Apache-2.0
// Cells of the host that the cache has released. The cache may do so on any thread and holds a lock
// then. So the cells wait here until the host can be called to free them.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace msq {

class RetiredCells {
 public:
  struct Cell {
    void* data = nullptr;
    std::unique_ptr<Cell> next;
  };

  void add(std::unique_ptr<Cell> cell) noexcept {
    std::lock_guard lock(mutex_);
    cell->next = std::move(first_);
    first_ = std::move(cell);
  }
  /// Calls free(data) for each, with no lock held.
  template <class Free>
  void free_all(Free&& free) {
    std::unique_ptr<Cell> cell;
    {
      std::lock_guard lock(mutex_);
      cell = std::move(first_);
    }
    for (; cell; cell = std::move(cell->next)) free(cell->data);
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<Cell> first_;
};

}  // namespace msq

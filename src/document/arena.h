// SPDX-License-Identifier: Apache-2.0
// Memory for the arrays that definitions point to.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace msq::document {

class Arena {
 public:
  /// Zeros, aligned for any type.
  void* take(size_t bytes) {
    blocks_.push_back(std::make_unique<unsigned char[]>(bytes));
    return blocks_.back().get();
  }
  template <class T>
  T* take_array(size_t count) {
    return static_cast<T*>(take(count * sizeof(T)));
  }
  /// Keeps an object for as long as the arena.
  template <class T>
  T& keep(T object) {
    auto kept = std::make_shared<T>(std::move(object));
    objects_.push_back(kept);
    return *kept;
  }

 private:
  std::vector<std::unique_ptr<unsigned char[]>> blocks_;
  std::vector<std::shared_ptr<void>> objects_;
};

}  // namespace msq::document

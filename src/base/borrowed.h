// SPDX-License-Identifier: Apache-2.0
// Working memory that each thread keeps from call to call, where the work in between may call back
// to the host and so begin the same work again.
#pragma once

#include <exception>
#include <memory>
#include <utility>

namespace msq {

/// A T that nobody else works with, as whoever had it last left it; dropped after an exception.
template <class T>
class Borrowed {
 public:
  Borrowed() : object_(std::exchange(spare(), nullptr)) {
    if (!object_) object_ = std::make_unique<T>();
  }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  ~Borrowed() {
    if (std::uncaught_exceptions() == exceptions_) spare() = std::move(object_);
  }

  T& operator*() const { return *object_; }

 private:
  static std::unique_ptr<T>& spare() {
    thread_local std::unique_ptr<T> spare;
    return spare;
  }

  const int exceptions_ = std::uncaught_exceptions();
  std::unique_ptr<T> object_;
};

}  // namespace msq

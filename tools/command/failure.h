// SPDX-License-Identifier: Apache-2.0
// How the command fails: by exceptions, which main() turns into one line and an exit status.
#ifndef MSQ_COMMAND_FAILURE_H
#define MSQ_COMMAND_FAILURE_H

#include <msq.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace command {

// Exit statuses. A signal ends the command with SIGNALLED + its number: 130 for Ctrl-C.
enum ExitStatus { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_SIGNALLED = 128 };

// The work cannot be done. The text says what, with the value and the limit.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The command line makes no sense.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A signal asked the command to end.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

// Throws what a status of msq stands for. MSQ_OK: nothing.
void check(msq_status status);

// As check(), with the name of the file or option that the call was about.
void check(msq_status status, const std::string& subject);

// An object of msq that is released at the end.
template <class T, void (*RELEASE)(T*)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T* object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() { RELEASE(object_); }
  T* get() const { return object_; }
  // For a constructor of msq to write to.
  T** out() {
    RELEASE(std::exchange(object_, nullptr));
    return &object_;
  }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  T* object_ = nullptr;
};

using Context = Handle<msq_context, msq_context_release>;
using Document = Handle<msq_document, msq_document_release>;
using Shape = Handle<msq_shape, msq_shape_release>;
using Field = Handle<msq_field, msq_field_release>;
using Structure = Handle<msq_structure, msq_structure_release>;
using Model = Handle<msq_model, msq_model_release>;
using Slicer = Handle<msq_slicer, msq_slicer_release>;
using StrutGraph = Handle<msq_strut_graph, msq_strut_graph_release>;

// A definition of msq with its defaults: defaults(msq_foam_def_init).
template <class T>
T defaults(msq_status (*init)(T*, size_t)) {
  T def{};
  check(init(&def, sizeof def));
  return def;
}

// Keeps what a callback threw, so that no exception crosses msq. throw_again() throws it once the
// call has returned MSQ_E_HOST.
class Carried {
 public:
  template <class F>
  int32_t run(F&& body) noexcept {
    try {
      body();
      return 0;
    } catch (...) {
      problem_ = std::current_exception();
      return -1;
    }
  }
  // For the status of the call that ran the callback.
  void check(msq_status status) {
    if (problem_) std::rethrow_exception(std::exchange(problem_, nullptr));
    command::check(status);
  }

 private:
  std::exception_ptr problem_;
};

}  // namespace command

#endif

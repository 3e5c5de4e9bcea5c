// SPDX-License-Identifier: Apache-2.0
// Visits the members of a definition by their names, once for all purposes: a definition is copied
// (keeper.h), read from a document and written into one (document/) by the same list of members.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "msq.h"

namespace msq::api {

/// A value of an enumeration: the tail of its name in msq.h, in small letters.
struct Choice {
  const char* name;
  int32_t value;
};
using Choices = std::span<const Choice>;

/// Where the values of an image were read from.
struct ImageSource {
  const char* file;     ///< null: from memory, or from files
  int32_t is_nrrd;      ///< which says type, size and, without has_grid, the grid
  int32_t is_tiff;      ///< which says type and size
  int32_t has_grid;     ///< the document says it
  uint64_t skip_bytes;  ///< of a raw file, before the values
  int32_t is_big_endian;
  const char* const* files;  ///< of TIFF, one above the other
  uint64_t file_count;
};

class DefinitionWalk {
 public:
  /// Visits the members of something within a definition.
  using Part = std::function<void(DefinitionWalk&)>;

  virtual ~DefinitionWalk() = default;

  virtual void number(const char* key, double& value) = 0;
  /// As many numbers as there are. `may_be_one`: one number stands for all of them.
  virtual void numbers(const char* key, std::span<double> values, bool may_be_one = false) = 0;
  /// The same, if they are there. Returns whether they are.
  virtual bool optional_numbers(const char* key, bool is_there, std::span<double> values) = 0;
  /// From 0 to max.
  virtual void whole(const char* key, uint64_t& value, uint64_t max) = 0;
  virtual void wholes(const char* key, std::span<uint64_t> values, uint64_t max) = 0;
  virtual void truth(const char* key, int32_t& value) = 0;
  virtual void choice(const char* key, int32_t& value, Choices choices) = 0;
  /// A sum of choices.
  virtual void flags(const char* key, uint32_t& value, Choices choices) = 0;
  virtual void text(const char* key, const char*& value) = 0;
  /// The path of a file.
  virtual void file(const char* key, const char*& value) = 0;
  virtual void param(const char* key, msq_param& value) = 0;
  virtual void image(const char* key, msq_image& image, ImageSource& source) = 0;

  virtual void object(const char* key, const msq_shape*& value) = 0;
  virtual void object(const char* key, const msq_field*& value) = 0;
  virtual void object(const char* key, const msq_structure*& value) = 0;
  virtual void object(const char* key, const msq_material*& value) = 0;
  virtual void objects(const char* key, const msq_shape* const*& values, uint64_t& count) = 0;
  virtual void objects(const char* key, const msq_structure* const*& values, uint64_t& count) = 0;
  virtual void objects(const char* key, const msq_model* const*& values, uint64_t& count) = 0;

  /// Arrays of `count` tuples of `width` numbers. Null: none.
  virtual void tuples(const char* key, const double*& values, uint64_t& count, size_t width) = 0;
  virtual void tuples(const char* key, const uint32_t*& values, uint64_t& count, size_t width) = 0;
  virtual void tuples(const char* key, const uint8_t*& values, uint64_t& count, size_t width,
                      Choices choices) = 0;
  /// Names with numbers, whose order does not matter.
  virtual void named_values(const char* key, const msq_named_value*& values, uint64_t& count) = 0;

  /// Refuses arrays that are not as long as each other.
  virtual void equal_counts(const char* key, uint64_t count, const char* other,
                            uint64_t other_count) = 0;

  /// Members of an object within, which may be missing where all have their defaults.
  virtual void members(const char* key, const Part& part, const Part& defaults) = 0;
  /// The same where it matters whether it is there. Returns whether it is.
  virtual bool section(const char* key, bool is_there, const Part& part, const Part& defaults) = 0;

  template <class T>
  void whole(const char* key, T& value) {
    auto wide = static_cast<uint64_t>(value);
    whole(key, wide, static_cast<uint64_t>(std::numeric_limits<T>::max()));
    value = static_cast<T>(wide);
  }

  /// An array of structs, and a struct behind a pointer.
  template <class T, class Count>
  void structs(const char* key, const T*& values, Count& count, const T& defaults,
               void (*walk)(DefinitionWalk&, T&)) {
    T* elements = nullptr;
    const auto prepare = [&](uint64_t wanted) {
      elements = static_cast<T*>(room(values, wanted * sizeof(T), values ? wanted : 0));
      if (!values)
        for (uint64_t i = 0; i < wanted; ++i) elements[i] = defaults;
    };
    const auto part = [&](DefinitionWalk& in, uint64_t i) { walk(in, elements[i]); };
    const Part of_defaults = [&](DefinitionWalk& in) {
      T copy = defaults;
      walk(in, copy);
    };
    const uint64_t found =
        list(key, values ? static_cast<uint64_t>(count) : 0, prepare, part, of_defaults);
    values = elements;
    count = static_cast<Count>(found);
  }
  template <class T>
  void optional(const char* key, const T*& value, const T& defaults,
                void (*walk)(DefinitionWalk&, T&)) {
    T* copy = value ? static_cast<T*>(room(value, sizeof(T), 1)) : nullptr;
    const bool is_there = section(
        key, value != nullptr,
        [&](DefinitionWalk& in) {
          if (!copy) *(copy = static_cast<T*>(room(nullptr, sizeof(T), 0))) = defaults;
          walk(in, *copy);
        },
        [&](DefinitionWalk& in) {
          T of_defaults = defaults;
          walk(in, of_defaults);
        });
    value = is_there ? copy : nullptr;
  }

 protected:
  /// Memory for elements, with a copy of `from` unless `copied` is 0. One that changes nothing
  /// returns `from`.
  virtual void* room(const void* from, size_t bytes, uint64_t copied) = 0;
  /// Calls prepare(count) if there is a list, then part(walk, i) for each element. Returns the
  /// count.
  virtual uint64_t list(const char* key, uint64_t count,
                        const std::function<void(uint64_t)>& prepare,
                        const std::function<void(DefinitionWalk&, uint64_t)>& part,
                        const Part& defaults) = 0;
};

}  // namespace msq::api

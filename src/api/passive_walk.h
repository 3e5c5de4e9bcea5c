// SPDX-License-Identifier: Apache-2.0
// A walk over a definition that does nothing, from which those derive that look at some members.
#pragma once

#include "api/definition_walk.h"

namespace msq::api {

class PassiveWalk : public DefinitionWalk {
 public:
  void number(const char*, double&) override {}
  void numbers(const char*, std::span<double>, bool) override {}
  bool optional_numbers(const char*, bool is_there, std::span<double>) override { return is_there; }
  void whole(const char*, uint64_t&, uint64_t) override {}
  void wholes(const char*, std::span<uint64_t>, uint64_t) override {}
  void truth(const char*, int32_t&) override {}
  void choice(const char*, int32_t&, Choices) override {}
  void flags(const char*, uint32_t&, Choices) override {}
  void text(const char*, const char*&) override {}
  void file(const char*, const char*&) override {}
  void param(const char* key, msq_param& value) override { object(key, value.field); }
  void image(const char*, msq_image&, ImageSource&) override {}
  void tuples(const char*, const double*&, uint64_t&, size_t) override {}
  void tuples(const char*, const uint32_t*&, uint64_t&, size_t) override {}
  void tuples(const char*, const uint8_t*&, uint64_t&, size_t, Choices) override {}
  void named_values(const char*, const msq_named_value*&, uint64_t&) override {}
  void equal_counts(const char*, uint64_t, const char*, uint64_t) override {}
  void members(const char*, const Part& part, const Part&) override { part(*this); }
  bool section(const char*, bool is_there, const Part& part, const Part&) override {
    if (is_there) part(*this);
    return is_there;
  }

 protected:
  /// The elements themselves, which the walk must not change.
  void* room(const void* from, size_t, uint64_t) override { return const_cast<void*>(from); }
  uint64_t list(const char*, uint64_t count, const std::function<void(uint64_t)>& prepare,
                const std::function<void(DefinitionWalk&, uint64_t)>& part, const Part&) override {
    if (count > 0) prepare(count);
    for (uint64_t i = 0; i < count; ++i) part(*this, i);
    return count;
  }
};

}  // namespace msq::api

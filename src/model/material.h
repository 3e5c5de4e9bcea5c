// SPDX-License-Identifier: Apache-2.0
// Materials: an id and named channels, each a number or a field; and blends of two materials.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "field/field.h"

#include "base/described.h"

namespace msq {

class Material : public Described {
 public:
  uint32_t id() const { return id_; }
  /// The channel with the name, if there is one.
  std::optional<size_t> find(std::string_view name) const;
  const std::vector<std::string>& channels() const { return channels_; }
  /// Sets values[i] to the channel's value at points[i].
  virtual void values(size_t channel, const Vec3* points, size_t count, double* values) const = 0;
  virtual bool is_concurrent() const = 0;
  /// Nesting depth of blends.
  virtual unsigned depth() const { return 0; }
  /// The number of materials that a value is computed from, each counted as often as it is
  /// evaluated.
  virtual uint64_t terms() const { return 1; }

 protected:
  void describe_channels(HashInput& input) const;

  Material(uint32_t id, std::vector<std::string> channels)
      : id_(id), channels_(std::move(channels)) {}

 private:
  uint32_t id_;
  std::vector<std::string> channels_;
};

class PlainMaterial final : public Material {
 public:
  /// There is one parameter per channel.
  PlainMaterial(uint32_t id, std::vector<std::string> channels, std::vector<Parameter> parameters)
      : Material(id, std::move(channels)), parameters_(std::move(parameters)) {}

  void values(size_t channel, const Vec3* points, size_t count, double* values) const override {
    parameters_[channel].values(points, count, values);
  }
  bool is_concurrent() const override;

 private:
  void describe(HashInput& input) const override;
  std::vector<Parameter> parameters_;
};

/// Each channel is (1 - f) a + f b: a at f = 0, b at f = 1, to the last bit.
class MaterialBlend final : public Material {
 public:
  /// Both have the same channels, in any order.
  MaterialBlend(uint32_t id, Ref<const Material> a, Ref<const Material> b, Parameter fraction);

  void values(size_t channel, const Vec3* points, size_t count, double* values) const override;
  // Stored: a material may occur many times in a blend of blends.
  bool is_concurrent() const override { return is_concurrent_; }
  unsigned depth() const override { return depth_; }
  uint64_t terms() const override { return terms_; }

 private:
  void describe(HashInput& input) const override;
  Ref<const Material> a_, b_;
  Parameter fraction_;
  bool is_concurrent_;
  unsigned depth_;
  uint64_t terms_;
};

}  // namespace msq

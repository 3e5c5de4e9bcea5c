// SPDX-License-Identifier: Apache-2.0
#include "query/material.h"

#include "base/memory.h"
#include "base/run_parts.h"
#include "base/status.h"

namespace msq {

namespace {

/// Points of one part that have the same material.
struct Group {
  const Material* material;
  std::vector<uint64_t> numbers;
  std::vector<Vec3> positions;
};

void fill_group(const Group& group, const std::vector<std::string_view>& channels, uint32_t* ids,
                double* values) {
  const size_t count = group.positions.size();
  std::vector<double> of_channel(count);
  for (uint64_t number : group.numbers) ids[number] = group.material->id();
  for (size_t c = 0; c < channels.size(); ++c) {
    const auto found = group.material->find(channels[c]);
    if (!found) continue;
    group.material->values(*found, group.positions.data(), count, of_channel.data());
    for (size_t i = 0; i < count; ++i)
      values[group.numbers[i] * channels.size() + c] = of_channel[i];
  }
}

}  // namespace

void require_material(const Model& model, const Scales& resolved, const char* purpose) {
  for (size_t r = 0; r < model.regions().size(); ++r)
    if (!model.regions()[r]->has_material(resolved.regions[r]))
      fail(Status::argument, "%s, and no resolved scale of region %zu has a material", purpose, r);
  if (model.regions().empty() && !model.has_material(resolved))
    fail(Status::argument, "%s, and no resolved scale has a material", purpose);
}

void set_material(const Model& model, const Scales& resolved, const PointSet& points,
                  const QueryPlan& plan, const std::vector<std::string_view>& channels,
                  uint32_t* ids, double* values, Job* job) {
  const Reservation reservation(model.context().budget, points.count(), "membership of points");
  std::vector<uint8_t> inside(points.count());
  Job first(job);  // the first half of the work
  set_membership(model, resolved, points, plan, inside.data(), job ? &first : nullptr);
  run_parts(model.executor(), points.parts(), job, {0.5, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    std::vector<Group> groups;
    uint32_t skin_part = 0;
    for (size_t i = 0; i < part.numbers.size(); ++i) {
      const uint64_t number = part.numbers[i];
      ids[number] = 0;
      for (size_t c = 0; c < channels.size(); ++c) values[number * channels.size() + c] = 0;
      if (!inside[number]) continue;
      const Material* material = model.material(part.positions[i], resolved, skin_part);
      auto group = groups.begin();
      while (group != groups.end() && group->material != material) ++group;
      if (group == groups.end()) group = groups.insert(group, Group{material, {}, {}});
      group->numbers.push_back(number);
      group->positions.push_back(part.positions[i]);
    }
    for (const Group& group : groups) fill_group(group, channels, ids, values);
  });
  if (job) job->counts().add(first.counts());
}

}  // namespace msq

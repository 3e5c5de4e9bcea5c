// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/shell/shelled_foam.h"

#include <algorithm>
#include <cmath>

#include "base/hash_input.h"
#include "base/infinity.h"
#include "structure/common/shell_rays.h"
#include "structure/foam/shell/shelled_struts.h"

namespace msq {

ShelledFoam::ShelledFoam(Ref<const Structure> foam, std::shared_ptr<const CellShell> shell)
    : Structure(foam->neighbourhood(), foam->characteristic_length()),
      foam_(std::move(foam)),
      shell_(std::move(shell)) {}

// Of two solids, the greater of the signed distances bounds that of what they have in common.
double ShelledFoam::distance_bound(Vec3 p) const {
  const double bound = std::abs(std::max(foam_->distance(p), -shell_->distance_within(p)));
  return std::max(0.0, bound - 2 * shell_->slack(p, bound));
}

double ShelledFoam::onset(Vec3 p) const {
  return shell_->holds(p) ? foam_->onset(p) : infinity;
}

void ShelledFoam::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  for (size_t i = 0; i < count; ++i) {
    if (i % 1024 == 0) check_cancelled();
    if (alive[i] && !shell_->holds(points[i])) alive[i] = 0;
  }
  foam_->keep_points(points, alive, count);
}

BoxClass ShelledFoam::classify(const Box3& box) const {
  const BoxClass of_shell = shell_->classify(box);
  if (of_shell == BoxClass::outside) return of_shell;
  const BoxClass of_foam = foam_->classify(box);
  return of_shell == BoxClass::inside || of_foam == BoxClass::outside ? of_foam : BoxClass::mixed;
}

void ShelledFoam::keep_rows(const RowBlock& block, const Job* job) const {
  if (shell_->keep_rows(block, job)) foam_->keep_rows(block, job);
}

void ShelledFoam::enter(RaySearch* searches, size_t count, const Job* job) const {
  enter_in_shell(*shell_, *this, searches, count,
                 [&](RaySearch* queried, size_t n) { foam_->enter(queried, n, job); });
}

double ShelledFoam::leave(const Ray& ray, double from, double to, const Job* job) const {
  return leave_in_shell(*shell_, *this, ray, from, to, [&](double begin, double end, double& t) {
    t = foam_->leave(ray, begin, end, job);
    return t < end;
  });
}

Vec3 ShelledFoam::normal(const Ray& ray, double t) const {
  return enters_shell(*shell_, *this, ray, t) ? shell_->normal(ray.at(t)) : foam_->normal(ray, t);
}

std::unique_ptr<StrutParts> ShelledFoam::struts(const StrutSelection& selection) const {
  return shelled_struts(foam_->struts(selection), *shell_);
}

ThinWalls ShelledFoam::thin_walls() const {
  return foam_->thin_walls() == ThinWalls::none ? ThinWalls::none : ThinWalls::varying;
}

LineGraph ShelledFoam::wall_lines(const WallSection& section) const {
  LineGraph graph = foam_->wall_lines(section);
  decltype(graph.lines) lines;
  lines.swap(graph.lines);
  const double tolerance = ray_tolerance();
  JobPoll poll(current_job());
  for (const std::array<uint32_t, 2>& line : lines) {
    poll();
    const Vec2 begin = graph.points[line[0]], way = graph.points[line[1]] - begin;
    const double span = length(way);
    if (!(span > 0)) continue;
    const Ray ray{{begin.x, begin.y, section.z}, {way.x / span, way.y / span, 0}};
    const RayParts parts = shell_->parts_of(ray, 0, span, tolerance);
    const auto point_at = [&](double t) {
      if (t <= 0) return line[0];
      if (t >= span) return line[1];
      graph.points.push_back(begin + way * (t / span));
      return static_cast<uint32_t>(graph.points.size() - 1);
    };
    for (size_t i = 0; i < parts.count; ++i)
      if (parts.part[i].from < parts.part[i].to) {
        const uint32_t from = point_at(parts.part[i].from);
        graph.lines.push_back({from, point_at(parts.part[i].to)});
      }
  }
  return graph;
}

void ShelledFoam::describe(HashInput& input) const {
  input.kind("structure: foam in a shell");
  shell_->describe(input);
  input.object(*foam_);
}

}  // namespace msq

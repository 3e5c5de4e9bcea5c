// SPDX-License-Identifier: Apache-2.0
// Calibration of structures, statistics of models.
#include "query/statistics.h"

#include "api/points.h"
#include "query/calibration.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t max_pairs = 1 << 20, max_lengths = 4096;

/// A stratified sample whose strata give standard errors.
StratifiedPoints read_sample(const msq_points_def* sample) {
  const msq_points_def known = read_def(sample, points_defaults(), "sample");
  if (known.kind != MSQ_POINTS_STRATIFIED)
    fail(Status::argument, "kind is %d; a sample is MSQ_POINTS_STRATIFIED, %d", known.kind,
         MSQ_POINTS_STRATIFIED);
  require_reserved(known.reserved, "reserved");
  require_reserved(known.reserved2, "reserved2");
  if (known.per_cell < 2 || known.per_cell > PointSet::max_in_part)
    fail(Status::argument, "per_cell is %u; for standard errors it must be from 2 to %llu",
         known.per_cell, static_cast<unsigned long long>(PointSet::max_in_part));
  return StratifiedPoints(read_strata(known));
}

/// 2 points in each of 64^3 cells of a box of the structure's own cells, from its grid's origin:
/// one cell where all are alike, otherwise 16^3. Of several grids that with the largest cells.
StratifiedPoints usual_sample(const Structure& structure) {
  constexpr uint64_t side = 64;
  if (!structure.is_alike_from_origin())
    fail(Status::argument,
         "sample is NULL, and cells around an axis or a point differ from those at the grid's "
         "origin; give a sample of the part");
  Neighbourhood grid = structure.neighbourhood();
  structure.for_each_grid([&](const Neighbourhood& other) {
    if (max_component(other.cell_size) > max_component(grid.cell_size)) grid = other;
  });
  Strata strata;
  strata.origin = grid.origin;
  strata.rotation = grid.rotation;
  strata.cell_size = grid.cell_size * ((structure.is_periodic() ? 1.0 : 16.0) / side);
  strata.counts = {side, side, side};
  strata.per_cell = 2;
  return StratifiedPoints(strata);
}

msq_segments_def segments_defaults() {
  msq_segments_def def{};
  def.phase = MSQ_PHASE_SOLID;
  return def;
}

msq_estimate given(const Estimate& e) {
  return {e.value, e.standard_error, e.interval.low, e.interval.high};
}

/// The arguments of a statistic: kept alive, so that StatisticsOf can refer to them.
class Queried {
 public:
  Queried(const msq_model* model, const msq_points_def* sample, const msq_query_def* query,
          int32_t phase)
      : model_(object(model, "model")),
        keep_(&model_),
        sample_(read_sample(sample)),
        query_(read_query(query)),
        resolved_(model_.resolved(query_.length_scale)),
        of_void_(require_range(phase, MSQ_PHASE_SOLID, MSQ_PHASE_VOID, "phase") == MSQ_PHASE_VOID) {
  }

  const Scales& resolved() const { return resolved_; }
  /// Throws Error(limit) where a model of all space cannot be queried so far around the sample.
  void require_reach(double around) const {
    msq::require_reach(model_, resolved_, sample_, around);
  }
  StatisticsOf of() const { return {model_, resolved_, query_.plan, sample_, of_void_}; }

 private:
  const Model& model_;
  Ref<const Model> keep_;  // callbacks may release the host's last reference
  StratifiedPoints sample_;
  Query query_;
  Scales resolved_;
  bool of_void_;
};

Segments read_segments(const msq_segments_def& def) {
  Segments segments;
  segments.direction = require_vector(def.direction, "direction");
  const double most = max_magnitude(segments.direction);
  if (most > 0) {
    const Vec3 scaled = segments.direction * (1 / most);
    segments.direction = scaled * (1 / length(scaled));
    if (!is_finite(segments.direction))
      fail(Status::argument, "direction is (%g, %g, %g); it is too short to be one",
           def.direction[0], def.direction[1], def.direction[2]);
  }
  if (def.length_count < 1 || def.length_count > max_lengths)
    fail(Status::argument, "length_count is %llu; it must be from 1 to %llu",
         static_cast<unsigned long long>(def.length_count),
         static_cast<unsigned long long>(max_lengths));
  require(def.lengths, "lengths");
  for (uint64_t i = 0; i < def.length_count; ++i) {
    const double length = def.lengths[i];
    if (!(length >= 0) || !std::isfinite(length))
      fail(Status::argument, "length %llu is %g; it must be finite and not negative",
           static_cast<unsigned long long>(i), length);
    segments.lengths.push_back(length);
  }
  return segments;
}

/// The step of a lineal path. Throws Error(limit) where segments would have more of them than make
/// sense.
double read_step(const msq_segments_def& def, const Segments& segments, const Queried& queried) {
  constexpr double max_steps = 1e6, usual_steps = 256;
  const double longest = *std::max_element(segments.lengths.begin(), segments.lengths.end());
  double step = def.step;
  if (!(step >= 0) || !std::isfinite(step))
    fail(Status::argument, "step is %g; it must be finite and not negative", step);
  if (step == 0) {
    step = longest;
    for (const Scale* scale : queried.resolved())
      step = std::min(step, scale->structure->cell_length());
    step /= usual_steps;
  }
  if (longest > step * max_steps)
    fail(Status::limit, "a length is %g, and step %g; the limit is %g steps", longest, step,
         max_steps);
  return step;
}

template <class Estimates>
void ask_segments(const msq_model* model, const msq_points_def* sample, const msq_query_def* query,
                  const msq_segments_def* def, msq_estimate* estimates, uint64_t estimate_count,
                  msq_job* job, Estimates&& ask) {
  const msq_segments_def known = read_def(def, segments_defaults(), "def");
  const Queried queried(model, sample, query, known.phase);
  const Segments segments = read_segments(known);
  if (estimate_count != segments.lengths.size())
    fail(Status::argument, "estimate_count is %llu; there are %zu lengths",
         static_cast<unsigned long long>(estimate_count), segments.lengths.size());
  require(estimates, "estimates");
  queried.require_reach(*std::max_element(segments.lengths.begin(), segments.lengths.end()));
  Job* work = job ? &object(job, "job") : nullptr;
  JobScope scope(work);
  const std::vector<Estimate> found = ask(queried, known, segments, work);
  for (size_t i = 0; i < found.size(); ++i) estimates[i] = given(found[i]);
  scope.done();
}

}  // namespace

msq_status msq_structure_calibrate(msq_context* context, const msq_structure* structure,
                                   const msq_points_def* sample, double target, double* parameters,
                                   double* fractions, uint64_t pair_count,
                                   msq_calibration_report* report, msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Structure& known = object(structure, "structure");
    const Ref<const Structure> keep(&known);
    const Ref<const Context> keep_owner(&owner);
    if (!known.has_onset())
      fail(Status::unsupported,
           "the structure's kind has no onset, so no curve of it is known; of structures made of "
           "others, unions have one whose members all have struts and an onset");
    const StratifiedPoints points = sample ? read_sample(sample) : usual_sample(known);
    if (!(target >= 0 && target <= 1))
      fail(Status::argument, "target is %g; it must be from 0 to 1", target);
    if (pair_count == 1 || pair_count > max_pairs)
      fail(Status::argument, "pair_count is %llu; it must be 0, or from 2 to %llu",
           static_cast<unsigned long long>(pair_count), static_cast<unsigned long long>(max_pairs));
    if (pair_count > 0) {
      require(parameters, "parameters");
      require(fractions, "fractions");
    } else if (parameters || fractions) {
      fail(Status::argument, "pair_count is 0; %s must be NULL then",
           parameters ? "parameters" : "fractions");
    }
    msq_calibration_report found{};
    if (report) {
      found.struct_size = report->struct_size;
      check_struct_size<msq_calibration_report>(report->struct_size, "report");
    }
    require_reach(known, owner.executor, points, 0);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    const Executor& executor = owner.executor_for(known.is_concurrent());
    const Calibration curve(known, points, executor, owner.budget, work);
    if (target > curve.max_fraction())
      fail(Status::limit, "target is %g; the greatest parameter, %g, has a fraction of %g", target,
           known.onset_limit(), curve.max_fraction());
    if (curve.max_fraction() == 0)
      fail(Status::limit, "no parameter up to %g makes any of %llu points solid",
           known.onset_limit(), static_cast<unsigned long long>(curve.count()));
    found.samples = curve.count();
    found.max_fraction = curve.max_fraction();
    found.parameter = curve.parameter(target);
    const Estimate at = curve.fraction(found.parameter);
    found.fraction = given(at);
    for (uint64_t i = 0; i < pair_count; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(pair_count - 1);
      fractions[i] = part * curve.max_fraction();
      parameters[i] = curve.parameter(fractions[i]);
    }
    if (report) write_report(report, found, "report");
    scope.done();
  });
}

msq_status msq_volume_fraction(const msq_model* model, const msq_points_def* sample,
                               const msq_query_def* query, int32_t phase, msq_estimate* estimate,
                               msq_job* job) {
  return guard([&] {
    const Queried queried(model, sample, query, phase);
    require(estimate, "estimate");
    queried.require_reach(0);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    *estimate = given(volume_fraction(queried.of(), work));
    scope.done();
  });
}

msq_status msq_segments_def_init(msq_segments_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, segments_defaults(), "msq_segments_def"); });
}

msq_status msq_two_point_correlation(const msq_model* model, const msq_points_def* sample,
                                     const msq_query_def* query, const msq_segments_def* def,
                                     msq_estimate* estimates, uint64_t estimate_count,
                                     msq_job* job) {
  return guard([&] {
    ask_segments(model, sample, query, def, estimates, estimate_count, job,
                 [](const Queried& queried, const msq_segments_def&, const Segments& segments,
                    Job* work) { return two_point_correlation(queried.of(), segments, work); });
  });
}

msq_status msq_lineal_path(const msq_model* model, const msq_points_def* sample,
                           const msq_query_def* query, const msq_segments_def* def,
                           msq_estimate* estimates, uint64_t estimate_count, msq_job* job) {
  return guard([&] {
    ask_segments(model, sample, query, def, estimates, estimate_count, job,
                 [](const Queried& queried, const msq_segments_def& known, const Segments& segments,
                    Job* work) {
                   const double step = read_step(known, segments, queried);
                   return lineal_path(queried.of(), segments, step, work);
                 });
  });
}

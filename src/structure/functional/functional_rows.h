// SPDX-License-Identifier: Apache-2.0
// Rows of samples that run along an axis of a functional structure's grid.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"
#include "structure/functional/row_angles.h"
#include "structure/functional/row_kernels.h"

namespace msq {

class FunctionalRows {
 public:
  FunctionalRows(const Functional& structure, const RowBlock& block);

  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  /// Samples [begin, end) of a row, within a cluster.
  struct Run {
    uint64_t begin, end;
    int cluster;
  };
  /// Bits [shift, shift + length) of a word are the results from number `from` on.
  struct Piece {
    uint32_t word, shift, length;
    size_t from;
  };
  /// Words of a group's rows, in order, with similar levels.
  struct Segment {
    std::vector<uint32_t> words;
    LevelBounds bounds;
    bool has_one_level = true;
    // Whether the level is linear along the rows; if so, by sample, from the first of a row on.
    bool has_ramp = false;
    double ramp = 0;
    uint64_t from = 0;
  };
  /// One of the structure's tapes: its tables, and the samples of a group that it decides.
  struct Work {
    explicit Work(const RowPlan& plan) : plan(plan), rows(plan.rows), samples(plan.samples) {}

    const RowPlan& plan;
    Batch rows, samples;
    std::vector<double> row_angles[2];  // of the group's rows, across them; inputs of `rows`
    bool has_tables = false;
    std::vector<std::vector<double>> tables;       // by position in the row
    std::vector<std::vector<float>> float_tables;  // if linear
    std::vector<const float*> float_pointers;      // to them, and to the numbers of the samples
    double slack = 0;

    std::vector<uint64_t> mask;     // samples to decide
    std::vector<Run> runs;          // the same as runs
    std::vector<Segment> segments;  // if linear: words with such samples
    // If not linear: the samples, stored consecutively.
    std::vector<Piece> pieces;
    std::vector<uint64_t> samples_at;
    std::vector<std::vector<double>> gathered;
  };

  void tabulate(Work& work) const;
  void keep_group(const RowGroup& group);
  bool find_alive(const RowGroup& group, uint64_t& first, uint64_t& last) const;
  /// Splits the samples of a group's rows: certainly inside, certainly outside, to be decided.
  void split(const RowGroup& group, uint64_t first, uint64_t last);
  void prepare(Work& work, const RowGroup& group);
  void add_segments(Work& work, const RowGroup& group, const uint32_t* words, size_t count) const;
  bool find_ramp(const Work& work, const Box3& box, uint64_t last, Segment& segment) const;
  void decide_linear(Work& work, const Segment& segment, const RowGroup& group, size_t row);
  void decide_samples(Work& work, const RowGroup& group, size_t row);
  bool decide(const Work& work, const Segment& segment, const LinearRow& row, const RowGroup& group,
              size_t row_number, uint64_t i) const;

  const Functional& structure_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  const Clusters::Grid* clusters_;  // null: none
  const RowAngles angles_;
  size_t words_;  // of a row that are computed; the others repeat them
  bool repeats_ = false;
  std::vector<int> numbers_[3];  // of their clusters
  std::vector<Run> columns_;     // a row's runs, by the cluster along it
  std::vector<std::unique_ptr<Work>> works_;
  std::vector<Work*> used_;  // in a group
  std::vector<uint64_t> certain_, result_, doubt_, held_;
  std::vector<double> levels_;
  std::vector<float> sample_numbers_;
  std::vector<uint32_t> mixed_words_;
  double constant_level_ = 0;
};

}  // namespace msq

// SPDX-License-Identifier: Apache-2.0
// Builds objects of every kind from the bytes of an input: the mutation of bytes becomes one of
// definitions.
#pragma once

#include "agree.h"

namespace msq::fuzz {

class Maker {
 public:
  Maker(Input& input, msq_context* context, const Job& job);

  /// NULL where msq refuses the definition.
  Owner<msq_field> field(double low, double high, int depth = 0);
  Owner<msq_shape> shape(int depth = 0);
  Owner<msq_structure> structure(int depth = 0);
  Owner<msq_material> material(int depth = 0);
  Owner<msq_model> model();
  /// Of one scale in a box about the origin of the grids.
  Owner<msq_model> model_of(const msq_structure* structure, double cells);
  msq_neighbourhood grid();

  /// Where to look at what was built, and what rays may lose of it.
  const Sight& sight() const { return sight_; }

 private:
  const char* formula();
  msq_param param(double low, double high);
  Owner<msq_shape> shape_of_kind(uint32_t kind, int depth);
  Owner<msq_structure> lattice();
  Owner<msq_structure> foam();
  Owner<msq_structure> functional();
  void sample(msq_warp_def& warp);
  Owner<msq_structure> beams();
  Owner<msq_structure> waves();
  Owner<msq_structure> plates();
  Owner<msq_structure> combined(int depth);
  Owner<msq_structure> host_structure();
  Owner<msq_structure> host_function();
  msq_image image(std::vector<double>* values, double low, double high);
  struct Period {
    msq_period_def def;
    double positions[5], sizes[5];
  };
  /// Makes a graded period, which must outlive what is returned.
  const msq_period_def* grade(Period& period);
  double coordinate(int axis, double cells) {
    return sight_.at[axis] + sight_.unit * input_.number(-cells, cells);
  }
  /// Something that rays know by steps: they may lose short parts of it.
  void is_rough() { sight_.part = 1.0 / 16; }

  Input& input_;
  msq_context* context_;
  const Job& job_;
  Sight sight_;
  std::vector<Owner<msq_field>> fields_;
};

}  // namespace msq::fuzz

// SPDX-License-Identifier: Apache-2.0
// A second reading of expressions, from the text of msq.h and not from the code of msq: it parses
// into a tree and evaluates the tree in long double, with a bound of what rounding may have done to
// the value.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace msq::fuzz {

/// A value that is known up to an error. Not known: rounding decides on which side of a jump it is.
struct Known {
  long double value = 0, error = 0;
  bool is_known = true;
};

class ReferenceExpression {
 public:
  using Parameters = std::vector<std::pair<std::string, double>>;
  ReferenceExpression(std::string_view text, const Parameters& parameters);
  ~ReferenceExpression();

  /// The text follows the grammar. Its limits may still be exceeded.
  bool is_valid() const { return root_ != nullptr; }
  /// Nested parentheses, signs and exponents; at least the number of operations.
  int depth() const { return depth_; }
  size_t operations() const { return operations_; }
  Known at(const double point[3]) const;

 private:
  struct Node;
  class Reader;
  static Known evaluate(const Node& node, const double point[3]);

  std::unique_ptr<Node> root_;
  int depth_ = 0;
  size_t operations_ = 0;
};

}  // namespace msq::fuzz

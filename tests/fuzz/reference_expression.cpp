// SPDX-License-Identifier: Apache-2.0
#include "reference_expression.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace msq::fuzz {

struct ReferenceExpression::Node {
  std::string what;  ///< an operator, the name of a function, "number" or "x", "y", "z"
  double number = 0;
  std::vector<std::unique_ptr<Node>> operands;
  bool is_constant = false;
};

class ReferenceExpression::Reader {
 public:
  Reader(std::string_view text, const Parameters& parameters)
      : text_(text), parameters_(parameters) {}

  std::unique_ptr<Node> all() {
    auto node = comparison();
    skip();
    return is_wrong_ || at_ != text_.size() ? nullptr : std::move(node);
  }
  int deepest() const { return deepest_; }
  size_t operations() const { return operations_; }

 private:
  using Made = std::unique_ptr<Node>;

  void skip() {
    while (at_ < text_.size() &&
           std::string_view(" \t\n\r").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  bool next_is(std::string_view token) {
    skip();
    return text_.substr(at_, token.size()) == token;
  }
  bool take(std::string_view token) {
    if (!next_is(token)) return false;
    at_ += token.size();
    return true;
  }
  Made fail() {
    is_wrong_ = true;
    return std::make_unique<Node>();
  }
  Made join(std::string what, Made a, Made b = nullptr, Made c = nullptr) {
    ++operations_;
    auto node = std::make_unique<Node>();
    node->what = std::move(what);
    node->is_constant = a->is_constant && (!b || b->is_constant) && (!c || c->is_constant);
    // A product of no factors is a constant, whatever the base is.
    constexpr double any_point[3] = {};
    if (node->what == "^" && b->is_constant && !node->is_constant) {
      const Known exponent = evaluate(*b, any_point);
      node->is_constant = exponent.is_known && exponent.value == 0 && exponent.error == 0;
    }
    node->operands.push_back(std::move(a));
    if (b) node->operands.push_back(std::move(b));
    if (c) node->operands.push_back(std::move(c));
    return node;
  }

  Made comparison() {
    Made left = sum();
    for (const char* const token : {"<=", ">=", "==", "!=", "<", ">"})
      if (!is_wrong_ && take(token)) {
        operations_ += 3;
        Made right = sum();
        return join(token, std::move(left), std::move(right));
      }
    return left;
  }
  Made sum() {
    Made left = product();
    while (!is_wrong_) {
      if (take("+"))
        left = join("+", std::move(left), product());
      else if (take("-"))
        left = join("-", std::move(left), product());
      else
        break;
    }
    return left;
  }
  Made product() {
    Made left = factor();
    while (!is_wrong_) {
      if (take("*"))
        left = join("*", std::move(left), factor());
      else if (take("/"))
        left = join("/", std::move(left), factor());
      else
        break;
    }
    return left;
  }
  Made factor() {
    if (is_wrong_) return fail();
    if (++depth_ > 400) return fail();  // far beyond the limit
    deepest_ = std::max(deepest_, depth_);
    Made made;
    if (take("-")) {
      made = join("negate", factor());
    } else if (take("+")) {
      made = factor();
    } else {
      made = atom();
      if (!is_wrong_ && take("^")) {
        operations_ += 40;
        made = join("^", std::move(made), factor());
      }
    }
    --depth_;
    return made;
  }

  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  Made atom() {
    skip();
    if (at_ >= text_.size()) return fail();
    if (take("(")) {
      Made inner = comparison();
      if (is_wrong_ || !take(")")) return fail();
      return inner;
    }
    const char c = text_[at_];
    if (is_digit(c) || c == '.') return number();
    if (!is_letter(c)) return fail();
    const size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    static const std::pair<const char*, int> functions[] = {
        {"pow", 2},   {"min", 2},  {"max", 2},   {"abs", 1},  {"sqrt", 1},  {"sin", 1},
        {"cos", 1},   {"exp", 1},  {"log", 1},   {"tanh", 1}, {"atan2", 2}, {"hypot", 2},
        {"floor", 1}, {"ceil", 1}, {"round", 1}, {"mod", 2},  {"select", 3}};
    for (const auto& [function, count] : functions) {
      if (name != function) continue;
      Made operands[3];
      if (!take("(")) return fail();
      for (int i = 0; i < count; ++i) {
        if (i > 0 && !take(",")) return fail();
        operands[i] = comparison();
        if (is_wrong_) return fail();
      }
      if (!take(")")) return fail();
      operations_ += name == "pow" ? 40 : 4;
      return join(name == "pow" ? "^" : name, std::move(operands[0]), std::move(operands[1]),
                  std::move(operands[2]));
    }
    auto node = std::make_unique<Node>();
    ++operations_;
    if (name == "x" || name == "y" || name == "z") {
      node->what = name;
      return node;
    }
    node->what = "number";
    node->is_constant = true;
    if (name == "pi") {
      node->number = 3.141592653589793;
      return node;
    }
    for (const auto& [parameter, value] : parameters_)
      if (parameter == name) {
        node->number = value;
        return node;
      }
    return fail();
  }

  Made number() {
    // Digits with or without a point, and an exponent if one is complete.
    size_t end = at_, digits = 0;
    while (end < text_.size() && is_digit(text_[end])) ++end, ++digits;
    if (end < text_.size() && text_[end] == '.') {
      ++end;
      while (end < text_.size() && is_digit(text_[end])) ++end, ++digits;
    }
    if (digits == 0) return fail();
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      size_t exponent = end + 1;
      if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-')) ++exponent;
      const size_t first = exponent;
      while (exponent < text_.size() && is_digit(text_[exponent])) ++exponent;
      if (exponent > first) end = exponent;
    }
    const std::string digits_text(text_.substr(at_, end - at_));
    at_ = end;
    auto node = std::make_unique<Node>();
    ++operations_;
    node->what = "number";
    node->is_constant = true;
    node->number = std::strtod(digits_text.c_str(), nullptr);
    const bool is_zero = digits_text.find_first_of("123456789") >= digits_text.find_first_of("eE");
    const bool is_out_of_range = !std::isfinite(node->number) || (node->number == 0 && !is_zero);
    return is_out_of_range ? fail() : std::move(node);
  }

  std::string_view text_;
  const Parameters& parameters_;
  size_t at_ = 0, operations_ = 0;
  int depth_ = 0, deepest_ = 0;
  bool is_wrong_ = false;
};

ReferenceExpression::ReferenceExpression(std::string_view text, const Parameters& parameters) {
  Reader reader(text, parameters);
  root_ = reader.all();
  depth_ = reader.deepest();
  operations_ = reader.operations();
}

ReferenceExpression::~ReferenceExpression() = default;

namespace {

constexpr long double unit_roundoff = 0x1p-53L;

/// Of a result that msq rounds to a double, by `units` of its last place.
Known rounded(long double value, long double error, long double units = 1) {
  if (std::isnan(value)) return {value, 0, true};
  // Near what no double holds, and near what only small ones hold, the error is not known.
  if (std::isinf(value) || std::abs(value) > 1e307L) return {value, 0, false};
  error += std::abs(value) * 2 * unit_roundoff * units + 1e-320L * units;
  if (!std::isfinite(error)) return {value, 0, false};
  return {value, error, true};
}

const Known not_known = {0, 0, false};
const Known not_a_number = {std::numeric_limits<long double>::quiet_NaN(), 0, true};

bool is_nan(const Known& k) {
  return k.is_known && std::isnan(k.value);
}

Known difference(const Known& a, const Known& b) {
  return {a.value - b.value, a.error + b.error, true};
}

Known whole_below(const Known& a) {
  const long double low = std::floor(a.value - a.error), high = std::floor(a.value + a.error);
  return low == high ? Known{low, 0, true} : not_known;
}

Known multiplied(const Known& a, const Known& b) {
  return rounded(a.value * b.value,
                 std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
}

Known divided(const Known& a, const Known& b) {
  if (std::abs(b.value) <= b.error) {
    // 0 / 0 is not a number, others are infinite: the error does not tell which.
    if (b.error == 0 && a.error == 0 && a.value == 0) return not_a_number;
    return not_known;
  }
  const long double least = std::abs(b.value) - b.error, quotient = a.value / b.value;
  return rounded(quotient, (a.error + std::abs(quotient) * b.error) / least);
}

Known logarithm(const Known& a) {
  if (a.value + a.error < 0) return not_a_number;
  if (a.value - a.error <= 0) return not_known;
  return rounded(std::log(a.value), a.error / (a.value - a.error), 4);
}

Known exponential(const Known& a) {
  if (a.value > 700 || a.value < -700 || a.error > 1) return not_known;
  const long double value = std::exp(a.value);
  return rounded(value, value * std::expm1(a.error), 4);
}

}  // namespace

Known ReferenceExpression::evaluate(const Node& node, const double point[3]) {
  const std::string& what = node.what;
  if (what == "number") return {node.number, 0, true};
  if (what == "x" || what == "y" || what == "z") return {point[what[0] - 'x'], 0, true};
  Known of[3];
  for (size_t i = 0; i < node.operands.size(); ++i) of[i] = evaluate(*node.operands[i], point);
  const Known &a = of[0], &b = of[1];
  if (what == "select") {
    // What it leaves out does not count.
    if (!a.is_known) return not_known;
    if (is_nan(a)) return not_a_number;
    if (std::abs(a.value - 0.5L) <= a.error && a.error > 0) return not_known;
    return a.value > 0.5L ? of[1] : of[2];
  }
  // A product of no factors, whatever the base is.
  if (what == "^" && node.operands[1]->is_constant && b.is_known && b.value == 0 && b.error == 0)
    return {1, 0, true};
  for (size_t i = 0; i < node.operands.size(); ++i)
    if (!of[i].is_known) return not_known;
  for (size_t i = 0; i < node.operands.size(); ++i)
    if (is_nan(of[i])) return not_a_number;
  if (what == "+") return rounded(a.value + b.value, a.error + b.error);
  if (what == "-") return rounded(a.value - b.value, a.error + b.error);
  if (what == "negate") return {-a.value, a.error, true};
  if (what == "*") return multiplied(a, b);
  if (what == "/") return divided(a, b);
  if (what == "<" || what == "<=" || what == ">" || what == ">=" || what == "==" || what == "!=") {
    const Known d = difference(a, b);
    if (std::abs(d.value) <= d.error && d.error > 0) return not_known;
    const bool holds = what == "<"    ? d.value < 0
                       : what == "<=" ? d.value <= 0
                       : what == ">"  ? d.value > 0
                       : what == ">=" ? d.value >= 0
                       : what == "==" ? d.value == 0
                                      : d.value != 0;
    return {holds ? 1.0L : 0.0L, 0, true};
  }
  if (what == "^") {
    const double n = static_cast<double>(b.value);
    if (node.operands[1]->is_constant) {
      // Folded, with the roundings of msq: which powers are products depends on the last bit.
      if (b.error > 0 && std::abs(b.value - std::round(b.value)) <= 2 * b.error) return not_known;
      if (std::floor(n) == n && std::abs(n) <= 65536) {
        if (n == 0) return {1, 0, true};
        const long double value = std::pow(a.value, static_cast<long double>(std::abs(n)));
        const long double relative =
            a.value == 0 ? 0 : std::abs(n) * (a.error / std::abs(a.value) + 2 * unit_roundoff);
        if (a.value == 0 && a.error > 0) return not_known;
        if (!(std::abs(value) < 1e300L) || (value != 0 && std::abs(value) < 1e-290L) ||
            relative > 0.01L)
          return not_known;
        const Known power = rounded(value, std::abs(value) * 1.1L * relative, 4);
        return n > 0 ? power : divided({1, 0, true}, power);
      }
    }
    // 0 times the logarithm of 0 and the like
    if (a.value <= a.error) return a.value < -a.error ? not_a_number : not_known;
    return exponential(multiplied(b, logarithm(a)));
  }
  if (what == "min" || what == "max") {
    const bool takes_a = what == "min" ? a.value <= b.value : a.value >= b.value;
    return {takes_a ? a.value : b.value, std::max(a.error, b.error), true};
  }
  if (what == "abs") return {std::abs(a.value), a.error, true};
  if (what == "sqrt") {
    if (a.value < -a.error) return not_a_number;
    if (a.value <= a.error) return a.error == 0 ? Known{0, 0, true} : not_known;
    const long double root = std::sqrt(a.value);
    return rounded(root, a.error / std::sqrt(a.value - a.error));
  }
  if (what == "sin" || what == "cos") {
    // The reduction of large angles is as good as the angle.
    if (std::abs(a.value) > 1e5L) return not_known;
    return rounded(what == "sin" ? std::sin(a.value) : std::cos(a.value),
                   a.error + 4 * unit_roundoff * (1 + std::abs(a.value)), 4);
  }
  if (what == "exp") return exponential(a);
  if (what == "log") return logarithm(a);
  if (what == "tanh") return rounded(std::tanh(a.value), a.error, 8);
  if (what == "hypot") {
    if (std::abs(a.value) > 1e150L || std::abs(b.value) > 1e150L) return not_known;
    if (std::abs(a.value) < 1e-150L && std::abs(b.value) < 1e-150L &&
        (a.value != 0 || b.value != 0))
      return not_known;
    return rounded(std::hypot(a.value, b.value), a.error + b.error, 4);
  }
  if (what == "atan2") {
    if (a.value == 0 && b.value == 0 && a.error == 0 && b.error == 0) return {0, 0, true};
    const long double size = std::hypot(a.value, b.value);
    if (std::abs(a.value) <= a.error && a.error + b.error > 0 && b.value < b.error)
      return not_known;
    if (size <= 4 * (a.error + b.error) || size > 1e150L || size < 1e-150L) return not_known;
    if (a.value == 0 && b.value < 0) return rounded(3.14159265358979323846L, 0, 8);
    return rounded(std::atan2(a.value, b.value), 2 * (a.error + b.error) / size, 8);
  }
  if (what == "floor") return whole_below(a);
  if (what == "ceil") {
    const Known whole = whole_below({-a.value, a.error, true});
    return {-whole.value, whole.error, whole.is_known};
  }
  if (what == "round") return whole_below(rounded(a.value + 0.5L, a.error));
  if (what == "mod") {
    const Known quotient = divided(a, b);
    if (!quotient.is_known || is_nan(quotient)) return quotient;
    const Known whole = whole_below(quotient);
    if (!whole.is_known) return not_known;
    const Known times = multiplied(b, whole);
    return times.is_known ? rounded(a.value - times.value, a.error + times.error) : not_known;
  }
  return not_known;
}

Known ReferenceExpression::at(const double point[3]) const {
  return evaluate(*root_, point);
}

}  // namespace msq::fuzz

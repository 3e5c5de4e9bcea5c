// SPDX-License-Identifier: Apache-2.0
// A parser by recursive descent: each rule of the grammar is a function.
//
//   whole   = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]
//   sum     = product { ("+" | "-") product }
//   product = signed { ("*" | "/") signed }
//   signed  = ("-" | "+") signed | power
//   power   = primary [ "^" signed ]
//   primary = number | name | function "(" whole { "," whole } ")" | "(" whole ")"
#include "expression/parser.h"

#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "base/status.h"

namespace msq {

namespace {

struct Function {
  std::string_view name;
  Op op;
  int operands;
};
/// Those with Op::constant are made of several operations.
constexpr Function functions[] = {
    {"pow", Op::constant, 2},     {"min", Op::minimum, 2},
    {"max", Op::maximum, 2},      {"abs", Op::absolute, 1},
    {"sqrt", Op::square_root, 1}, {"sin", Op::sine, 1},
    {"cos", Op::cosine, 1},       {"exp", Op::exponential, 1},
    {"log", Op::logarithm, 1},    {"tanh", Op::tangent_hyperbolic, 1},
    {"atan2", Op::arctangent, 2}, {"hypot", Op::hypotenuse, 2},
    {"floor", Op::floor, 1},      {"ceil", Op::constant, 1},
    {"round", Op::constant, 1},   {"mod", Op::constant, 2},
    {"select", Op::constant, 3},
};

constexpr double max_whole_exponent = 65536;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_name(std::string_view text) {
  if (text.empty() || !begins_name(text[0])) return false;
  for (char c : text)
    if (!begins_name(c) && !is_digit(c)) return false;
  return true;
}
const Function* function_of(std::string_view name) {
  for (const Function& f : functions)
    if (f.name == name) return &f;
  return nullptr;
}
bool is_taken(std::string_view name) {
  return name == "x" || name == "y" || name == "z" || name == "pi" || function_of(name);
}

class Parser {
 public:
  Parser(std::string_view text, const std::vector<NamedValue>& parameters)
      : text_(text), parameters_(parameters) {}

  Tape parse() {
    const uint32_t root = whole();
    peek();
    if (at_ < text_.size())
      refuse(at_, "expected an operator or the end, found %s", found().c_str());
    return builder_.finish(root);
  }

 private:
  [[noreturn]] void refuse(size_t at, const char* format, ...) const MSQ_PRINTF_FORMAT(3, 4) {
    char reason[200];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    fail(Status::argument, "expression, character %zu: %s", at + 1, reason);
  }
  /// The text at the current position, for messages.
  std::string found() const {
    if (at_ >= text_.size()) return "the end";
    const char c = text_[at_];
    if (c > ' ' && c < 127) return std::string("'") + c + "'";
    char name[16];
    std::snprintf(name, sizeof name, "byte 0x%02x", static_cast<unsigned char>(c));
    return name;
  }

  /// The next character that is not a space; 0 at the end.
  char peek() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
    return at_ < text_.size() ? text_[at_] : 0;
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) refuse(at_, "expected '%c', found %s", c, found().c_str());
  }

  uint32_t apply(Op op, uint32_t a, uint32_t b = 0) {
    const uint32_t node = builder_.apply(op, a, b);
    if (builder_.size() > max_tape_nodes)
      fail(Status::limit, "expression, character %zu: more than %u operations", at_ + 1,
           max_tape_nodes);
    return node;
  }

  /// 1 less a number that is 0 or 1.
  uint32_t unless(uint32_t node) { return apply(Op::subtract, builder_.constant(1), node); }

  /// Comparisons do not associate: a second one is refused.
  uint32_t whole() {
    const uint32_t left = sum();
    const char c = peek();
    const bool has_equal = c && at_ + 1 < text_.size() && text_[at_ + 1] == '=';
    if (c != '<' && c != '>' && !(has_equal && (c == '=' || c == '!'))) return left;
    at_ += has_equal ? 2 : 1;
    const uint32_t right = sum();
    if (c == '<')
      return has_equal ? unless(apply(Op::less, right, left)) : apply(Op::less, left, right);
    if (c == '>')
      return has_equal ? unless(apply(Op::less, left, right)) : apply(Op::less, right, left);
    const uint32_t differ =
        apply(Op::add, apply(Op::less, left, right), apply(Op::less, right, left));
    return c == '!' ? differ : unless(differ);
  }

  uint32_t sum() {
    uint32_t left = product();
    for (;;) {
      if (take('+'))
        left = apply(Op::add, left, product());
      else if (take('-'))
        left = apply(Op::subtract, left, product());
      else
        return left;
    }
  }

  uint32_t product() {
    uint32_t left = with_sign();
    for (;;) {
      if (take('*'))
        left = apply(Op::multiply, left, with_sign());
      else if (take('/'))
        left = apply(Op::divide, left, with_sign());
      else
        return left;
    }
  }

  /// All nesting passes through this function.
  uint32_t with_sign() {
    if (++depth_ > max_expression_depth)
      fail(Status::limit, "expression, character %zu: nested deeper than %d", at_ + 1,
           max_expression_depth);
    uint32_t node;
    if (take('-'))
      node = apply(Op::negate, with_sign());
    else if (take('+'))
      node = with_sign();
    else
      node = power();
    --depth_;
    return node;
  }

  uint32_t power() {
    const uint32_t base = primary();
    return take('^') ? power_of(base, with_sign()) : base;
  }

  /// Integer constant exponents are products, by squaring; others are exp(b log(a)).
  uint32_t power_of(uint32_t base, uint32_t exponent) {
    const Node e = builder_[exponent];
    const double n = std::abs(e.value);
    if (e.op != Op::constant || std::floor(n) != n || n > max_whole_exponent)
      return apply(Op::exponential, apply(Op::multiply, exponent, apply(Op::logarithm, base)));
    uint32_t result = builder_.constant(1), square = base;
    bool has_result = false;
    for (uint32_t rest = static_cast<uint32_t>(n); rest; rest >>= 1) {
      if (rest & 1) result = has_result ? apply(Op::multiply, result, square) : square;
      has_result = has_result || (rest & 1);
      if (rest > 1) square = apply(Op::multiply, square, square);
    }
    return e.value < 0 ? apply(Op::divide, builder_.constant(1), result) : result;
  }

  uint32_t primary() {
    const char c = peek();
    if (take('(')) {
      const uint32_t node = whole();
      expect(')');
      return node;
    }
    if (is_digit(c) || c == '.') return number();
    if (begins_name(c)) return name();
    refuse(at_, "expected a number, a name or '(', found %s", found().c_str());
  }

  uint32_t number() {
    double value;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range) refuse(at_, "the number is out of range");
    if (error != std::errc()) refuse(at_, "malformed number");
    at_ += static_cast<size_t>(end - begin);
    return builder_.constant(value);
  }

  uint32_t name() {
    const size_t begin = at_;
    while (at_ < text_.size() && (begins_name(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (const Function* f = function_of(name)) return call(*f);
    if (name == "pi") return builder_.constant(two_pi / 2);
    for (int axis = 0; axis < 3; ++axis)
      if (name.size() == 1 && name[0] == "xyz"[axis]) return builder_.coordinate(axis);
    for (const NamedValue& p : parameters_)
      if (p.name == name) return builder_.constant(p.value);
    refuse(begin, "'%.*s' is neither x, y, z, pi, a function nor a parameter",
           static_cast<int>(std::min<size_t>(name.size(), 40)), name.data());
  }

  uint32_t call(const Function& f) {
    expect('(');
    uint32_t of[3] = {whole(), 0, 0};
    for (int i = 1; i < f.operands; ++i) {
      expect(',');
      of[i] = whole();
    }
    expect(')');
    if (f.op != Op::constant) return apply(f.op, of[0], of[1]);
    if (f.name == "pow") return power_of(of[0], of[1]);
    if (f.name == "ceil") return apply(Op::negate, apply(Op::floor, apply(Op::negate, of[0])));
    if (f.name == "round") return apply(Op::floor, apply(Op::add, of[0], builder_.constant(0.5)));
    if (f.name == "mod") {
      const uint32_t times = apply(Op::floor, apply(Op::divide, of[0], of[1]));
      return apply(Op::subtract, of[0], apply(Op::multiply, of[1], times));
    }
    return apply(Op::add, apply(Op::keep, of[0], of[1]), apply(Op::drop, of[0], of[2]));
  }

  std::string_view text_;
  const std::vector<NamedValue>& parameters_;
  size_t at_ = 0;
  int depth_ = 0;
  TapeBuilder builder_;
};

}  // namespace

Tape parse_expression(std::string_view text, const std::vector<NamedValue>& parameters) {
  if (text.size() > max_expression_bytes)
    fail(Status::limit, "expression has more than %zu bytes", max_expression_bytes);
  for (size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = parameters[i].name;
    if (!is_name(name))
      fail(Status::argument, "the name of parameter %zu, '%.40s', is no name", i, name.c_str());
    if (is_taken(name))
      fail(Status::argument, "the name of parameter %zu, '%s', has a meaning of its own", i,
           name.c_str());
    for (size_t other = 0; other < i; ++other)
      if (parameters[other].name == name)
        fail(Status::argument, "parameters %zu and %zu are both named '%.40s'", other, i,
             name.c_str());
  }
  return Parser(text, parameters).parse();
}

}  // namespace msq

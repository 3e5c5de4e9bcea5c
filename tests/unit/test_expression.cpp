// SPDX-License-Identifier: Apache-2.0
// Expressions: what texts mean, which are refused and where; enclosures hold all samples, also
// through shortened tapes, and say where values may be no numbers; vectors give the bits of the
// scalar evaluator.
#include <cstring>
#include <limits>

#include "base/status.h"
#include "expression/batch.h"
#include "expression/enclosure.h"
#include "expression/parser.h"
#include "random.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

const std::vector<NamedValue> parameters = {{"a", 2.5}, {"b_2", -1}};

double value(const char* text, Vec3 p = {1, 2, 3}) {
  return evaluate(parse_expression(text, parameters), p);
}

void texts_mean_what_they_say(void**) {
  const auto is = [](const char* text, double wanted) {
    const double got = value(text);
    if (std::abs(got - wanted) > 1e-14 * (1 + std::abs(wanted)))
      fail_msg("%s is %.17g, not %.17g", text, got, wanted);
  };
  is("1+2*3", 7);
  is(" ( 1 + 2 )\t*3\n", 9);
  is("8-4-2", 2);
  is("16/4/2", 2);
  is("2^3^2", 512);
  is("-2^2", -4);
  is("2^-2", 0.25);
  is("(-2)^3", -8);
  is("--2", 2);
  is("2*-3", -6);
  is("+x", 1);
  is("x+10*y+100*z", 321);
  is("1.5e1+.5+2.", 17.5);
  is("pi", 3.14159265358979323846);
  is("a*b_2", -2.5);
  is("min(x,y)+10*max(y,z)", 31);
  is("abs(-z)", 3);
  is("sqrt(x+z)", 2);
  is("sin(x)+2*cos(y)", std::sin(1) + 2 * std::cos(2));
  is("exp(x)+log(z)", std::exp(1) + std::log(3));
  is("pow(y,3)", 8);
  is("y^0.5", std::sqrt(2));
  is("y^z", 8);
  is("x^0", 1);
  is("y^10", 1024);
  is("y^-1", 0.5);
  is("3^(1+1)", 9);
  is("mod(7.5,2)", 1.5);
  is("mod(-0.5,z)", 2.5);
  is("mod(7,-3)", -2);
  is("floor(-0.5)", -1);
  is("ceil(y+0.25)", 3);
  is("round(2.5)+10*round(-2.5)", -17);
  is("atan2(1,-1)", 3 * two_pi / 8);
  is("atan2(-1,0)", -two_pi / 4);
  is("atan2(0,-1)", two_pi / 2);
  is("atan2(-0*x,-1)", two_pi / 2);
  is("atan2(0,0)", 0);
  is("hypot(3,-4)", 5);
  is("tanh(-0.5)", std::tanh(-0.5));
  is("tanh(1e9)", 1);
  is("(x<y)+10*(y<=y)+100*(y>=z)+1000*(z>y)", 1011);
  is("(x==1)+10*(x!=1)+100*(y!=1)", 101);
  is("1+1<3", 1);
  is("select(x<y,y+5,z)", 7);
  is("select(0.5,y,z)", 3);
  is("select(x>y,sqrt(-1),z)", 3);
  is("select(x<y,z,1/0)", 3);
  is("min(x<y,y>z)", 0);
  assert_true(std::isnan(value("select(0/0,1,2)")));
  assert_true(std::isnan(value("select(1,0/0,2)")));
  assert_true(std::signbit(value("select(1,-0*x,1)")) && value("1/select(0,1,-0*x)") < 0);
  assert_true(std::isnan(value("sqrt(-1)")));
  assert_true(std::isnan(value("(-y)^0.5")));
  assert_true(std::isinf(value("1/0")));
}

void equal_parts_are_one(void**) {
  const auto size = [](const char* text) { return parse_expression(text, {}).nodes.size(); };
  assert_int_equal(size("sin(x)*sin(x)"), 3);
  assert_int_equal(size("(x+y)*(y+x)"), 4);
  assert_int_equal(size("x-x*0.5-0.5*x"), 5);
  assert_int_equal(size("2*3+pi"), 1);
  assert_int_equal(size("min(x,y)*max(z,x)-max(x,z)*min(y,x)"), 3 + 2 + 1 + 1);
  assert_int_equal(size(preset_expressions[0]), 3 + 6 + 3 + 2);
}

void bad_texts_are_refused_by_position(void**) {
  struct Case {
    std::string text;
    const char *place, *reason;
  };
  const Case cases[] = {
      {"", "character 1", "the end"},
      {"   ", "character 4", "the end"},
      {"1+", "character 3", "the end"},
      {"1 + * 2", "character 5", "'*'"},
      {"(1+2", "character 5", "expected ')'"},
      {"1+2)", "character 4", "')'"},
      {"sin x", "character 5", "expected '('"},
      {"min(1)", "character 6", "expected ','"},
      {"sin(1,2)", "character 6", "expected ')'"},
      {"2*foo", "character 3", "'foo'"},
      {"x y", "character 3", "'y'"},
      {"2x", "character 2", "'x'"},
      {"1..2", "character 3", "'.'"},
      {".", "character 1", "malformed number"},
      {"1e999", "character 1", "out of range"},
      {"x # y", "character 3", "'#'"},
      {"x \xc3\xa4", "character 3", "byte 0xc3"},
      {"0x10", "character 2", "'x'"},
      {"inf", "character 1", "'inf'"},
      {"x<y<z", "character 4", "'<'"},
      {"x=y", "character 2", "'='"},
      {"x!", "character 2", "'!'"},
      {"x<", "character 3", "the end"},
      {"select(1,2)", "character 11", "expected ','"},
      {"round()", "character 7", "')'"},
      {std::string("x\0y", 3), "character 2", "byte 0x00"},
  };
  for (const Case& c : cases) try {
      parse_expression(c.text, parameters);
      fail_msg("'%s' is accepted", c.text.c_str());
    } catch (const Error& error) {
      const std::string message = error.what();
      if (error.status != Status::argument || message.find(c.place) == std::string::npos ||
          message.find(c.reason) == std::string::npos)
        fail_msg("'%s': %s", c.text.c_str(), error.what());
    }
}

void limits_hold(void**) {
  const auto status_of = [](const std::string& text) {
    try {
      parse_expression(text, {});
      return Status::ok;
    } catch (const Error& error) {
      return error.status;
    }
  };
  const auto times = [](const std::string& part, size_t count) {
    std::string all;
    while (count-- > 0) all += part;
    return all;
  };
  for (const char* part : {"(", "-", "sin(", "2^", "min(1,", "+(-"})
    assert_true(status_of(times(part, 4000 / std::strlen(part))) == Status::limit);
  for (size_t depth : {99, 100}) {
    std::string nested = times("(", depth);
    nested += 'x';
    nested += times(")", depth);
    assert_true(status_of(nested) == (depth < 100 ? Status::ok : Status::limit));
  }
  std::string padded = "x";
  padded.resize(65536, ' ');
  assert_true(status_of(padded) == Status::ok);
  padded += ' ';
  assert_true(status_of(padded) == Status::limit);
  std::string many = "x";  // sums of different products
  for (int i = 2; i < 4500; ++i) many.append("+x*").append(std::to_string(i));
  assert_true(many.size() < max_expression_bytes && status_of(many) == Status::limit);
}

void parameters_need_names(void**) {
  const auto refused = [](std::vector<NamedValue> names, const char* reason) {
    try {
      parse_expression("x", names);
      fail_msg("accepted: %s", reason);
    } catch (const Error& error) {
      assert_true(error.status == Status::argument);
      assert_non_null(std::strstr(error.what(), reason));
    }
  };
  refused({{"ok", 1}, {"", 1}}, "parameter 1");
  refused({{"2a", 1}}, "'2a'");
  refused({{"a b", 1}}, "'a b'");
  for (const char* taken : {"x", "y", "z", "pi", "sin", "pow", "min", "select", "round"})
    refused({{taken, 1}}, "meaning of its own");
  refused({{"c", 1}, {"d", 2}, {"c", 3}}, "parameters 0 and 2");
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double odd_values[] = {no_number, -infinity, -2,   -0.0,   0.0,      5e-324, 1.5,
                                 2,         1e300,     1e16, -1e308, infinity, 1e-200};

/// By the words of IEEE 754-2019, not by the evaluator's means.
double least(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return no_number;
  if (a == 0 && b == 0) return std::signbit(a) ? a : b;
  return b < a ? b : a;
}

bool same_bits(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::memcmp(&a, &b, sizeof a) == 0;
}

void minima_are_of_numbers(void**) {
  for (const double a : odd_values)
    for (const double b : odd_values) {
      const double low = apply(Op::minimum, a, b), high = apply(Op::maximum, a, b);
      if (!same_bits(low, least(a, b)) || !same_bits(high, -least(-a, -b)))
        fail_msg("min(%g, %g) is %g, max %g", a, b, low, high);
    }
  assert_true(std::isnan(value("min(0/0,1)")) && std::isnan(value("min(1,0/0)")));
  assert_true(std::isnan(value("max(0/0,x)")) && std::isnan(value("max(x,0/0)")));
  assert_true(value("1/min(0,-0*x)") == -infinity && value("1/min(-0*x,0)") == -infinity);
}

/// No operation makes a number of what is none.
void operations_keep_what_is_no_number(void**) {
  for (int i = static_cast<int>(Op::add); i <= static_cast<int>(last_op); ++i) {
    const Op op = static_cast<Op>(i);
    for (const double other : odd_values) {
      assert_true(std::isnan(apply(op, no_number, other)));
      const bool is_left_out = (op == Op::keep && other <= 0.5) || (op == Op::drop && other > 0.5);
      if (has_two_operands(op) && !is_left_out)
        assert_true(std::isnan(apply(op, other, no_number)));
    }
  }
}

/// In lanes, of doubles and of floats.
template <class T>
void check_odd_values_in_vectors() {
  constexpr size_t count = std::size(odd_values) * std::size(odd_values);
  std::vector<T> a, b;
  for (const double p : odd_values)
    for (const double q : odd_values) {
      a.push_back(static_cast<T>(p));
      b.push_back(static_cast<T>(q));
    }
  static_assert(count <= batch_points);
  a.resize(batch_points + batch_padding);
  b.resize(batch_points + batch_padding);
  for (int i = static_cast<int>(Op::add); i <= static_cast<int>(last_op); ++i) {
    const Op op = static_cast<Op>(i);
    if (sizeof(T) < sizeof(double) && op != Op::minimum && op != Op::maximum) continue;
    Tape tape;
    tape.nodes = {{Op::x}, {Op::y}, {op, 0, has_two_operands(op) ? 1u : 0u}};
    const Program program = compile(tape);
    BatchOf<T> batch(program);
    batch.set_input(0, {a.data(), false});
    batch.set_input(1, {b.data(), false});
    batch.run(count);
    for (size_t n = 0; n < count; ++n) {
      const double got = batch.output(0)[n], wanted = apply(op, a[n], b[n]);
      if (!same_bits(got, wanted))
        fail_msg("operation %d of %g and %g is %g in vectors, not %g", i, double(a[n]),
                 double(b[n]), got, wanted);
    }
  }
}

void vectors_treat_odd_values_alike(void**) {
  check_odd_values_in_vectors<double>();
  check_odd_values_in_vectors<float>();
}

/// Adds a random text of everything there is; `partial`: also of what is no number in places.
void add_random_text(std::string& text, Random& random, int depth, bool partial = false) {
  static const char* const leaves[] = {"x", "y", "z", "1", "0.3", "pi", "x", "y", "z"};
  if (depth == 0 || random.below(8) == 0) {
    text += leaves[random.below(std::size(leaves))];
    return;
  }
  static const char* const calls[][2] = {
      {"sin(", ")"},        {"cos(", ")"},   {"abs(", ")"},  {"sqrt(abs(", "))"}, {"exp(0.1*", ")"},
      {"log(1+abs(", "))"}, {"-(", ")"},     {"(", ")^2"},   {"(", ")^3"},        {"1/(2+", ")"},
      {"floor(", ")"},      {"round(", ")"}, {"tanh(", ")"}, {"mod(", ",1.5)"}};
  static const char* const partial_calls[][2] = {{"sqrt(", ")"}, {"log(", ")"},
                                                 {"1/(", ")"},   {"exp(99*", ")"},
                                                 {"(", ")^0.5"}, {"sin(1/(", "))"}};
  if (partial && random.below(4) == 0) {
    const auto& [before, after] = partial_calls[random.below(std::size(partial_calls))];
    text += before;
    add_random_text(text, random, depth - 1, partial);
    text += after;
    return;
  }
  static const char* const pairs[][3] = {{"atan2(", ",", ")"},
                                         {"hypot(", ",", ")"},
                                         {"((", ")<(", "))"},
                                         {"select(", ",x,", ")"},
                                         {"select(y<", ",", ",z*x)"},
                                         {"min(", ",", ")"},
                                         {"max(", ",", ")"},
                                         {"(", ")+(", ")"},
                                         {"(", ")-(", ")"},
                                         {"(", ")*(", ")"},
                                         {"(", ")/(", ")"}};
  if (random.below(2)) {
    const auto& [before, after] = calls[random.below(std::size(calls))];
    text += before;
    add_random_text(text, random, depth - 1, partial);
    text += after;
    return;
  }
  const auto& [before, between, after] = pairs[random.below(std::size(pairs))];
  text += before;
  add_random_text(text, random, depth - 1, partial);
  text += between;
  add_random_text(text, random, depth - 1, partial);
  text += after;
}

std::vector<std::string> presets_and_random_texts(Random& random, size_t count, int depth) {
  std::vector<std::string> texts(preset_expressions, std::end(preset_expressions));
  while (count-- > 0) {
    texts.emplace_back();
    add_random_text(texts.back(), random, depth);
  }
  return texts;
}

void enclosures_hold_all_samples(void**) {
  Random random(3);
  const std::vector<std::string> texts = presets_and_random_texts(random, test_count(2000), 5);
  size_t bounded = 0, shorter = 0, boxes = 0;
  std::vector<Enclosure> nodes;
  for (const std::string& text : texts) {
    const Tape tape = parse_expression(text, {});
    for (int round = 0; round < 6; ++round) {
      const double size = two_pi / static_cast<double>(1 << (2 * (round % 3)));
      Interval box[3];
      for (Interval& side : box) {
        side.low = random.between(0, two_pi - size);
        side.high = side.low + size;
      }
      enclose(tape, box, nodes);
      const Enclosure root = nodes.back();
      const Tape less = shortened(tape, nodes);
      ++boxes;
      bounded += is_bounded(root);
      shorter += less.nodes.size() < tape.nodes.size();
      for (int i = 0; i < 40; ++i) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis)
          p[axis] = i < 8 ? (i >> axis & 1 ? box[axis].high : box[axis].low)
                          : random.between(box[axis].low, box[axis].high);
        const double v = evaluate(tape, p);
        if (is_bounded(root) && !(v >= root.low && v <= root.high))
          fail_msg("%s at (%.17g, %.17g, %.17g): %.17g is not from %.17g to %.17g", text.c_str(),
                   p.x, p.y, p.z, v, root.low, root.high);
        if (!same_bits(evaluate(less, p), v))
          fail_msg("%s shortened: another value at (%.17g, %.17g, %.17g)", text.c_str(), p.x, p.y,
                   p.z);
      }
    }
  }
  print_message("%zu boxes, %zu bounded, %zu shortened\n", boxes, bounded, shorter);
  assert_true(bounded > boxes / 2 && shorter > boxes / 20);
}

/// Where an enclosure is bounded values are numbers, and shortened tapes keep what is none.
void enclosures_tell_what_may_be_no_number(void**) {
  Random random(13);
  size_t bounded = 0, partly = 0;
  std::vector<Enclosure> nodes;
  // One in 11 is partly no number: of a thousand enough to tell their share.
  const size_t count = std::max<size_t>(test_count(6000), 1000);
  for (size_t n = 0; n < count; ++n) {
    std::string text;
    add_random_text(text, random, 4, true);
    const Tape tape = parse_expression(text, {});
    Interval box[3];
    const double size = two_pi / static_cast<double>(1 << (2 * (n % 3)));
    for (Interval& side : box) {
      side.low = random.between(0, two_pi - size);
      side.high = side.low + size;
    }
    enclose(tape, box, nodes);
    const Tape less = shortened(tape, nodes);
    size_t numbers = 0;
    constexpr size_t samples = 60;
    for (size_t i = 0; i < samples; ++i) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = i < 8 ? (i >> axis & 1 ? box[axis].high : box[axis].low)
                        : random.between(box[axis].low, box[axis].high);
      const double v = evaluate(tape, p);
      numbers += !std::isnan(v);
      if (is_bounded(nodes.back()) && !(v >= nodes.back().low && v <= nodes.back().high))
        fail_msg("%s at (%.17g, %.17g, %.17g): %.17g is not from %.17g to %.17g", text.c_str(), p.x,
                 p.y, p.z, v, nodes.back().low, nodes.back().high);
      if (!same_bits(evaluate(less, p), v))
        fail_msg("%s shortened: another value at (%.17g, %.17g, %.17g)", text.c_str(), p.x, p.y,
                 p.z);
    }
    bounded += is_bounded(nodes.back());
    partly += numbers > 0 && numbers < samples;
  }
  print_message("%zu bounded, %zu partly no numbers\n", bounded, partly);
  assert_true(bounded > count / 5 && partly > count / 20);
}

void programs_give_the_scalar_bits(void**) {
  Random random(4);
  std::vector<std::string> texts = presets_and_random_texts(random, test_count(2000), 6);
  for (size_t n = 0; n < test_count(2000); ++n) {
    texts.emplace_back();
    add_random_text(texts.back(), random, 5, true);
  }
  double angles[3][batch_points + batch_padding] = {};
  for (const std::string& text : texts) {
    const Tape tape = parse_expression(text, {});
    const Program program = compile(tape);
    Batch batch(program);
    for (size_t axis = 0; axis < 3; ++axis) {
      for (size_t i = 0; i < batch_points; ++i) angles[axis][i] = random.between(0, two_pi);
      batch.set_input(axis, {angles[axis], false});
    }
    batch.run(50);
    const Values got = batch.output(0);
    for (size_t i = 0; i < 50; ++i)
      if (!same_bits(got.is_uniform ? *got.data : got.data[i],
                     evaluate(tape, {angles[0][i], angles[1][i], angles[2][i]})))
        fail_msg("%s: other bits in vectors", text.c_str());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(texts_mean_what_they_say),
      cmocka_unit_test(equal_parts_are_one),
      cmocka_unit_test(bad_texts_are_refused_by_position),
      cmocka_unit_test(limits_hold),
      cmocka_unit_test(parameters_need_names),
      cmocka_unit_test(minima_are_of_numbers),
      cmocka_unit_test(operations_keep_what_is_no_number),
      cmocka_unit_test(vectors_treat_odd_values_alike),
      cmocka_unit_test(enclosures_hold_all_samples),
      cmocka_unit_test(enclosures_tell_what_may_be_no_number),
      cmocka_unit_test(programs_give_the_scalar_bits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

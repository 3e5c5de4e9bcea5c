// SPDX-License-Identifier: Apache-2.0
// OBJ and ASCII STL: coordinates to the last bit, what may be written in how many ways, errors that
// name the line, files with parts changed at random.
#include <bit>
#include <cfloat>
#include <random>

#include "mesh_file_fixtures.h"

namespace {

using namespace mesh_file_fixtures;

std::string obj_of(const std::vector<std::string>& numbers) {
  std::string file;
  for (size_t i = 0; i + 3 <= numbers.size(); i += 3)
    file += "v " + numbers[i] + " " + numbers[i + 1] + " " + numbers[i + 2] + "\n";
  return file + "f 1 2 3\n";
}

std::string stl_of(const std::vector<std::string>& numbers) {
  std::string file = "solid numbers\n";
  for (size_t i = 0; i + 9 <= numbers.size(); i += 9) {
    file += "facet normal 0 0 1\nouter loop\n";
    for (size_t k = i; k < i + 9; k += 3)
      file += "vertex " + numbers[k] + " " + numbers[k + 1] + " " + numbers[k + 2] + "\n";
    file += "endloop\nendfacet\n";
  }
  return file + "endsolid numbers\n";
}

/// Reads the numbers, nine times as many as some whole number, as coordinates in both formats.
void assert_read_as_by_strtod(const std::vector<std::string>& numbers) {
  for (const TriangleSoup& soup : {read(obj_of(numbers), options_for(MeshFormat::obj)),
                                   read(stl_of(numbers), options_for(MeshFormat::stl))}) {
    assert_int_equal(3 * soup.vertices.size(), numbers.size());
    for (size_t i = 0; i < numbers.size(); ++i) {
      const double value = soup.vertices[i / 3][static_cast<int>(i % 3)];
      const double expected = strtod(numbers[i].c_str(), nullptr);
      if (std::bit_cast<uint64_t>(value) != std::bit_cast<uint64_t>(expected))
        fail_msg("%s became %.17g, not %.17g", numbers[i].c_str(), value, expected);
    }
  }
}

void coordinates_keep_every_bit(void**) {
  std::mt19937_64 random(20250307);
  std::vector<std::string> numbers;
  // All exponents, subnormal numbers among them.
  while (numbers.size() < 90000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) numbers.push_back(text("%.17g", value));
  }
  // Those of parts.
  while (numbers.size() < 180000)
    numbers.push_back(text(
        "%.17g", std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 20) - 70)));
  assert_read_as_by_strtod(numbers);
  for (size_t i = 90000; i < numbers.size(); i += 1000)
    assert_int_equal(text("%.17g", strtod(numbers[i].c_str(), nullptr)) == numbers[i], 1);

  // Floats in nine digits are the same floats again.
  numbers.clear();
  std::vector<float> floats;
  while (floats.size() < 90000) {
    const float value = std::bit_cast<float>(static_cast<uint32_t>(random()));
    if (!std::isfinite(value)) continue;
    floats.push_back(value);
    numbers.push_back(text("%.9g", static_cast<double>(value)));
  }
  assert_read_as_by_strtod(numbers);
  const TriangleSoup soup = read(obj_of(numbers), options_for(MeshFormat::obj));
  for (size_t i = 0; i < floats.size(); ++i)
    assert_true(static_cast<float>(soup.vertices[i / 3][static_cast<int>(i % 3)]) == floats[i]);
}

void ties_go_to_even(void**) {
  // Halfway between two doubles, in all its digits, and a little beside that.
  static_assert(LDBL_MANT_DIG >= 64, "needs a longer type for the oracle's input");
  std::mt19937_64 random(7);
  std::vector<std::string> numbers;
  while (numbers.size() < 9000) {
    const double below = std::ldexp(static_cast<double>(random() >> 11 | uint64_t{1} << 52),
                                    static_cast<int>(random() % 60) - 80);
    const double above = std::nextafter(below, INFINITY);
    const long double middle = (static_cast<long double>(below) + above) / 2;
    const std::string digits = text("%.200Lf", middle);
    const size_t last = digits.find_last_not_of('0');
    numbers.push_back(digits);
    numbers.push_back(digits.substr(0, last + 1) + "0000000000000001");
    numbers.push_back(text("-%.*s%c999999999", static_cast<int>(last), digits.c_str(),
                           static_cast<char>(digits[last] - 1)));
  }
  assert_read_as_by_strtod(numbers);
}

void numbers_of_every_kind_are_read(void**) {
  const std::string zeros(400, '0');
  assert_read_as_by_strtod({"300.123456789", "-0", "+.5", "1.", "1E5", "1e+05", "-1.5e-05", "007",
                            "00.10", "1e-400", "-1e-400", "2.4703282292062327e-324",
                            "1e-99999999999999999999", "0." + zeros + "1", "-0." + zeros + "1e+20",
                            "0e99999999999999999999", "123456789012345678901234567890",
                            "1.7976931348623157e308"});
  for (const std::string& number : {std::string("1e309"), "-1" + zeros,
                                    std::string("1e99999999999999999999"), "0." + zeros + "1e1000"})
    for (const auto& [file, format] :
         {std::pair(obj_of({"0", "0", "0", "1", "0", "0", "0", "1", number}), MeshFormat::obj),
          std::pair(stl_of({"0", "0", "0", "1", "0", "0", "0", "1", number}), MeshFormat::stl)})
      assert_refused(file, format, Status::mesh,
                     {number.substr(0, 30), "line", "range of a double"});
}

void assert_triangles(const std::string& file, const std::vector<msq::Triangle>& triangles) {
  const TriangleSoup soup = read(file, options_for(MeshFormat::obj));
  if (soup.triangles != triangles)
    fail_msg("%s: %zu triangles", file.c_str(), soup.triangles.size());
}

void obj_statements_are_read(void**) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::vector<msq::Triangle> two = {{0, 1, 2}, {0, 2, 3}}, one = {{0, 1, 2}};
  for (const char* face :
       {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1/1/1 2/1/1 3/1/1 4/1/1", "f 1//1 2//1 3//1 4//1",
        "f -4 -3 -2 -1", "f -4/-1 2// 3/ -1/7/-9", "\t f\t1   2\v3\f4 \t", "f +1 02 3 004",
        "f 1 2 \\\n3 4", "f \\\n1 2 3 4", "f 1 2 3\\  \n 4", "f 1 2\\\n\\\n 3 4",
        "f 1 2 \\\r\n 3 4", "f 1 2 3 4 # 5 6", "f 1 2 3\nf 1 3 4", "f 1 2 3 4\nf 1 2\nf 3\nf\n"})
    assert_triangles(square + face, two);
  // What is passed over.
  for (const char* line : {"# f 1 2 3",
                           "o f 1 2 3",
                           "g a b",
                           "s off",
                           "usemtl x",
                           "mtllib /dev/zero",
                           "vn 0 0 1",
                           "vt 0.5",
                           "vp 1 2",
                           "p 1",
                           "l 1 2 3",
                           "curv 0 1 1 2 3",
                           "cstype bspline",
                           "deg 3",
                           "surf 0 1 0 1 1 2 3 4",
                           "parm u 0 1",
                           "end",
                           "call x.obj",
                           "xyz \\\n f 1 2 3",
                           "F 1 2 3",
                           "V 1 2 3",
                           "fo 1 2 3",
                           "f.1 2 3",
                           "",
                           "   "})
    assert_triangles(square + line + "\nf 1 2 3\n", one);
  // A comment ends with its line.
  assert_triangles(square + "# C:\\parts\\\nf 1 2 3", one);
  // Weights and colours; line ends; a byte order mark.
  assert_triangles("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 2 3 4 x\nf 1 2 3", one);
  std::string other = "\xef\xbb\xbf" + square + "f 1 2 3 4\n";
  for (size_t at = 0; (at = other.find('\n', at)) != std::string::npos; at += 2)
    other.replace(at, 1, "\r\n");
  assert_triangles(other, two);
  for (size_t at = 0; (at = other.find("\r\n", at)) != std::string::npos;) other.erase(at + 1, 1);
  assert_triangles(other, two);
  // Faces before their vertices, a concave one among them; relative ones count from where they are.
  assert_triangles("f 1 2 3 4\n" + square, two);
  assert_triangles("v 0 0 0\nf -1 2 3\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n", {{0, 1, 2}, {0, 1, 2}});
  const std::string arrow = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n";
  assert_triangles("f 1 2 3 4\n" + arrow,
                   read(arrow + "f 1 2 3 4\n", options_for(MeshFormat::obj)).triangles);
}

void stl_layouts_are_read(void**) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  const auto count = [](const std::string& file) {
    return read(file, options_for(MeshFormat::stl)).triangles.size();
  };
  const std::string all = "solid a part of steel\n" + facet + "endsolid a part of steel\n";
  assert_int_equal(count(all), 1);
  assert_int_equal(count(all + all + "\n\n" + all), 3);
  assert_int_equal(count("solid facet normal\n" + facet + facet + "endsolid facet endsolid\n"), 2);
  assert_int_equal(count("  solid\n" + facet + "endsolid"), 1);
  assert_int_equal(count("solid empty\nendsolid empty\n" + all), 1);
  std::string line = facet;
  for (char& c : line) c = static_cast<char>(c == '\n' ? '\t' : c >= 'a' ? c - 32 : c);
  assert_int_equal(count("SOLID\n" + line + line + "EndSolid"), 2);
  std::string other = all;
  for (size_t at = 0; (at = other.find('\n', at)) != std::string::npos; at += 2)
    other.replace(at, 1, "\r\n");
  assert_int_equal(count(other), 1);
  // Normals of any kind.
  other = all;
  assert_int_equal(count(other.replace(other.find("0 0 1"), 5, "nan -nan(ind) x")), 1);
}

void errors_name_the_line(void**) {
  const struct {
    std::string file;
    Status status;
    std::vector<std::string> words;
  } objs[] = {
      {"v 0 0 0\nv 1 0\n", Status::io, {"line 2", "2 coordinates"}},
      {"v 0 0 0\r\n\r\nv 1 x 0\r\n", Status::io, {"line 3", "\"x\"", "not a number"}},
      {"v 0 0 0\rv 1 0 1,5\r", Status::io, {"line 2", "\"1,5\""}},
      {"v 0 0 0\nv 0 \\\n\\\n nan 0", Status::mesh, {"line 4", "\"nan\"", "not finite"}},
      {"v 0 0 0\nv 0 0 # 1\n", Status::io, {"line 2", "2 coordinates"}},
      {"v 0 0 0\nf 1 1 1\nf 1 0 1", Status::mesh, {"line 3", "index 0", "1 vertices"}},
      {"v 0 0 0\nf -1 -1 -2", Status::mesh, {"line 2", "index -2", "1 vertices so far"}},
      {"v 0 0 0\nf 1 1 1\n\nf 1 1 2\nf 1 1 3\nv 0 0 1\n",
       Status::mesh,
       {"line 5", "index 3", "2 vertices"}},
      {"v 0 0 0\nf 1 1 9223372036854775807\n", Status::mesh, {"line 2", "9223372036854775807"}},
      {"v 0 0 0\nf 1 1 9223372036854775808\n", Status::io, {"line 2", "9223372036854775808"}},
      {"v 0 0 0\nf 1 1 -9223372036854775808\n", Status::mesh, {"line 2", "-9223372036854775808"}},
      {"v 0 0 0\nf 1 1 1.5\n", Status::io, {"line 2", "1.5"}},
      {"v 0 0 0\nf 1 1 /1\n", Status::io, {"line 2", "integer"}},
  };
  for (const auto& bad : objs) {
    std::vector<std::string> words = bad.words;
    words.push_back("OBJ: ");
    assert_refused(bad.file, MeshFormat::obj, bad.status, words);
  }
  MeshFileOptions options = options_for(MeshFormat::obj);
  options.max_triangles = 1;
  assert_fails([&] { read("v 0 0 0\nf 1 1 1\nf 1 1 1\n", options); }, Status::limit,
               {"line 3", "max_triangles is 1"});
  std::string star, corners;
  for (int i = 0; i < 5000; ++i) {
    const double radius = i % 2 ? 1 : 2, angle = i * 2 * M_PI / 5000;
    star += text("v %.9g %.9g 0\n", radius * cos(angle), radius * sin(angle));
    corners += text(" %d", i + 1);
  }
  assert_refused("# a star\nf" + corners + "\n" + star + "f 1 2 3", MeshFormat::obj, Status::limit,
                 {"line 2", "5000", "4096"});

  const std::string begin = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const struct {
    std::string file;
    Status status;
    std::vector<std::string> words;
  } stls[] = {
      {begin + "vertex 0 1 zero\n", Status::io, {"line 6", "\"zero\""}},
      {begin + "vertex 0 1 inf\n", Status::mesh, {"line 6", "not finite"}},
      {begin + "vertex 0\n1\n", Status::io, {"line 8", "ends after 0 triangles"}},
      {begin + "endloop\n", Status::io, {"line 6", "\"endloop\"", "vertex"}},
      {begin + "vertex 0 1 0\nvertex 1 1 0\n", Status::io, {"line 7", "\"vertex\"", "endloop"}},
      {begin + "vertex 0 1 0\nendloop\nendfacet\nsolid",
       Status::io,
       {"line 9", "after 1 triangles"}},
      {begin + "vertex 0 1 0\nendloop\nendfacet\nendsolid a\nfacet",
       Status::io,
       {"line 10", "\"facet\""}},
  };
  for (const auto& bad : stls) {
    std::vector<std::string> words = bad.words;
    words.push_back("STL: ");
    assert_refused(bad.file, MeshFormat::stl, bad.status, words);
  }
  for (size_t n = 20; n < begin.size(); ++n)
    assert_refused(begin.substr(0, n), MeshFormat::stl, Status::io, {"STL", "line"});
}

void wide_text_is_told_apart(void**) {
  const struct {
    MeshFormat format;
    std::string content;
  } files[] = {{MeshFormat::obj, obj()},
               {MeshFormat::stl, stl_ascii()},
               {MeshFormat::off, off()},
               {MeshFormat::ply, ply(PlyKind::ascii)}};
  for (const auto& file : files)
    for (const size_t width : {2, 4})
      for (const bool big : {false, true})
        for (const bool marked : {false, true}) {
          std::string wide;
          const auto add = [&](unsigned code) {
            for (size_t i = 0; i < width; ++i)
              wide += static_cast<char>(code >> (8 * (big ? width - 1 - i : i)) & 0xff);
          };
          if (marked) add(0xfeff);
          for (const char c : file.content) add(static_cast<unsigned char>(c));
          assert_refused(wide, file.format, Status::unsupported, {"UTF-16", "UTF-8"});
        }
}

void survives_edits(void**) {
  constexpr int rounds = 4000;
  const std::string pieces[] = {"\\\n",   "#",  " -1", "f ",    "\r", "e999",
                                "/",      "v ", "nan", "\n\n",  "\\", "endloop ",
                                "solid ", "\t", "-0.", "facet "};
  std::mt19937_64 random(99);
  const struct {
    MeshFormat format;
    std::string content;
  } files[] = {{MeshFormat::obj, obj()}, {MeshFormat::stl, stl_ascii()}};
  for (const auto& file : files)
    for (int round = 0; round < rounds; ++round) {
      std::string content = file.content;
      for (uint64_t edits = 1 + random() % 3; edits > 0 && !content.empty(); --edits) {
        const size_t at = random() % content.size(), length = random() % 40;
        switch (random() % 5) {
          case 0:
            content.erase(at, length);
            break;
          case 1:
            content.insert(at, file.content.substr(random() % file.content.size(), length));
            break;
          case 2:
            content.insert(at, pieces[random() % std::size(pieces)]);
            break;
          case 3:
            content[at] = static_cast<char>(random());
            break;
          default:
            content.resize(at + 1);
        }
      }
      read_anything(content, file.format);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(coordinates_keep_every_bit),     cmocka_unit_test(ties_go_to_even),
      cmocka_unit_test(numbers_of_every_kind_are_read), cmocka_unit_test(obj_statements_are_read),
      cmocka_unit_test(stl_layouts_are_read),           cmocka_unit_test(errors_name_the_line),
      cmocka_unit_test(wide_text_is_told_apart),        cmocka_unit_test(survives_edits),
  };
  return cmocka_run_group_tests_name("mesh_text", tests, nullptr, nullptr);
}

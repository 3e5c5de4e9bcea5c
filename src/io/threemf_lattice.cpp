// SPDX-License-Identifier: Apache-2.0
// Source: 3MF Consortium, "Beam Lattice Extension", version 1.2.0, chapter 2. lib3mf up to 1.8
// writes clippingmode as "clipping", and the files of drafts have minlength as "precision". Sets of
// beams, properties and the mesh that only shows the lattice do not change the solid and are passed
// over.
#include "io/threemf_lattice.h"

#include <cmath>
#include <string>

#include "base/status.h"
#include "io/text_cursor.h"
#include "io/xml_document.h"

namespace msq {
namespace {

using Count = unsigned long long;

/// What structures of beams take.
constexpr double min_radius = 1e-100, max_radius = 1e75;

/// An element of a list; its value is a number of the list's enumeration.
struct Choice {
  const char* name;
  int value;
};
constexpr Choice caps[] = {{"sphere", 0}, {"hemisphere", 1}, {"butt", 2}};
constexpr Choice clippings[] = {{"none", 0}, {"inside", 1}, {"outside", 2}};
enum BallMode { no_balls, listed_balls, all_balls };
constexpr Choice ball_modes[] = {{"none", no_balls}, {"mixed", listed_balls}, {"all", all_balls}};

template <size_t n>
int choose(const Choice (&choices)[n], pugi::xml_attribute attribute, int none) {
  if (!attribute) return none;
  const std::string_view name = attribute.value();
  for (const Choice& choice : choices)
    if (name == choice.name) return choice.value;
  fail(Status::unsupported, "3MF: beamlattice: %s is \"%s\"; it must be %s, %s or %s",
       Quoted(attribute.name()).text, Quoted(name).text, choices[0].name, choices[1].name,
       choices[2].name);
}

bool is_radius(double r) {
  return r == 0 || (r >= min_radius && r <= max_radius);
}

double parse_radius(pugi::xml_attribute attribute, const char* what) {
  const double radius = parse_finite(attribute.value(), what);
  if (!is_radius(radius))
    fail(Status::mesh, "%s is %g; it must be 0 or from %g to %g", what, radius, min_radius,
         max_radius);
  return radius;
}

class LatticeReader {
 public:
  LatticeReader(pugi::xml_node element, const std::vector<Vec3>& vertices, uint64_t max_beams,
                const Job* job)
      : element_(element), vertices_(vertices), max_beams_(max_beams), poll_(job) {}

  ThreemfLattice read() {
    ThreemfLattice made;
    BeamLattice& lattice = made.lattice;
    lattice.nodes = vertices_;
    lattice.min_length = parse_finite(required("minlength", "precision").value(), "3MF: minlength");
    radius_ = parse_radius(required("radius"), "3MF: beamlattice: radius");
    cap_ = choose(caps, element_.attribute("cap"), 0);
    lattice.clipping =
        static_cast<Clipping>(choose(clippings, either("clippingmode", "clipping"), 0));
    if (lattice.clipping != Clipping::none)
      made.clipping_mesh = parse_count(required("clippingmesh").value(), "3MF: clippingmesh");
    for (const pugi::xml_node& child : element_.children())
      if (is_child(child, "beams")) read_beams(child, lattice);
    read_balls(lattice);
    lattice.drop_unused();
    return made;
  }

 private:
  pugi::xml_attribute either(const char* name, const char* old_name) const {
    const pugi::xml_attribute attribute = element_.attribute(name);
    return attribute ? attribute : element_.attribute(old_name);
  }
  pugi::xml_attribute required(const char* name, const char* old_name = "") const {
    const pugi::xml_attribute attribute = either(name, old_name);
    if (!attribute) fail(Status::io, "3MF: <beamlattice> has no %s", name);
    return attribute;
  }

  static bool is_child(pugi::xml_node node, std::string_view name) {
    if (local_name(node.name()) != name) return false;
    const std::string_view space = namespace_of(node, node.name());
    return space == beam_extension || space == ball_extension;
  }

  /// An attribute of balls: of their extension, or, as drafts had it, without a prefix.
  pugi::xml_attribute ball_attribute(std::string_view name) const {
    for (const pugi::xml_attribute& attribute : element_.attributes()) {
      const std::string_view full = attribute.name();
      if (local_name(full) != name) continue;
      if (full == name || namespace_of(element_, full) == ball_extension) return attribute;
    }
    return {};
  }

  uint32_t parse_index(pugi::xml_attribute attribute, const char* what, size_t number) const {
    const int64_t index = parse_integer(attribute.value(), "3MF: vertex index");
    if (index < 0 || static_cast<uint64_t>(index) >= vertices_.size())
      fail(Status::mesh, "3MF: %s %zu has vertex index %lld; there are %zu vertices", what, number,
           static_cast<long long>(index), vertices_.size());
    return static_cast<uint32_t>(index);
  }

  void expect_one_more(const BeamLattice& lattice) const {
    if (lattice.size() >= max_beams_)
      fail(Status::limit,
           "3MF: the lattice has more than %llu beams and balls; max_triangles is %llu",
           static_cast<Count>(lattice.size()), static_cast<Count>(max_beams_));
  }

  void read_beams(pugi::xml_node list, BeamLattice& lattice) {
    const std::string full = list.name();
    const std::string tag = full.substr(0, full.size() - local_name(full).size()) + "beam";
    for (const pugi::xml_node& node : list.children()) {
      poll_();
      if (node.name() != tag) continue;
      expect_one_more(lattice);
      const size_t number = lattice.beams.size();
      std::array<uint32_t, 2> ends{};
      std::array<double, 2> radii = {radius_, radius_};
      std::array<uint8_t, 2> end_caps = {static_cast<uint8_t>(cap_), static_cast<uint8_t>(cap_)};
      bool has_v1 = false, has_v2 = false, has_r1 = false, has_r2 = false;
      // In one pass: looking up each name by itself takes most of the time of a million beams.
      for (const pugi::xml_attribute& attribute : node.attributes()) {
        const std::string_view name = attribute.name();
        if (name == "v1" || name == "v2") {
          (name == "v1" ? has_v1 : has_v2) = true;
          ends[name == "v2"] = parse_index(attribute, "beam", number);
        } else if (name == "r1" || name == "r2") {
          (name == "r1" ? has_r1 : has_r2) = true;
          radii[name == "r2"] = parse_radius(attribute, "3MF: radius of a beam");
        } else if (name == "cap1" || name == "cap2") {
          end_caps[name == "cap2"] = static_cast<uint8_t>(choose(caps, attribute, cap_));
        }
      }
      if (!has_v1 || !has_v2)
        fail(Status::io, "3MF: beam %zu has no %s", number, has_v1 ? "v2" : "v1");
      if (has_r2 && !has_r1) fail(Status::io, "3MF: beam %zu has r2, but no r1", number);
      if (has_r1 && !has_r2) radii[1] = radii[0];
      if (ends[0] == ends[1])
        fail(Status::mesh, "3MF: beam %zu has vertex %u at both ends", number, ends[0]);
      if (radii[0] + radii[1] == 0)
        fail(Status::mesh, "3MF: the radii of beam %zu are both 0", number);
      lattice.beams.push_back(ends);
      lattice.radii.push_back(radii);
      lattice.caps.push_back(end_caps);
    }
  }

  void read_balls(BeamLattice& lattice) {
    const int mode = choose(ball_modes, ball_attribute("ballmode"), no_balls);
    if (mode == no_balls) return;
    const pugi::xml_attribute radius_attribute = ball_attribute("ballradius");
    if (!radius_attribute) fail(Status::io, "3MF: <beamlattice> has ballmode, but no ballradius");
    const double radius = parse_radius(radius_attribute, "3MF: ballradius");
    const auto add = [&](uint32_t node, double r) {
      expect_one_more(lattice);
      if (r == 0) fail(Status::mesh, "3MF: the radius of ball %zu is 0", lattice.balls.size());
      lattice.balls.push_back(node);
      lattice.ball_radii.push_back(r);
    };
    for (const pugi::xml_node& list : element_.children()) {
      if (!is_child(list, "balls")) continue;
      for (const pugi::xml_node& node : list.children()) {
        poll_();
        if (local_name(node.name()) != "ball") continue;
        const uint32_t vertex = parse_index(node.attribute("vindex"), "ball", lattice.balls.size());
        const pugi::xml_attribute own = node.attribute("r");
        add(vertex, own ? parse_radius(own, "3MF: radius of a ball") : radius);
      }
    }
    if (mode != all_balls) return;
    std::vector<bool> has_ball(vertices_.size());
    for (const uint32_t node : lattice.balls) has_ball[node] = true;
    for (const std::array<uint32_t, 2>& beam : lattice.beams)
      for (const uint32_t node : beam) {
        if (has_ball[node]) continue;
        has_ball[node] = true;
        add(node, radius);
      }
  }

  const pugi::xml_node element_;
  const std::vector<Vec3>& vertices_;
  const uint64_t max_beams_;
  CancelPoll poll_;
  double radius_ = 0;
  int cap_ = 0;
};

}  // namespace

std::string_view namespace_of(pugi::xml_node element, std::string_view name) {
  const std::string_view local = local_name(name);
  const std::string attribute =
      local.size() == name.size()
          ? "xmlns"
          : "xmlns:" + std::string(name.substr(0, name.size() - local.size() - 1));
  for (; element; element = element.parent())
    if (const pugi::xml_attribute found = element.attribute(attribute.c_str()))
      return found.value();
  return {};
}

pugi::xml_node lattice_of(pugi::xml_node mesh) {
  for (const pugi::xml_node& child : mesh.children())
    if (local_name(child.name()) == "beamlattice" &&
        namespace_of(child, child.name()) == beam_extension)
      return child;
  return {};
}

std::optional<ThreemfLattice> read_lattice(pugi::xml_node mesh, const std::vector<Vec3>& vertices,
                                           uint64_t max_beams, const Job* job) {
  const pugi::xml_node lattice = lattice_of(mesh);
  if (!lattice) return std::nullopt;
  return LatticeReader(lattice, vertices, max_beams, job).read();
}

}  // namespace msq

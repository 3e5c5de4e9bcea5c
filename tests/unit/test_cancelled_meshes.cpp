// SPDX-License-Identifier: Apache-2.0
// Every part of reading and building a mesh, and of sampling its distance, ends under a job that is
// cancelled.
#include "field/shape_distance.h"
#include "io/polygon.h"
#include "mesh_file_fixtures.h"
#include "shape/mesh.h"
#include "shape/mesh_diagnosis.h"
#include "shape/triangle_tree.h"

namespace {

using namespace mesh_file_fixtures;
using msq::Job;
using msq::JobPart;
using msq::MeshBoundary;
using msq::TriangleBins;
using msq::TriangleTree;
using msq::WindingRule;

const std::shared_ptr<msq::MemoryBudget> no_limit = std::make_shared<msq::MemoryBudget>(0);

/// A hilly sheet of 2 n^2 triangles.
TriangleSoup sheet(uint32_t n) {
  TriangleSoup soup;
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j <= n; ++j)
      soup.vertices.push_back({i * 0.1, j * 0.1, std::sin(i * 0.2) * std::cos(j * 0.3)});
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  return soup;
}

void assert_cancelled(const std::function<void(Job*)>& call) {
  call(nullptr);
  Job job;
  call(&job);
  job.cancel();
  assert_fails([&] { call(&job); }, Status::cancelled, {"cancelled"});
}

void parts_of_meshes_end(void**) {
  const TriangleSoup soup = sheet(50);
  const msq::ShapeFacts facts = msq::diagnose(soup, nullptr);
  assert_cancelled([&](Job* job) { msq::check_soup(soup, job); });
  assert_cancelled([&](Job* job) {
    TriangleSoup copy = soup;
    msq::weld(copy, job);
  });
  assert_cancelled([&](Job* job) { msq::diagnose(soup, job); });
  assert_cancelled([&](Job* job) { TriangleBins(soup, facts.bounds, 10, 10, job); });
  assert_cancelled([&](Job* job) {
    std::vector<msq::TreeTriangle> triangles;
    for (const msq::Triangle& t : soup.triangles)
      triangles.emplace_back(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]);
    TriangleTree(std::move(triangles), job);
  });
  assert_cancelled(
      [&](Job* job) { MeshBoundary(soup, facts, WindingRule::nonzero, no_limit, job); });
  assert_cancelled([&](Job* job) {
    msq::Mesh(soup, WindingRule::nonzero, no_limit, JobPart{job, 0, 1});
  });
}

void building_reports_its_progress(void**) {
  Job job;
  msq::Mesh(sheet(10), WindingRule::nonzero, no_limit, JobPart{&job, 0.5, 1});
  assert_true(job.progress() > 0.5 && job.progress() < 1);
}

void prepared_distance_is_built_again(void**) {
  const auto mesh = msq::make_ref<msq::Mesh>(sheet(50), WindingRule::nonzero, no_limit, JobPart{});
  Job job;
  job.cancel();
  assert_fails([&] { mesh->prepare_distance(&job); }, Status::cancelled, {"cancelled"});
  mesh->prepare_distance(nullptr);
  mesh->prepare_distance(&job);  // there is nothing left to do
  assert_true(mesh->distance({0, 0, 9}) > 0);
}

void samples_of_distances_end(void**) {
  const msq::Executor executor(2, true);
  const auto mesh = msq::make_ref<msq::Mesh>(sheet(20), WindingRule::nonzero, no_limit, JobPart{});
  mesh->prepare_distance(nullptr);
  assert_cancelled([&](Job* job) {
    msq::sample_distance(*mesh, 0.25, executor, no_limit, job);
    if (job) assert_true(job->progress() > 0.5);
  });
  const std::vector<float> values(1000, 1);
  const msq::Image::Source source{values.data(), msq::Image::Type::float32, {10, 10, 10}, 40, 400};
  assert_cancelled([&](Job* job) { msq::Image(source, {}, no_limit, job); });
}

/// Longer files than the samples: a job is looked at now and then.
std::string long_file(const Sample& sample) {
  const TriangleSoup soup = sheet(30);
  std::string vertices, faces;
  const auto add = [&](const char* begin, bool is_counted, int first) {
    for (const Vec3& v : soup.vertices)
      vertices += text("%s%.9g %.9g %.9g\n", begin, v.x, v.y, v.z);
    for (const msq::Triangle& t : soup.triangles)
      faces +=
          text(is_counted ? "3 %u %u %u\n" : "f %u %u %u\n", t[0] + static_cast<unsigned>(first),
               t[1] + static_cast<unsigned>(first), t[2] + static_cast<unsigned>(first));
  };
  switch (sample.format) {
    case MeshFormat::obj:
      add("v ", false, 1);
      return vertices + faces;
    case MeshFormat::off:
      add("", true, 0);
      return text("OFF %zu %zu 0\n", soup.vertices.size(), soup.triangles.size()) + vertices +
             faces;
    case MeshFormat::ply:
      add("", true, 0);
      return text(
                 "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
                 "property float z\nelement face %zu\nproperty list uchar int vertex_index\n"
                 "end_header\n",
                 soup.vertices.size(), soup.triangles.size()) +
             vertices + faces;
    case MeshFormat::stl: {
      std::string file = "solid\n";
      for (const msq::Triangle& t : soup.triangles) {
        file += "facet normal 0 0 1 outer loop";
        for (const uint32_t i : t) {
          const Vec3& v = soup.vertices[i];
          file += text(" vertex %.9g %.9g %.9g", v.x, v.y, v.z);
        }
        file += " endloop endfacet\n";
      }
      return file + "endsolid\n";
    }
    default:
      return sample.content;
  }
}

void files_end(void**) {
  for (const Sample& sample : samples()) {
    if (sample.name == std::string("binary.STL") || sample.name == std::string("box.amf")) continue;
    const std::string content = long_file(sample);
    MeshFileOptions options = options_for(sample.format);
    assert_cancelled([&](Job* job) {
      options.part = {job, 0, 0.5};
      read(content, options);
      if (job && sample.unit == 1) assert_true(job->progress() > 0.3 && job->progress() <= 0.5);
    });
    const std::string path = folder().write(sample.name, content);
    assert_cancelled([&](Job* job) {
      options.part = {job, 0, 0.5};
      msq::read_mesh_file(path, options);
    });
  }
}

#if MSQ_WITH_ASSIMP

/// A file of its own for what is not looked at in the samples, which are short.
void files_of_libraries_end(void**) {
  assert_cancelled([&](Job* job) {
    MeshFileOptions options = options_for(MeshFormat::stl);
    options.part = {job, 0, 1};
    read(stl_binary(), options);
  });
  // Not in an archive, whose unpacking would end first.
  std::string amf = "<amf><object id=\"1\"><mesh><vertices>";
  for (int i = 0; i < 2000; ++i)
    amf += text("<vertex><coordinates><x>%d</x><y>%d</y><z>1</z></coordinates></vertex>", i % 7, i);
  amf +=
      "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></"
      "object></amf>";
  assert_cancelled([&](Job* job) {
    MeshFileOptions options = options_for(MeshFormat::amf);
    options.part = {job, 0, 1};
    read(amf, options);
  });
}

#endif

void concave_polygons_end(void**) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  const uint32_t polygon[] = {0, 1, 2, 3};
  assert_cancelled([&](Job* job) {
    std::vector<msq::Triangle> triangles;
    msq::triangulate_polygon(arrow, polygon, triangles, job);
  });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
    cmocka_unit_test(parts_of_meshes_end),
    cmocka_unit_test(building_reports_its_progress),
    cmocka_unit_test(prepared_distance_is_built_again),
    cmocka_unit_test(samples_of_distances_end),
    cmocka_unit_test(files_end),
#if MSQ_WITH_ASSIMP
    cmocka_unit_test(files_of_libraries_end),
#endif
    cmocka_unit_test(concave_polygons_end),
  };
  return cmocka_run_group_tests_name("cancelled_meshes", tests, nullptr, nullptr);
}

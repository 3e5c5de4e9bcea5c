// SPDX-License-Identifier: Apache-2.0
// A foam as Embree (Wald et al., "Embree: a kernel framework for efficient CPU ray tracing", 2014)
// sees it: all its edges at once, as linear curves with round ends.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "bench.h"
#include "structure/foam/edges/edge_brick.h"

namespace bench {

/// Rays in cells, front to back of the cube that is looked at.
struct EmbreeRay {
  float origin[3], direction[3], from, to;
};

class EmbreeFoam {
 public:
  /// Edges near the cube of cells^3 cells with r = 0.1 cell. Finding them is not timed.
  explicit EmbreeFoam(int cells) {
    const msq::FoamSeeds seeds(0, 1, {1, 1, 1});
    constexpr int side = msq::EdgeBrick::side;
    for (int z = -side; z < cells + side; z += side)
      for (int y = -side; y < cells + side; y += side)
        for (int x = -side; x < cells + side; x += side)
          for (const msq::FoamEdge& edge : msq::EdgeBrick(seeds, {x, y, z}).edges())
            add(edge, {double(x), double(y), double(z)}, cells);
  }
  ~EmbreeFoam() {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
  }
  EmbreeFoam(const EmbreeFoam&) = delete;
  EmbreeFoam& operator=(const EmbreeFoam&) = delete;

  size_t edges() const { return vertices_.size() / 8; }

  void build() {
    if (scene_) rtcReleaseScene(scene_);
    if (!device_) device_ = rtcNewDevice("threads=2");
    if (!device_) throw std::runtime_error("Embree makes no device");
    const RTCGeometry curves = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    rtcSetSharedGeometryBuffer(curves, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               vertices_.data(), 0, 16, vertices_.size() / 4);
    indices_.resize(edges());
    for (size_t i = 0; i < indices_.size(); ++i) indices_[i] = static_cast<uint32_t>(2 * i);
    rtcSetSharedGeometryBuffer(curves, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, indices_.data(),
                               0, 4, indices_.size());
    rtcCommitGeometry(curves);
    scene_ = rtcNewScene(device_);
    rtcAttachGeometry(scene_, curves);
    rtcReleaseGeometry(curves);
    rtcCommitScene(scene_);
  }

  /// What each ray hits, infinity where nothing; two threads, one ray at a time, or 16.
  void cast(const std::vector<EmbreeRay>& rays, bool by_packets, std::vector<float>& t) const {
    t.resize(rays.size());
    std::atomic<size_t> next{0};
    const auto work = [&] {
      constexpr size_t batch = 1024;
      for (size_t i; (i = next.fetch_add(batch)) < rays.size();) {
        const size_t end = std::min(rays.size(), i + batch);
        by_packets ? cast_packets(rays, i, end, t) : cast_each(rays, i, end, t);
      }
    };
    std::thread other(work);
    work();
    other.join();
  }

 private:
  void add(const msq::FoamEdge& edge, msq::Vec3 corner, int cells) {
    constexpr double radius = 0.1;
    const msq::Vec3 a = corner + edge.a, b = corner + edge.b;
    for (int axis = 0; axis < 3; ++axis)
      if (std::max(a[axis], b[axis]) < -radius || std::min(a[axis], b[axis]) > cells + radius)
        return;
    for (const msq::Vec3& p : {a, b}) {
      for (int axis = 0; axis < 3; ++axis) vertices_.push_back(static_cast<float>(p[axis]));
      vertices_.push_back(static_cast<float>(radius));
    }
  }

  void cast_each(const std::vector<EmbreeRay>& rays, size_t i, size_t end,
                 std::vector<float>& t) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (; i < end; ++i) {
      RTCRayHit ray{};
      const EmbreeRay& r = rays[i];
      ray.ray = {r.origin[0],
                 r.origin[1],
                 r.origin[2],
                 r.from,
                 r.direction[0],
                 r.direction[1],
                 r.direction[2],
                 0,
                 r.to,
                 ~0u,
                 0,
                 0};
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      t[i] = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : ray.ray.tfar;
    }
  }

  void cast_packets(const std::vector<EmbreeRay>& rays, size_t i, size_t end,
                    std::vector<float>& t) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (; i < end; i += 16) {
      alignas(64) int valid[16];
      RTCRayHit16 packet{};
      for (size_t n = 0; n < 16; ++n) {
        valid[n] = i + n < end ? -1 : 0;
        const EmbreeRay& r = rays[std::min(i + n, end - 1)];
        packet.ray.org_x[n] = r.origin[0];
        packet.ray.org_y[n] = r.origin[1];
        packet.ray.org_z[n] = r.origin[2];
        packet.ray.dir_x[n] = r.direction[0];
        packet.ray.dir_y[n] = r.direction[1];
        packet.ray.dir_z[n] = r.direction[2];
        packet.ray.tnear[n] = r.from;
        packet.ray.tfar[n] = r.to;
        packet.ray.mask[n] = ~0u;
        packet.hit.geomID[n] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid, scene_, &context, &packet);
      for (size_t n = 0; n < 16 && i + n < end; ++n)
        t[i + n] = packet.hit.geomID[n] == RTC_INVALID_GEOMETRY_ID ? INFINITY : packet.ray.tfar[n];
    }
  }

  std::vector<float> vertices_;  // x, y, z, radius
  std::vector<uint32_t> indices_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace bench

#include "meshes/hull.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "engine/numeric/errors.h"
#include "meshes/polyhedron_measures.h"

namespace vex {
namespace {

/// Qhull's messages, kept instead of printed.
class Messages {
 public:
  Messages() : stream_(open_memstream(&text_, &size_)) {}
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  ~Messages() {
    std::fclose(stream_);
    std::free(text_);
  }
  std::FILE* stream() { return stream_; }
  std::string first_line() {
    std::fflush(stream_);
    const std::string all(text_, size_);
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_;
};

/// Qhull's state; freed whatever happens.
class Qhull {
 public:
  explicit Qhull(std::FILE* errors) { qh_zero(&state_, errors); }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    qh_freeqhull(&state_, !qh_ALL);
    int long_blocks = 0;
    int long_bytes = 0;
    qh_memfreeshort(&state_, &long_blocks, &long_bytes);
  }
  qhT* state() { return &state_; }

 private:
  qhT state_{};
};

/// The points about the middle of the first, scaled by a power of two to a size near 1: exact but for far-away points,
/// and Qhull's own rounding bounds are then those of the body and not of where it lies.
std::vector<double> coordinates_for_qhull(std::span<const Vec3d> points) {
  const double scale = std::ldexp(1.0, -std::ilogb(bounding_diagonal(points)));
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vec3d& p : points) {
    const Vec3d step = scale * (p - points.front());
    coordinates.insert(coordinates.end(), {step.x, step.y, step.z});
  }
  return coordinates;
}

std::array<std::uint32_t, 3> corners_of(qhT* qh, facetT* facet) {
  std::array<std::uint32_t, 3> corners{};
  for (int k = 0; k < 3; ++k) {
    const auto* vertex = static_cast<vertexT*>(facet->vertices->e[k].p);
    corners[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(qh_pointid(qh, vertex->point));
  }
  if (facet->toporient ^ qh_ORIENTclock) {
    std::swap(corners[1], corners[2]);
  }
  return corners;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> convex_hull_triangles(std::span<const Vec3d> points) {
  std::vector<double> coordinates = coordinates_for_qhull(points);
  Messages messages;
  Qhull qhull(messages.stream());
  qhT* qh = qhull.state();
  std::string options = "qhull Qt";  // every facet comes as triangles
  const int failed = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False, options.data(),
                                  nullptr, messages.stream());
  if (failed != 0) {
    throw InputError("no convex hull could be made of the vertices (" + messages.first_line() +
                     ") - the body is too thin or its vertices too close together for its size: mend the mesh");
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(static_cast<std::size_t>(qh->num_facets));
  for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
    triangles.push_back(corners_of(qh, facet));
  }
  return triangles;
}

}  // namespace vex

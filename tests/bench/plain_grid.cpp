#include "tests/bench/plain_grid.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

// The fifteen axes of two boxes (S. Gottschalk, M. C. Lin, D. Manocha, 1996), the faces' first.
bool are_apart(const double (&r)[3][3], const double (&t)[3], const double (&a)[3], const double (&b)[3]) {
  double q[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) q[i][j] = std::fabs(r[i][j]);
  }
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(t[i]) > a[i] + b[0] * q[i][0] + b[1] * q[i][1] + b[2] * q[i][2]) return true;
  }
  for (int j = 0; j < 3; ++j) {
    if (std::fabs(t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j]) >
        b[j] + a[0] * q[0][j] + a[1] * q[1][j] + a[2] * q[2][j]) {
      return true;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach = a[i1] * q[i2][j] + a[i2] * q[i1][j] + b[j1] * q[i][j2] + b[j2] * q[i][j1];
      if (std::fabs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) > reach) return true;
    }
  }
  return false;
}

}  // namespace

PlainGrid::PlainGrid(const SceneCase& scene) : edge_(scene.box->edges().x) {
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Transformd& p = scene.poses[k].a_from_b();
    const Vec3d half = 0.5 * scene.edges[scene.shape_of[k]];
    given_.push_back({p.translation,
                      half,
                      {p.row_x.x, p.row_y.x, p.row_z.x},
                      {p.row_x.y, p.row_y.y, p.row_z.y},
                      {p.row_x.z, p.row_y.z, p.row_z.z},
                      norm(half),
                      std::fmin(half.x, std::fmin(half.y, half.z)),
                      static_cast<std::uint32_t>(k)});
    largest_ = std::fmax(largest_, norm(half));
  }
  bodies_ = given_;
}

void PlainGrid::sort(int n_cells) {
  const auto cell = [&](double x) {
    const int k = static_cast<int>((x / edge_ + 0.5) * n_cells);
    return k < 0 ? 0 : k >= n_cells ? n_cells - 1 : k;
  };
  const std::size_t n =
      static_cast<std::size_t>(n_cells) * static_cast<std::size_t>(n_cells) * static_cast<std::size_t>(n_cells);
  starts_.assign(n + 1, 0);
  cell_of_.resize(given_.size());
  for (std::size_t k = 0; k < given_.size(); ++k) {
    const Vec3d& at = given_[k].at;
    cell_of_[k] = static_cast<std::uint32_t>((cell(at.z) * n_cells + cell(at.y)) * n_cells + cell(at.x));
    ++starts_[cell_of_[k] + 1];
  }
  for (std::size_t k = 0; k < n; ++k) starts_[k + 1] += starts_[k];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t k = 0; k < given_.size(); ++k) bodies_[next[cell_of_[k]]++] = given_[k];
}

void PlainGrid::test(const Body& a, const Body& b, const Vec3d& shift, std::vector<std::uint64_t>& out) {
  ++counts_.n_seen;
  const Vec3d d = (b.at - a.at) + shift;
  const double distance_sq = dot(d, d), reach = a.radius + b.radius;
  if (distance_sq > reach * reach) return;
  ++counts_.n_balls;
  const double inner = a.inner + b.inner;
  if (distance_sq > inner * inner) {
    ++counts_.n_tests;
    const double r[3][3] = {{dot(a.x, b.x), dot(a.x, b.y), dot(a.x, b.z)},
                            {dot(a.y, b.x), dot(a.y, b.y), dot(a.y, b.z)},
                            {dot(a.z, b.x), dot(a.z, b.y), dot(a.z, b.z)}};
    const double t[3] = {dot(a.x, d), dot(a.y, d), dot(a.z, d)};
    if (are_apart(r, t, {a.half.x, a.half.y, a.half.z}, {b.half.x, b.half.y, b.half.z})) return;
  }
  out.push_back((std::uint64_t{std::min(a.id, b.id)} << 32) | std::max(a.id, b.id));
}

void PlainGrid::overlapping_pairs(std::vector<std::uint64_t>& out) {
  out.clear();
  counts_ = {};
  const int n = std::min(static_cast<int>(edge_ / (2.0 * largest_)), 512);
  if (n < 3) {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      for (std::size_t j = i + 1; j < given_.size(); ++j) {
        const Vec3d d = given_[j].at - given_[i].at;
        test(given_[i], given_[j],
             {-edge_ * std::nearbyint(d.x / edge_), -edge_ * std::nearbyint(d.y / edge_),
              -edge_ * std::nearbyint(d.z / edge_)},
             out);
      }
    }
    return;
  }
  sort(n);
  const auto moved = [&](int k, double* shift) {
    *shift = k < 0 ? -edge_ : k >= n ? edge_ : 0.0;
    return k < 0 ? k + n : k >= n ? k - n : k;
  };
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const std::size_t own = static_cast<std::size_t>((z * n + y) * n + x);
        for (int k = 13; k < 27; ++k) {  // of the 27 cells around the own one, number 13, and those behind it
          Vec3d shift;
          const int cx = moved(x + k % 3 - 1, &shift.x), cy = moved(y + k / 3 % 3 - 1, &shift.y),
                    cz = moved(z + k / 9 - 1, &shift.z);
          const std::size_t other = static_cast<std::size_t>((cz * n + cy) * n + cx);
          for (std::uint32_t i = starts_[own]; i < starts_[own + 1]; ++i) {
            for (std::uint32_t j = k == 13 ? i + 1 : starts_[other]; j < starts_[other + 1]; ++j) {
              test(bodies_[i], bodies_[j], shift, out);
            }
          }
        }
      }
    }
  }
}

}  // namespace vex

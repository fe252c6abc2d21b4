// Random hulls, written as text and read again: with 17 digits they come back bit for bit, with 6 within the rounding
// that the reader states.
//
// Deterministic; VEX_ROUND_TRIP_HULLS=100000 in the environment makes it as many of each format.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "meshes/formats/strict_readers.h"
#include "meshes/hull.h"

namespace vex::tests {
namespace {

std::size_t n_hulls() {
  const char* const text = std::getenv("VEX_ROUND_TRIP_HULLS");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 10'000;
}

/// Writes text with numbers in it.
class Writer {
 public:
  explicit Writer(int n_digits) : n_digits_(n_digits) {}

  Writer& operator<<(const char* text) {
    text_ += text;
    return *this;
  }
  Writer& operator<<(std::size_t number) {
    text_ += std::to_string(number);
    return *this;
  }
  /// "x y z", parted by `separator`.
  Writer& point(const Vec3d& p, char separator = ' ') {
    std::array<char, 96> text{};
    const int size = std::snprintf(text.data(), text.size(), "%.*g%c%.*g%c%.*g", n_digits_, p.x, separator, n_digits_,
                                   p.y, separator, n_digits_, p.z);
    text_.append(text.data(), static_cast<std::size_t>(size));
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  int n_digits_;
  std::string text_;
};

void write_points(const PolygonSoup& soup, const char* before, Writer* to, char separator = ' ') {
  for (const Vec3d& point : soup.points) (*to << before).point(point, separator) << "\n";
}

/// Triangles, as lines "BEFORE a b c".
void write_triangles(const PolygonSoup& soup, const char* before, std::size_t first_index, Writer* to) {
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    *to << before;
    for (std::size_t k = i; k < i + 3; ++k) *to << " " << soup.corners[k] + first_index;
    *to << "\n";
  }
}

void write_obj(const PolygonSoup& soup, Writer* to) {
  write_points(soup, "v ", to);
  write_triangles(soup, "f", 1, to);
}
void write_off(const PolygonSoup& soup, Writer* to) {
  *to << "OFF\n" << soup.points.size() << " " << soup.face_sizes.size() << " 0\n";
  write_points(soup, "", to);
  write_triangles(soup, "3", 0, to);
}
void write_ply(const PolygonSoup& soup, Writer* to) {
  *to << "ply\nformat ascii 1.0\nelement vertex " << soup.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << soup.face_sizes.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  write_points(soup, "", to);
  write_triangles(soup, "3", 0, to);
}
void write_stl(const PolygonSoup& soup, Writer* to) {
  *to << "solid\n";
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    *to << "facet normal 0 0 0\nouter loop\n";
    for (std::size_t k = i; k < i + 3; ++k) (*to << "vertex ").point(soup.points[soup.corners[k]]) << "\n";
    *to << "endloop\nendfacet\n";
  }
  *to << "endsolid\n";
}
void write_xyz(const PolygonSoup& soup, Writer* to) { write_points(soup, "", to); }
void write_csv(const PolygonSoup& soup, Writer* to) {
  *to << "x,y,z\n";
  write_points(soup, "", to, ',');
}
void write_vtk(const PolygonSoup& soup, Writer* to) {
  *to << "# vtk DataFile Version 3.0\nhull\nASCII\nDATASET POLYDATA\nPOINTS " << soup.points.size() << " double\n";
  write_points(soup, "", to);
  *to << "POLYGONS " << soup.face_sizes.size() << " " << 4 * soup.face_sizes.size() << "\n";
  write_triangles(soup, "3", 0, to);
}
void write_msh_2(const PolygonSoup& soup, Writer* to) {
  *to << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << soup.points.size() << "\n";
  for (std::size_t i = 0; i < soup.points.size(); ++i) (*to << i + 1 << " ").point(soup.points[i]) << "\n";
  *to << "$EndNodes\n$Elements\n" << soup.face_sizes.size() << "\n";
  for (std::size_t i = 0; i < soup.face_sizes.size(); ++i) {
    *to << i + 1 << " 2 2 0 1";
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) *to << " " << soup.corners[k] + 1U;
    *to << "\n";
  }
  *to << "$EndElements\n";
}
void write_msh_4(const PolygonSoup& soup, Writer* to) {
  const std::size_t n = soup.points.size();
  *to << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " << n << " 1 " << n << "\n2 1 0 " << n << "\n";
  for (std::size_t i = 1; i <= n; ++i) *to << i << "\n";
  write_points(soup, "", to);
  const std::size_t n_faces = soup.face_sizes.size();
  *to << "$EndNodes\n$Elements\n1 " << n_faces << " 1 " << n_faces << "\n2 1 2 " << n_faces << "\n";
  for (std::size_t i = 0; i < n_faces; ++i) {
    *to << i + 1;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) *to << " " << soup.corners[k] + 1U;
    *to << "\n";
  }
  *to << "$EndElements\n";
}

/// Four to twelve points near a sphere, of any size and often far from the origin; some coordinates are 0 or -0.
PolygonSoup random_hull(std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double size = std::pow(10.0, 7.0 * uniform(*random));
  const double distance = (*random)() % 2 == 0 ? 0.0 : size * std::pow(10.0, 2.0 * uniform(*random));
  const Vec3d centre{distance * uniform(*random), distance * uniform(*random), distance * uniform(*random)};
  PolygonSoup soup;
  for (std::size_t n = 4 + (*random)() % 9; n > 0; --n) {
    Vec3d p{uniform(*random), uniform(*random), uniform(*random)};
    p = centre + size / (0.01 + norm(p)) * p;
    for (double* coordinate : {&p.x, &p.y, &p.z}) {
      if ((*random)() % 32 == 0) *coordinate = (*random)() % 2 == 0 ? 0.0 : -0.0;
    }
    soup.points.push_back(p);
  }
  for (const auto& triangle : convex_hull_triangles(soup.points))
    soup.add_face({triangle[0], triangle[1], triangle[2]});
  return soup;
}

struct TextFormat {
  const char* name;
  PolygonSoup (*read)(std::string_view bytes, const std::string& name);
  void (*write)(const PolygonSoup& soup, Writer* to);
};

/// What was written: every corner of each face in turn, or the points where a format holds no faces.
std::vector<Vec3d> corner_points(const PolygonSoup& soup) {
  if (soup.face_sizes.empty()) return soup.points;
  std::vector<Vec3d> points;
  for (const std::uint32_t corner : soup.corners) points.push_back(soup.points.at(corner));
  return points;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

class RoundTrip : public ::testing::TestWithParam<TextFormat> {
 protected:
  /// Of hulls from the beginning again: visit(what was written, what was read, point by point).
  template <class Visit>
  static void for_each_hull(int n_digits, const Visit& visit) {
    const TextFormat& format = GetParam();
    std::mt19937_64 random(11);
    for (std::size_t i = 0; i < n_hulls() && !HasFailure(); ++i) {
      const PolygonSoup hull = random_hull(&random);
      Writer writer(n_digits);
      format.write(hull, &writer);
      SCOPED_TRACE("hull " + std::to_string(i));
      PolygonSoup read;
      ASSERT_NO_THROW(read = format.read(writer.text(), "hull")) << writer.text();
      const bool holds_faces = !read.face_sizes.empty();
      const std::vector<Vec3d> written = holds_faces ? corner_points(hull) : hull.points;
      ASSERT_EQ(corner_points(read).size(), written.size()) << writer.text();
      visit(written, read);
    }
  }
};

TEST_P(RoundTrip, WithSeventeenDigitsIsBitForBit) {
  const bool holds_faces = GetParam().write != write_xyz && GetParam().write != write_csv;
  for_each_hull(17, [&](const std::vector<Vec3d>& written, const PolygonSoup& read) {
    const std::vector<Vec3d> points = corner_points(read);
    bool same = read.face_sizes == std::vector<std::uint32_t>(holds_faces ? written.size() / 3 : 0, 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      same = same && same_bits(points[i].x, written[i].x) && same_bits(points[i].y, written[i].y) &&
             same_bits(points[i].z, written[i].z);
    }
    EXPECT_TRUE(same);
    EXPECT_EQ(read.digits.kind, CoordinateDigits::Kind::doubles);
  });
}

TEST_P(RoundTrip, WithSixDigitsIsWithinTheStatedRounding) {
  for_each_hull(6, [](const std::vector<Vec3d>& written, const PolygonSoup& read) {
    const std::vector<Vec3d> points = corner_points(read);
    double largest = 0.0;
    double farthest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3d off = points[i] - written[i];
      farthest = std::max({farthest, std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
      largest = std::max({largest, std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z)});
    }
    EXPECT_EQ(read.digits.kind, CoordinateDigits::Kind::decimals);
    EXPECT_LE(farthest, 0.5 * read.digits.last_place * (1.0 + 1e-9));
    EXPECT_LE(read.digits.last_place, 1e-5 * largest * (1.0 + 1e-9));  // and no more than six digits bring with them
    EXPECT_EQ(read.digits.n_digits, 6);
  });
}

INSTANTIATE_TEST_SUITE_P(
    Text, RoundTrip,
    ::testing::Values(TextFormat{"obj", read_obj, write_obj}, TextFormat{"off", read_off, write_off},
                      TextFormat{"ply", read_ply, write_ply}, TextFormat{"stl", read_stl, write_stl},
                      TextFormat{"xyz", read_points, write_xyz}, TextFormat{"csv", read_points, write_csv},
                      TextFormat{"vtk", read_vtk, write_vtk}, TextFormat{"msh_2", read_gmsh, write_msh_2},
                      TextFormat{"msh_4", read_gmsh, write_msh_4}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace vex::tests

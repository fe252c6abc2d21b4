// Every file of the corpus, loaded: the body that it holds, or the refusal that says why it holds none.
#include "corpus.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "temporary_folder.h"

namespace vex::tests {
namespace {

constexpr std::size_t kLeastRows = 300;

std::string all_of(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += "\n  " + text;
  return all;
}

std::vector<std::array<double, 3>> sorted(const std::vector<Vec3d>& points) {
  std::vector<std::array<double, 3>> result;
  for (const Vec3d& p : points) result.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});  // no -0
  std::ranges::sort(result);
  return result;
}

/// Every vertex of either has one of the other within the tolerance.
void expect_vertices(const std::vector<Vec3d>& found, const Row& row) {
  const std::vector<Vec3d>& expected = row.body->vertices();
  ASSERT_EQ(found.size(), expected.size());
  if (row.coordinate_tolerance == 0.0) {
    EXPECT_EQ(sorted(found), sorted(expected));
    return;
  }
  for (const Vec3d& p : expected) {
    EXPECT_TRUE(std::ranges::any_of(found,
                                    [&](const Vec3d& q) {
                                      return std::max({std::fabs(p.x - q.x), std::fabs(p.y - q.y),
                                                       std::fabs(p.z - q.z)}) <= row.coordinate_tolerance;
                                    }))
        << "no vertex within " << row.coordinate_tolerance << " of (" << p.x << ", " << p.y << ", " << p.z << ")";
  }
}

void expect_body(const ConvexMesh& mesh, const Row& row) {
  const Measures& exact = row.body->measures;
  const auto near = [&](double found, double expected) {
    EXPECT_NEAR(found, expected, row.measures_tolerance * expected);
  };
  near(mesh.measures.volume, exact.volume);
  near(mesh.measures.surface_area, exact.surface_area);
  near(mesh.measures.integrated_mean_curvature, exact.integrated_mean_curvature);
  expect_vertices(mesh.polytope().vertices(), row);
  for (const std::string& part : row.notes) {
    EXPECT_TRUE(std::ranges::any_of(mesh.report.notes,
                                    [&](const std::string& note) { return note.find(part) != std::string::npos; }))
        << "'" << part << "' is in none of the notes:" << all_of(mesh.report.notes);
  }
  if (row.digits) {
    EXPECT_EQ(mesh.report.digits.kind, row.digits->kind);
    EXPECT_EQ(mesh.report.digits.n_digits, row.digits->n_digits);
    if (row.digits->last_place != 0.0) {
      EXPECT_NEAR(mesh.report.digits.last_place, row.digits->last_place, 1e-9 * row.digits->last_place);
    }
  }
  if (row.unit) {
    EXPECT_EQ(mesh.report.unit, *row.unit);
  }
  if (row.n_dropped) {
    EXPECT_EQ(mesh.report.n_dropped_vertices, *row.n_dropped);
  }
}

void expect_refusal(const std::string& message, const Row& row) {
  const auto expect_part = [&](const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
  };
  expect_part(" - ");
  if (row.names_the_file) expect_part(row.file);
  for (const std::string& part : row.fragments) expect_part(part);
}

/// Standard input is the file at `path` while this is there.
class StandardInput {
 public:
  explicit StandardInput(const std::filesystem::path& path) : before_(::dup(STDIN_FILENO)) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_GE(::dup2(file, STDIN_FILENO), 0);
    ::close(file);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;
  ~StandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

class Corpus : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Corpus, HasTheAnswerThatTheTableGives) {
  const Row& row = corpus()[GetParam()];
  SCOPED_TRACE(row.name);
  const TemporaryFolder folder;
  std::filesystem::path path = folder.path() / row.file;
  if (row.is_folder) {
    std::filesystem::create_directory(path);
  } else {
    path = folder.file(row.file, row.bytes);
  }
  for (const auto& [name, bytes] : row.beside) folder.file(name, bytes);
  std::optional<StandardInput> input;
  if (row.from_standard_input) {
    input.emplace(path);
    path = "-";
  }
  std::string message;
  try {
    const ConvexMesh mesh = load(path, row.options);
    if (row.body) return expect_body(mesh, row);
    FAIL() << "a body of volume " << mesh.measures.volume << " and " << mesh.polytope().n_vertices()
           << " vertices was made of what is to be refused" << all_of(mesh.report.notes);
  } catch (const InputError& error) {
    message = error.what();
  } catch (const UsageError& error) {
    message = error.what();
  }
  ASSERT_FALSE(row.body) << "refused: " << message;
  expect_refusal(message, row);
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, ::testing::Range(std::size_t{0}, corpus().size()), [](const auto& test) {
  std::string name;
  for (const char c : corpus()[test.param].name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.ends_with('_')) {
      name += '_';
    }
  }
  return name;
});

TEST(CorpusTable, HasEveryFormatAndEveryFaultThatWasFound) {
  EXPECT_GE(corpus().size(), kLeastRows);
  std::size_t n_bodies = 0;
  std::set<std::string> extensions;
  std::set<std::string> names;
  for (const Row& row : corpus()) {
    n_bodies += row.body ? 1U : 0U;
    extensions.insert(std::filesystem::path(row.file).extension().string());
    EXPECT_TRUE(names.insert(row.name).second) << "two rows are named " << row.name;
  }
  EXPECT_GE(n_bodies, kLeastRows / 3);
  EXPECT_GE(corpus().size() - n_bodies, kLeastRows / 3);
  for (const char* extension : {".obj", ".off", ".ply", ".stl", ".xyz", ".csv", ".txt", ".vtk", ".msh", ".gltf", ".glb",
                                ".dae", ".3mf", ".gz"}) {
    EXPECT_TRUE(extensions.contains(extension)) << extension;
  }
  for (int fault = 1; fault <= 12; ++fault) {
    const std::string words = "fault " + std::to_string(fault) + ",";
    EXPECT_TRUE(std::ranges::any_of(names, [&](const std::string& name) {
      return name.find(words) != std::string::npos;
    })) << words;
  }
}

/// The closed forms that the table rests on, against sums over the faces.
TEST(CorpusTable, ClosedFormsAreThoseOfTheirFaces) {
  for (const Solid& solid : {box(), tetrahedron(), octahedron(), wedge(), five_prism(), twelve_prism(), icosahedron(),
                             dodecahedron({100, 200, -100}), cut_box(2), box_with_roof(), corner(1, 1.25, 1),
                             whole_wedge(), one_digit_prism()}) {
    long double volume = 0;
    long double area = 0;
    for (const Face& face : triangulated(solid).faces) {
      const Vec3d a = solid.points[face[0]] - solid.points[0];
      const Vec3d b = solid.points[face[1]] - solid.points[0];
      const Vec3d c = solid.points[face[2]] - solid.points[0];
      volume += dot(a, cross(b, c)) / 6.0;
      area += norm(cross(b - a, c - a)) / 2.0;
    }
    EXPECT_NEAR(solid.measures.volume, static_cast<double>(volume), 1e-12 * solid.measures.volume);
    EXPECT_NEAR(solid.measures.surface_area, static_cast<double>(area), 1e-12 * solid.measures.surface_area);
    // Each edge once for each of its two faces, with half of the angle between their normals.
    double curvature = 0;
    const auto normal = [&](const Face& f) {
      const Vec3d n = cross(solid.points[f[1]] - solid.points[f[0]], solid.points[f[2]] - solid.points[f[0]]);
      return 1 / norm(n) * n;
    };
    for (const Face& f : solid.faces) {
      for (std::size_t i = 0; i < f.size(); ++i) {
        const std::uint32_t from = f[i];
        const std::uint32_t to = f[(i + 1) % f.size()];
        for (const Face& g : solid.faces) {
          for (std::size_t k = 0; k < g.size(); ++k) {
            if (g[k] != to || g[(k + 1) % g.size()] != from) continue;
            const double angle = std::atan2(norm(cross(normal(f), normal(g))), dot(normal(f), normal(g)));
            curvature += 0.25 * norm(solid.points[to] - solid.points[from]) * angle;
          }
        }
      }
    }
    EXPECT_NEAR(solid.measures.integrated_mean_curvature, curvature, 1e-12 * curvature);
  }
}

}  // namespace
}  // namespace vex::tests

// The direction of includes (CONTRIBUTING, "Where things live"): a room sees only the rooms below it, and each third
// party has one place.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path file;  // relative to the source folder
  std::string what;
};

// A room within a room, which sees more than the rest of it: the integrands that are made of a body's measures.
const std::string kEstimators = "shapes/estimators";

// Those of a room within the room are not among them.
std::vector<Include> includes_below(const std::string& room) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
  std::vector<Include> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(VEX_SOURCE_DIR) / room)) {
    const std::string file = fs::relative(entry.path(), VEX_SOURCE_DIR).generic_string();
    if (room != kEstimators && file.rfind(kEstimators + "/", 0) == 0) continue;
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream text(entry.path());
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
      if (std::regex_search(line, match, pattern)) found.push_back({file, match[1]});
    }
  }
  return found;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const std::string& prefix : prefixes) {
    if (text.rfind(prefix, 0) == 0) return true;
  }
  return false;
}

TEST(Structure, EveryRoomSeesOnlyTheRoomsBelowIt) {
  const std::map<std::string, std::vector<std::string>> allowed = {
      {"engine/numeric", {"engine/numeric/"}},
      {"engine/support", {"engine/numeric/", "engine/support/"}},
      {"engine/query", {"engine/numeric/", "engine/support/", "engine/query/"}},
      {"engine/scene", {"engine/numeric/", "engine/support/", "engine/query/", "engine/scene/"}},
      {"engine/sampling", {"engine/"}},
      {"shapes", {"engine/numeric/", "engine/support/", "shapes/"}},
      {kEstimators, {"engine/numeric/", "engine/support/", "engine/sampling/", "shapes/"}},
      {"meshes", {"engine/numeric/", "engine/support/", "shapes/", "meshes/"}},
      {"apps/modules", {"engine/numeric/", "apps/modules/"}},
      {"apps/peers", {"engine/", "shapes/", "meshes/", "apps/modules/", "apps/peers/"}},
      {"apps/referees", {"engine/", "shapes/", "meshes/", "apps/referees/"}},
      {"apps", {"engine/", "shapes/", "meshes/", "apps/"}},
      {"python", {"engine/", "shapes/", "meshes/", "python/"}},
  };
  const std::vector<std::string> rooms = {"engine/", "shapes/", "meshes/", "apps/", "python/", "tests/"};
  for (const auto& [room, may_see] : allowed) {
    const std::vector<Include> includes = includes_below(room);
    ASSERT_FALSE(includes.empty()) << room << ": nothing was looked at";
    for (const Include& include : includes) {
      if (!starts_with_any(include.what, rooms)) continue;
      EXPECT_TRUE(starts_with_any(include.what, may_see)) << include.file << " includes " << include.what;
    }
  }
}

TEST(Structure, EveryThirdPartyHasItsOnePlace) {
  const std::map<std::string, std::vector<std::string>> places = {
      {"assimp/", {"meshes/assimp_"}},
      {"zlib.h",
       {"meshes/gunzip.cpp", "meshes/formats/zip_archive.cpp", "meshes/data/archives.cpp", "apps/common/checksum.cpp",
        "apps/common/html/packed.cpp"}},
      {"libqhull", {"meshes/hull.cpp"}},
      {"seccomp.h", {"meshes/confinement.cpp"}},
      {"ccd/", {"apps/peers/ccd_"}},
      {"fcl/", {"apps/peers/fcl_"}},
      {"Random123/", {"engine/sampling/points/random_stream.cpp"}},
      {"Eigen/", {"engine/numeric/eigen.h", "shapes/nematic/", "apps/referees/"}},
      {"boost/",
       {"engine/numeric/whole.h", "engine/numeric/float_256.h", "engine/sampling/estimate.cpp",
        "engine/sampling/percolation/extrapolation.cpp", "engine/sampling/points/sobol.cpp", "shapes/ellipsoid.cpp",
        "shapes/spindle.cpp", "shapes/estimators/legendre_series.cpp", "shapes/estimators/axial_average.cpp",
        "shapes/estimators/axis_moments.cpp", "shapes/nematic/", "apps/referees/", "apps/vex_paper/"}},
      {"CLI/", {"apps/common/"}},
      {"nlohmann/", {"apps/"}},
      {"mpi.h", {"apps/ranks/mpi_ranks.cpp"}},
      {"pybind11/", {"python/bindings/"}},
  };
  std::set<std::string> seen;
  for (const std::string& room :
       std::vector<std::string>{"engine", "shapes", kEstimators, "meshes", "apps", "python"}) {
    for (const Include& include : includes_below(room)) {
      for (const auto& [library, files] : places) {
        if (include.what.rfind(library, 0) != 0) continue;
        seen.insert(library);
        EXPECT_TRUE(starts_with_any(include.file.string(), files)) << include.file << " includes " << include.what;
      }
    }
  }
  EXPECT_EQ(seen.size(), places.size()) << "a library of the list is not used where it should be";
}

TEST(Structure, TheCheckerSharesNothingWithTheSearches) {
  const std::vector<Include> includes = includes_below("engine/query/checker");
  ASSERT_FALSE(includes.empty());
  for (const Include& include : includes) {
    for (const char* room : {"engine/query/search/", "engine/query/exact/", "engine/query/packets/"}) {
      EXPECT_EQ(include.what.rfind(room, 0), std::string::npos) << include.file << " includes " << include.what;
    }
  }
}

TEST(Structure, TheOracleStaysApart) {
  // The sampler never sees V, S and M, and what computes them never sees the sampler. The estimators see both, and
  // neither sees them.
  for (const Include& include : includes_below("engine")) {
    EXPECT_EQ(include.what.find("measures"), std::string::npos) << include.file;
  }
  for (const char* room : {"shapes", "meshes"}) {
    for (const Include& include : includes_below(room)) {
      EXPECT_EQ(include.what.rfind("engine/sampling", 0), std::string::npos) << include.file;
      EXPECT_EQ(include.what.rfind("engine/query", 0), std::string::npos) << include.file;
      EXPECT_EQ(include.what.rfind(kEstimators, 0), std::string::npos) << include.file;
    }
  }
}

}  // namespace

#include "apps/referees/wrong_tests.h"

#include <cmath>
#include <string>

#include "apps/referees/box_box.h"
#include "apps/referees/test_backend.h"

namespace vex {
namespace {

Outcome yes_or_no(bool meets) { return meets ? Outcome::overlap : Outcome::disjoint; }

bool an_edge_meets(const EdgesAndSlabs& edges, double reach) {
  return edges_meet_solid(edges, 0.0, reach) == Outcome::overlap;
}

bool a_vertex_is_inside(const EdgesAndSlabs& edges) {
  bool inside[8] = {true, true, true, true, true, true, true, true};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = edges.half_edge[0][i], y = edges.half_edge[1][i], z = edges.half_edge[2][i];
    const double on_edge[4] = {x + y, x - y, y - x, -(x + y)};
    for (std::size_t k = 0; k < 4; ++k) {
      const double middle = edges.centre[i] + on_edge[k];
      inside[k] = inside[k] & (std::fabs(middle + z) <= edges.half_width[i]);
      inside[k + 4] = inside[k + 4] & (std::fabs(middle - z) <= edges.half_width[i]);
    }
  }
  bool any_inside = false;
  for (const bool one : inside) any_inside = any_inside | one;
  return any_inside;
}

// No slab of the solid has all of the parallelepiped on one side.
bool no_slab_separates(const EdgesAndSlabs& edges) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double extent =
        std::fabs(edges.half_edge[0][i]) + std::fabs(edges.half_edge[1][i]) + std::fabs(edges.half_edge[2][i]);
    if (std::fabs(edges.centre[i]) > extent + edges.half_width[i]) return false;
  }
  return true;
}

// `meets`: from the pair, the placed box and a length that bounds every coordinate.
template <class Meets>
BackendKind box_test(std::string name, Meets meets) {
  return {std::move(name), true,
          [meets](const ConvexBody& a, const ConvexBody& b) {
            return test_backend([meets, pair = BoxPair(*a.target<Box>(), *b.target<Box>())](const Transformd& pose) {
              const PlacedBox placed(pose);
              return yes_or_no(meets(pair, placed, pair.reach + placed.norm_1_of_centre));
            });
          },
          [](const ConvexBody& a, const ConvexBody& b) {
            return a.target<Box>() != nullptr && b.target<Box>() != nullptr;
          }};
}

}  // namespace

BackendKind one_sided_backend() {
  return box_test("one-sided", [](const BoxPair& pair, const PlacedBox& b, double reach) {
    return an_edge_meets(edges_of_b_against_a(pair, b), reach);
  });
}

BackendKind edges_required_both_ways_backend() {
  return box_test("edges-required-both-ways", [](const BoxPair& pair, const PlacedBox& b, double reach) {
    return an_edge_meets(edges_of_b_against_a(pair, b), reach) && an_edge_meets(edges_of_a_against_b(pair, b), reach);
  });
}

BackendKind vertices_either_way_backend() {
  return box_test("vertices-either-way", [](const BoxPair& pair, const PlacedBox& b, double) {
    return a_vertex_is_inside(edges_of_b_against_a(pair, b)) || a_vertex_is_inside(edges_of_a_against_b(pair, b));
  });
}

BackendKind vertices_one_way_backend() {
  return box_test("vertices-one-way", [](const BoxPair& pair, const PlacedBox& b, double) {
    return a_vertex_is_inside(edges_of_b_against_a(pair, b));
  });
}

BackendKind face_normals_only_backend() {
  return box_test("face-normals-only", [](const BoxPair& pair, const PlacedBox& b, double) {
    return no_slab_separates(edges_of_b_against_a(pair, b)) && no_slab_separates(edges_of_a_against_b(pair, b));
  });
}

std::vector<BackendKind> wrong_box_backends() {
  return {one_sided_backend(), edges_required_both_ways_backend(), vertices_either_way_backend(),
          vertices_one_way_backend(), face_normals_only_backend()};
}

}  // namespace vex

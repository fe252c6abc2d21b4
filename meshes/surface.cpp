#include "meshes/surface.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

/// The edge between two vertices, as the refusals print it.
std::string edge_text(const PolygonSurface& surface, std::uint32_t a, std::uint32_t b) {
  return "the edge from " + point_text(surface.vertices[a]) + " to " + point_text(surface.vertices[b]);
}

void check_one_component(const PolygonSurface& surface) {
  const std::vector<std::uint32_t> component = component_of_each_vertex(surface);
  std::size_t n_components = 0;
  std::uint32_t second = 0;
  for (std::uint32_t v = 0; v < component.size(); ++v) {
    if (component[v] == v && ++n_components == 2) {
      second = v;
    }
  }
  if (n_components > 1) {
    throw InputError("the mesh is not one body (" + std::to_string(n_components) +
                     " surfaces that share no vertex; one has the vertex " + point_text(surface.vertices[0]) +
                     ", another the vertex " + point_text(surface.vertices[second]) + ")" +
                     hull_advice("keep one of them"));
  }
}

/// A half-edge, filed under the lower of its two vertices.
struct HalfEdge {
  std::uint32_t higher_vertex = 0;
  std::uint32_t corner = 0;

  friend bool operator<(const HalfEdge& a, const HalfEdge& b) {
    return a.higher_vertex != b.higher_vertex ? a.higher_vertex < b.higher_vertex : a.corner < b.corner;
  }
};

/// All half-edges, those of one edge side by side: a counting sort by the lower vertex, then each vertex's few by the
/// higher. begin[v] .. begin[v + 1] - 1 are those whose lower vertex is v.
struct SortedHalfEdges {
  std::vector<std::uint32_t> begin;
  std::vector<HalfEdge> half_edges;
};

template <class Visit>  // visit(corner, its vertex, the next vertex)
void for_each_half_edge(const PolygonSurface& surface, const Visit& visit) {
  for (std::size_t f = 0; f < surface.n_faces(); ++f) {
    if (f % 4096 == 0) end_if_interrupted();
    const std::uint32_t begin = surface.face_begin[f];
    const std::uint32_t last = surface.face_begin[f + 1] - 1;
    for (std::uint32_t corner = begin; corner <= last; ++corner) {
      visit(corner, surface.corners[corner], surface.corners[corner < last ? corner + 1 : begin]);
    }
  }
}

SortedHalfEdges sorted_half_edges(const PolygonSurface& surface) {
  SortedHalfEdges sorted;
  std::vector<std::uint32_t>& begin = sorted.begin;
  begin.assign(surface.vertices.size() + 1, 0);
  for_each_half_edge(surface, [&](std::uint32_t, std::uint32_t a, std::uint32_t b) { ++begin[std::min(a, b) + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  sorted.half_edges.resize(surface.corners.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for_each_half_edge(surface, [&](std::uint32_t corner, std::uint32_t a, std::uint32_t b) {
    sorted.half_edges[next[std::min(a, b)]++] = {std::max(a, b), corner};
  });
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    std::sort(sorted.half_edges.begin() + begin[v], sorted.half_edges.begin() + begin[v + 1]);
  }
  return sorted;
}

/// What is wrong with the edges, counted, and one example of each.
struct EdgeCensus {
  std::size_t n_edges = 0;
  std::size_t n_open = 0, n_one_way = 0;
  std::string first_open, first_one_way;
};

EdgeCensus pair_half_edges(const PolygonSurface& surface, std::vector<std::uint32_t>* mates) {
  const SortedHalfEdges sorted = sorted_half_edges(surface);
  EdgeCensus census;
  mates->assign(surface.corners.size(), 0);
  for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
    if (v % 4096 == 0) end_if_interrupted();
    const std::uint32_t end = sorted.begin[v + 1];
    for (std::uint32_t i = sorted.begin[v], next = i; i < end; i = next) {
      const HalfEdge& first = sorted.half_edges[i];
      while (next < end && sorted.half_edges[next].higher_vertex == first.higher_vertex) {
        ++next;
      }
      ++census.n_edges;
      if (next - i != 2) {
        if (census.n_open++ == 0) {
          census.first_open = edge_text(surface, v, first.higher_vertex) + " has " + std::to_string(next - i);
        }
        continue;
      }
      const std::uint32_t second = sorted.half_edges[i + 1].corner;
      if ((surface.corners[first.corner] == v) == (surface.corners[second] == v) && census.n_one_way++ == 0) {
        census.first_one_way = edge_text(surface, v, first.higher_vertex);
      }
      (*mates)[first.corner] = second;
      (*mates)[second] = first.corner;
    }
  }
  return census;
}

std::string open_text(const EdgeCensus& census) {
  return std::to_string(census.n_open) + " of its " + std::to_string(census.n_edges) +
         " edges are not shared by exactly two faces";
}

std::string one_way_text(const EdgeCensus& census) {
  return std::to_string(census.n_one_way) + " of " + std::to_string(census.n_edges) +
         " edges run the same way in both their faces";
}

}  // namespace

void PolygonSurface::put_in_order() {
  for (std::size_t f = 0; f < n_faces(); ++f) {
    const auto begin = corners.begin() + face_begin[f];
    const auto end = corners.begin() + face_begin[f + 1];
    std::rotate(begin, std::min_element(begin, end), end);
  }
  // A counting sort by the first corner, then each vertex's few faces by all corners.
  std::vector<std::uint32_t> begin_of_vertex(vertices.size() + 1, 0);
  for (std::size_t f = 0; f < n_faces(); ++f) {
    ++begin_of_vertex[face(f).front() + 1];
  }
  std::partial_sum(begin_of_vertex.begin(), begin_of_vertex.end(), begin_of_vertex.begin());
  std::vector<std::uint32_t> next(begin_of_vertex.begin(), begin_of_vertex.end() - 1);
  std::vector<std::uint32_t> order(n_faces());
  for (std::size_t f = 0; f < n_faces(); ++f) {
    order[next[face(f).front()]++] = static_cast<std::uint32_t>(f);
  }
  for (std::size_t v = 0; v + 1 < begin_of_vertex.size(); ++v) {
    if (v % 4096 == 0) end_if_interrupted();
    std::sort(order.begin() + begin_of_vertex[v], order.begin() + begin_of_vertex[v + 1],
              [this](std::uint32_t f, std::uint32_t g) {
                return std::lexicographical_compare(face(f).begin(), face(f).end(), face(g).begin(), face(g).end());
              });
  }
  std::vector<std::uint32_t> sorted_corners;
  std::vector<std::uint32_t> sorted_begin{0};
  sorted_corners.reserve(corners.size());
  sorted_begin.reserve(face_begin.size());
  for (const std::uint32_t f : order) {
    sorted_corners.insert(sorted_corners.end(), face(f).begin(), face(f).end());
    sorted_begin.push_back(static_cast<std::uint32_t>(sorted_corners.size()));
  }
  corners = std::move(sorted_corners);
  face_begin = std::move(sorted_begin);
}

void PolygonSurface::turn_inside_out() {
  for (std::size_t f = 0; f < n_faces(); ++f) {
    std::reverse(corners.begin() + face_begin[f], corners.begin() + face_begin[f + 1]);
  }
  put_in_order();
}

HalfEdgePairs half_edge_pairs(const PolygonSurface& surface) {
  HalfEdgePairs pairs;
  if (surface.n_faces() == 0) {
    pairs.problem = "there are no faces";
    return pairs;
  }
  const EdgeCensus census = pair_half_edges(surface, &pairs.mates);
  if (census.n_open > 0) {
    pairs.problem = "the surface is not closed: " + open_text(census);
  } else if (census.n_one_way > 0) {
    pairs.problem = "the faces are not consistently oriented: " + one_way_text(census);
  }
  return pairs;
}

/// Union by least, with path halving.
std::vector<std::uint32_t> component_of_each_vertex(const PolygonSurface& surface) {
  std::vector<std::uint32_t> parent(surface.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) {
      parent[v] = parent[parent[v]];
      v = parent[v];
    }
    return v;
  };
  for (std::size_t f = 0; f < surface.n_faces(); ++f) {
    for (const std::uint32_t corner : surface.face(f)) {
      const std::uint32_t a = root(corner);
      const std::uint32_t b = root(surface.face(f).front());
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    parent[v] = root(v);
  }
  return parent;
}

std::vector<std::uint32_t> checked_half_edges(const PolygonSurface& surface) {
  if (surface.n_faces() == 0) {
    throw InputError("the mesh has no faces (0 polygons with three different corners)" +
                     hull_advice("name a file that holds a closed surface"));
  }
  check_one_component(surface);
  std::vector<std::uint32_t> mates;
  const EdgeCensus census = pair_half_edges(surface, &mates);
  const std::string n_edges = std::to_string(census.n_edges);
  if (census.n_open > 0) {
    throw InputError("the surface is not closed (" + open_text(census) + "; " + census.first_open + ")" +
                     hull_advice("close the holes and remove inner or doubled faces"));
  }
  if (census.n_one_way > 0) {
    throw InputError("the faces are not consistently oriented (" + one_way_text(census) + "; one is " +
                     census.first_one_way + ")" + hull_advice("make all faces counter-clockwise seen from outside"));
  }
  const auto characteristic = static_cast<long long>(surface.vertices.size()) - static_cast<long long>(census.n_edges) +
                              static_cast<long long>(surface.n_faces());
  if (characteristic != 2) {
    throw InputError("the surface is not of the kind of a sphere (its Euler characteristic is " +
                     std::to_string(surface.vertices.size()) + " vertices - " + n_edges + " edges + " +
                     std::to_string(surface.n_faces()) + " faces = " + std::to_string(characteristic) + ", not 2)" +
                     hull_advice("close its handles and part what touches at a vertex"));
  }
  return mates;
}

}  // namespace vex

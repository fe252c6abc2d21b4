#include "shapes/estimators/normal_nodes.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <variant>

#include "engine/numeric/double_double.h"
#include "engine/numeric/expect.h"

namespace vex {
namespace {

constexpr double kGoldenTurn = 0.38196601125010515;

/// Where a unit vector lies along a Hilbert curve over the octahedron unfolded into a square.
std::uint64_t place_on_sphere(const Vec3d& n) {
  const double scale = 1.0 / norm_1(n);
  double x = scale * n.x, y = scale * n.y;
  if (n.z < 0.0) {
    const double folded_x = std::copysign(1.0 - std::fabs(y), x), folded_y = std::copysign(1.0 - std::fabs(x), y);
    x = folded_x;
    y = folded_y;
  }
  constexpr std::uint32_t kSide = 1u << 16;
  const auto cell = [](double t) {
    return static_cast<std::uint32_t>(std::clamp((0.5 + 0.5 * t) * kSide, 0.0, kSide - 1.0));
  };
  std::uint32_t i = cell(x), j = cell(y);
  std::uint64_t place = 0;
  for (std::uint32_t s = kSide / 2; s > 0; s /= 2) {
    const std::uint32_t right = (i & s) ? 1 : 0, upper = (j & s) ? 1 : 0;
    place = 4 * place + ((3 * right) ^ upper);
    if (upper == 0) {  // turn the quarter so that the curve goes on where it came from
      if (right == 1) {
        i = kSide - 1 - i;
        j = kSide - 1 - j;
      }
      std::swap(i, j);
    }
  }
  return place;
}

Vec3d middle_normal(const NormalMeasure::Component& component) { return normal_at(component, 0.5, 0.5).unit_normal; }

bool is_whole_sphere(const NormalMeasure::Component& component) {
  const auto* const zone = std::get_if<NormalZone>(&component);
  return zone != nullptr && zone->cos_from == -1.0 && zone->cos_to == 1.0;
}

/// Whether n and -n count the same: half of the component's mass may then be given to the opposites. Not all that are
/// need be known.
bool is_even(const NormalMeasure::Component& component) {
  if (const auto* const ring = std::get_if<NormalRing>(&component)) return ring->cos_polar == 0.0;
  if (const auto* const zone = std::get_if<NormalZone>(&component)) return zone->cos_from == -zone->cos_to;
  return std::holds_alternative<NormalBelt>(component) || std::holds_alternative<EllipsoidNormals>(component) ||
         std::holds_alternative<EllipsoidCurvature>(component) ||
         std::holds_alternative<SuperellipsoidNormals>(component);
}

/// Exactly opposite vectors are equal once the first coordinate that is not 0 is made positive.
bool is_turned(const Vec3d& n) { return n.x < 0.0 || (n.x == 0.0 && (n.y < 0.0 || (n.y == 0.0 && n.z < 0.0))); }

double fraction(double x) { return x - std::floor(x); }

}  // namespace

template <class Component>
NormalNodes::Sort<Component>::Sort(std::vector<Component> components) : components_(std::move(components)) {
  if (components_.size() <= kMostSummed) return;
  std::vector<std::pair<std::uint64_t, std::size_t>> places;
  places.reserve(components_.size());
  for (std::size_t i = 0; i < components_.size(); ++i)
    places.emplace_back(place_on_sphere(middle_normal(components_[i])), i);
  std::ranges::sort(places);
  std::vector<Component> sorted;
  sorted.reserve(components_.size());
  for (const auto& place : places) sorted.push_back(components_[place.second]);
  components_ = std::move(sorted);
  shares_.reserve(components_.size());
  for (const Component& component : components_) shares_.push_back(component.mass);
  normalise_shares();
}

template <class Component>
void NormalNodes::Sort<Component>::normalise_shares() {
  DoubleDouble total, sum;
  for (const double share : shares_) total += share;
  share_up_to_.clear();
  share_up_to_.reserve(shares_.size());
  for (double& share : shares_) {
    share /= total.value();
    sum += share;
    share_up_to_.push_back(sum.value());
  }
  first_of_step_.clear();
  for (std::size_t step = 0; step <= kPicks; ++step) {
    const double from = static_cast<double>(step) / static_cast<double>(kPicks);
    const auto found = std::ranges::upper_bound(share_up_to_, from);
    first_of_step_.push_back(static_cast<std::uint32_t>(
        std::min(static_cast<std::size_t>(found - share_up_to_.begin()), share_up_to_.size() - 1)));
  }
}

template <class Component>
void NormalNodes::Sort<Component>::favour(const std::function<double(const Vec3d&)>& typical) {
  if (!picks()) return;
  std::vector<double> favoured;
  favoured.reserve(components_.size());
  double sum = 0.0;
  for (const Component& component : components_) {
    favoured.push_back(component.mass * typical(middle_normal(component)));
    sum += favoured.back();
  }
  if (!(sum > 0.0)) return;
  for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] = 0.5 * (shares_[i] + favoured[i] / sum);
  normalise_shares();
}

template <class Component>
void NormalNodes::Sort<Component>::place_picks(double pick, double v, double w, std::size_t first,
                                               NormalColumns& columns) const {
  constexpr double kStep = 1.0 / static_cast<double>(kPicks);
  const auto begin = share_up_to_.begin();
  for (std::size_t step = 0; step < kPicks; ++step) {
    const double at = (static_cast<double>(step) + pick) * kStep;
    const auto last = begin + first_of_step_[step + 1];  // which is the answer where none before it is
    const auto i = static_cast<std::size_t>(std::upper_bound(begin + first_of_step_[step], last, at) - begin);
    const WeightedNormal found = normal_at(components_[i], v, w);
    columns.set(first + step, found.unit_normal, kStep * found.weight / shares_[i]);
  }
}

NormalNodes::NormalNodes(const NormalMeasure& area, bool spins) {
  std::vector<NormalAtom> faces;
  std::vector<NormalArc> edges;
  faces.reserve(static_cast<std::size_t>(std::ranges::count_if(
      area.components(), [](const auto& component) { return std::holds_alternative<NormalAtom>(component); })));
  bool is_even_across = false, is_curved_across = false;
  DoubleDouble uniform, rest;
  for (const NormalMeasure::Component& component : area.components()) {
    const double mass = mass_of(component);
    if (!(mass > 0.0)) continue;
    if (is_whole_sphere(component)) {
      uniform += mass;
      continue;
    }
    rest += mass;
    const CoordinatesUsed used = coordinates_used(component);
    coordinates_.v = coordinates_.v || used.v;
    coordinates_.w = coordinates_.w || (used.w && !(spins && is_alike_about_z(component)));
    if (const auto* const face = std::get_if<NormalAtom>(&component)) {
      faces.push_back(*face);
    } else if (const auto* const edge = std::get_if<NormalArc>(&component)) {
      edges.push_back(*edge);
    } else {
      const bool even = is_even(component);
      (even ? even_ : curved_).push_back(component);
      if (used.v && used.w) (even ? is_even_across : is_curved_across) = true;
    }
  }
  uniform_mass_ = uniform.value();
  mass_ = rest.value();
  // One place of a part that is even counts for its opposite too.
  n_of_even_ = std::max<std::size_t>(1, n_places(is_even_across, even_.size()) / 2);
  n_of_curved_ = n_places(is_curved_across, curved_.size());
  n_of_edge_ = n_places(false, edges.size());
  faces_ = Sort<NormalAtom>(std::move(faces));
  edges_ = Sort<NormalArc>(std::move(edges));
  if (!faces_.picks()) pair_faces();
}

std::size_t NormalNodes::n_places(bool is_across, std::size_t n_components) {
  const std::size_t of_all = is_across ? kPlacesAcross : kPlacesAlong;
  return std::max<std::size_t>(1, of_all / std::max<std::size_t>(1, n_components));
}

double NormalNodes::take_out_faces(const std::function<double(const Vec3d&)>& f) {
  DoubleDouble total;
  for (const NormalAtom& face : faces_.components()) {
    total += face.mass * f(face.unit_normal);
    mass_ -= face.mass;
  }
  faces_ = {};
  face_pairs_.clear();
  single_faces_.clear();
  return total.value();
}

bool NormalNodes::has_powers() const {
  return std::ranges::any_of(even_, [](const NormalMeasure::Component& component) {
    return std::holds_alternative<SuperellipsoidNormals>(component);
  });
}

std::size_t NormalNodes::n_components() const {
  return faces_.n_components() + edges_.n_components() + even_.size() + curved_.size();
}

void NormalNodes::pair_faces() {
  struct Face {
    Vec3d normal;
    bool turned;
    double mass;
  };
  std::vector<Face> faces;
  for (const NormalAtom& atom : faces_.components()) {
    const bool turned = is_turned(atom.unit_normal);
    faces.push_back({turned ? -atom.unit_normal : atom.unit_normal, turned, atom.mass});
  }
  std::ranges::stable_sort(faces, [](const Face& a, const Face& b) {
    return std::tie(a.normal.x, a.normal.y, a.normal.z) < std::tie(b.normal.x, b.normal.y, b.normal.z);
  });
  for (std::size_t i = 0; i < faces.size();) {
    Pair pair{faces[i].normal, 0.0, 0.0};
    bool has_along = false, has_against = false;
    const auto is_equal = [&](const Vec3d& n) {
      return n.x == pair.unit_normal.x && n.y == pair.unit_normal.y && n.z == pair.unit_normal.z;
    };
    for (; i < faces.size() && is_equal(faces[i].normal); ++i) {
      (faces[i].turned ? pair.against : pair.along) += faces[i].mass;
      (faces[i].turned ? has_against : has_along) = true;
    }
    if (has_along && has_against) {
      face_pairs_.push_back(pair);
    } else if (has_along) {
      single_faces_.push_back({pair.unit_normal, pair.along});
    } else {
      single_faces_.push_back({-pair.unit_normal, pair.against});
    }
  }
}

void NormalNodes::favour(const std::function<double(const Vec3d&)>& typical) {
  faces_.favour(typical);
  edges_.favour(typical);
}

NormalColumns NormalNodes::columns() const {
  NormalColumns columns;
  columns.n_pairs = face_pairs_.size() + even_.size() * n_of_even_;
  const std::size_t n = columns.n_pairs + single_faces_.size() + (faces_.picks() ? kPicks : 0) +
                        (edges_.picks() ? kPicks : edges_.n_components() * n_of_edge_) + curved_.size() * n_of_curved_;
  for (std::vector<double>* const column : {&columns.x, &columns.y, &columns.z, &columns.along}) column->resize(n);
  columns.against.resize(columns.n_pairs);
  for (std::size_t i = 0; i < face_pairs_.size(); ++i) {
    columns.set(i, face_pairs_[i].unit_normal, face_pairs_[i].along);
    columns.against[i] = face_pairs_[i].against;
  }
  for (std::size_t i = 0; i < single_faces_.size(); ++i) {
    columns.set(columns.n_pairs + i, single_faces_[i].unit_normal, single_faces_[i].mass);
  }
  return columns;
}

template <class Component>
void NormalNodes::place_all(const std::vector<Component>& components, std::size_t n, double v, double w, bool halved,
                            std::size_t first, NormalColumns& columns) {
  const double step = 1.0 / static_cast<double>(n);
  for (const Component& component : components) {
    const bool is_arc = !coordinates_used(component).w, is_ring = !coordinates_used(component).v;
    // Half a turn of a part that is even is the opposites'.
    const double turn = is_arc ? 0.0 : (is_ring ? (halved ? 0.5 * step : step) : kGoldenTurn);
    for (std::size_t j = 0; j < n; ++j, ++first) {
      const auto k = static_cast<double>(j);
      const WeightedNormal found = normal_at(component, (k + v) * step, fraction(w + k * turn));
      const double weight = (halved ? 0.5 * step : step) * found.weight;
      columns.set(first, found.unit_normal, weight);
      if (halved) columns.against[first] = weight;
    }
  }
}

void NormalNodes::place(std::span<const double> point, const NormalCoordinates& at, NormalColumns& columns) const {
  if (columns.size() == face_pairs_.size() + single_faces_.size()) return;  // all faces, each counted
  const auto coordinate = [point](int i) { return i < 0 ? 0.5 : point[static_cast<std::size_t>(i)]; };
  const double v = coordinate(at.v), w = coordinate(at.w);
  place_all(even_, n_of_even_, v, w, true, face_pairs_.size(), columns);
  std::size_t first = columns.n_pairs + single_faces_.size();
  if (faces_.picks()) {
    faces_.place_picks(coordinate(at.pick), v, w, first, columns);
    first += kPicks;
  }
  if (edges_.picks()) {
    edges_.place_picks(coordinate(at.pick), v, w, first, columns);
    first += kPicks;
  } else {
    place_all(edges_.components(), n_of_edge_, v, w, false, first, columns);
    first += edges_.n_components() * n_of_edge_;
  }
  place_all(curved_, n_of_curved_, v, w, false, first, columns);
}

}  // namespace vex

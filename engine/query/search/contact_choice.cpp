#include "engine/query/search/contact_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace vex {
namespace {

using Contact = ContactManifold::Contact;

// Quadrilaterals of at least this share of the largest one's area are as good; and of corners that are as far from a
// diagonal but for so much the first one counts. Which is the largest would hang on the last digits, of a disc's
// corners say; which of those that are as good has the least features does not.
constexpr double kAsGood = 0.97, kFarther = 1.0 + 0x1p-20;

using Four = std::array<std::size_t, 4>;

struct Quadrilateral {
  Four corners;
  double area;
};

// Over each diagonal of a convex polygon the farthest corners on either side, which go on as the diagonal does.
template <class Take>
void for_each_quadrilateral(const std::vector<PlanarPoint>& places, const Take& take) {
  const std::size_t n = places.size();
  const auto at = [&](std::size_t k) -> const PlanarPoint& { return places[k < n ? k : k - n]; };
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) { return turn(at(j) - at(i), at(k) - at(i)); };
  for (std::size_t i = 0; i + 2 < n; ++i) {
    std::size_t right = i + 1, left = i + 3;
    for (std::size_t k = i + 2; k < n && k + 1 < i + n; ++k) {
      while (right + 1 < k && area(i, right + 1, k) > kFarther * area(i, right, k)) ++right;
      left = std::max(left, k + 1);
      while (left + 1 < i + n && area(k, left + 1, i) > kFarther * area(k, left, i)) ++left;
      Four corners{i, right, k, left < n ? left : left - n};
      take(Quadrilateral{corners, area(i, right, k) + area(k, left, i)});
    }
  }
}

// By their features, whatever the numbers of the corners.
std::array<FeatureId, 8> features_of(const std::vector<Contact>& contacts, const Four& corners) {
  std::array<std::pair<FeatureId, FeatureId>, 4> pairs;
  for (std::size_t k = 0; k < 4; ++k) pairs[k] = {contacts[corners[k]].feature_a, contacts[corners[k]].feature_b};
  std::ranges::sort(pairs);
  std::array<FeatureId, 8> features{};
  for (std::size_t k = 0; k < 4; ++k) {
    features[2 * k] = pairs[k].first;
    features[2 * k + 1] = pairs[k].second;
  }
  return features;
}

Four largest_four(const std::vector<Contact>& contacts, const std::vector<PlanarPoint>& places) {
  double most = 0.0;
  for_each_quadrilateral(places, [&](const Quadrilateral& one) { most = std::max(most, one.area); });
  Four best{0, 1, 2, 3};
  std::array<FeatureId, 8> least;
  least.fill(~FeatureId{0});
  for_each_quadrilateral(places, [&](const Quadrilateral& one) {
    if (!(one.area >= kAsGood * most)) return;
    const std::array<FeatureId, 8> features = features_of(contacts, one.corners);
    if (!(features < least)) return;
    least = features;
    best = one.corners;
  });
  return best;
}

double area_of(const std::vector<PlanarPoint>& places, const Four& four) {
  return turn(places[four[2]] - places[four[0]], places[four[3]] - places[four[1]]);
}

}  // namespace

void find_outermost(const std::vector<PlanarPoint>& places, std::vector<std::size_t>& outermost) {
  outermost.clear();
  for (std::size_t k = 0; k < kMostOutermost - 1; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / (kMostOutermost - 1);
    const PlanarPoint dir{std::cos(angle), std::sin(angle)};
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (dot(dir, places[i]) > dot(dir, places[farthest])) farthest = i;
    }
    outermost.push_back(farthest);
  }
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (dot(places[i], places[i]) < dot(places[nearest], places[nearest])) nearest = i;
  }
  outermost.push_back(nearest);
  std::ranges::sort(outermost);
  outermost.erase(std::unique(outermost.begin(), outermost.end()), outermost.end());
}

void keep_four(std::vector<Contact>& contacts, const std::vector<PlanarPoint>& places, double slope) {
  if (contacts.size() <= 4) return;
  PlanarPoint lower = places[0], upper = lower;
  for (const PlanarPoint& place : places) {
    lower = {std::fmin(lower.x, place.x), std::fmin(lower.y, place.y)};
    upper = {std::fmax(upper.x, place.x), std::fmax(upper.y, place.y)};
  }
  const double shallower = slope * std::fmin(upper.x - lower.x, upper.y - lower.y);
  Four four = largest_four(contacts, places);
  std::ranges::sort(four);
  const auto distance = [&](std::size_t k) { return contacts[k].signed_distance; };
  std::size_t deepest = 0;
  for (std::size_t k = 1; k < contacts.size(); ++k) {
    if (distance(k) < distance(deepest)) deepest = k;
  }
  if (distance(deepest) < distance(*std::ranges::min_element(four, {}, distance)) - shallower) {
    Four best = four;
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < four.size(); ++k) {
      Four other = four;
      other[k] = deepest;
      std::ranges::sort(other);
      const double area = area_of(places, other);
      if (area > most) {
        most = area;
        best = other;
      }
    }
    four = best;
  }
  for (std::size_t k = 0; k < four.size(); ++k) contacts[k] = contacts[four[k]];  // four[k] >= k
  contacts.resize(4);
}

}  // namespace vex

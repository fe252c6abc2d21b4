#include "engine/query/search/contact_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace vex {
namespace {

using Contact = ContactManifold::Contact;

// An area has to be as much larger to be taken instead of one that was found before.
constexpr double kLarger = 1.0 + 0x1p-10;

// Numbers of the contacts in the polygon's order, from one on that does not hang on where the polygon begins.
void find_candidates(const std::vector<Contact>& contacts, std::vector<std::size_t>& candidates) {
  candidates.clear();
  for (std::size_t k = 0; k < contacts.size(); ++k) candidates.push_back(k);
  const auto first = std::ranges::min_element(candidates, {}, [&](std::size_t k) {
    return std::pair(contacts[k].feature_a, contacts[k].feature_b);
  });
  std::rotate(candidates.begin(), first, candidates.end());
}

using Four = std::array<std::size_t, 4>;

// The largest quadrilateral of a convex polygon's corners: over each diagonal the farthest corner on either side, which
// goes on as the diagonal does.
Four largest_four(const std::vector<PlanarPoint>& places, const std::vector<std::size_t>& candidates) {
  const std::size_t n = candidates.size();
  const auto at = [&](std::size_t k) -> const PlanarPoint& { return places[candidates[k % n]]; };
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) { return turn(at(j) - at(i), at(k) - at(i)); };
  Four best{candidates[0], candidates[1], candidates[2], candidates[3 % n]};
  double most = 0.0;
  for (std::size_t i = 0; i + 2 < n; ++i) {
    std::size_t right = i + 1, left = i + 3;
    for (std::size_t k = i + 2; k < n && k + 1 < i + n; ++k) {
      while (right + 1 < k && area(i, right + 1, k) > area(i, right, k)) ++right;
      left = std::max(left, k + 1);
      while (left + 1 < i + n && area(k, left + 1, i) > area(k, left, i)) ++left;
      const double found = area(i, right, k) + area(k, left, i);
      if (!(found > kLarger * most)) continue;
      most = found;
      best = {candidates[i], candidates[right % n], candidates[k], candidates[left % n]};
    }
  }
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

void keep_four(std::vector<Contact>& contacts, const std::vector<PlanarPoint>& places, double shallower,
               std::vector<std::size_t>& candidates) {
  if (contacts.size() <= 4) return;
  find_candidates(contacts, candidates);
  Four four = largest_four(places, candidates);
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

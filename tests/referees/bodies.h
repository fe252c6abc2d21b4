// The bodies that the property, statistical and peer suites run over: a new body is one line here.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {

inline constexpr std::array kTestBodies = {
    "sphere:0.6",
    "box:1,1,1",
    "box:0.2,1,3",
    "ellipsoid:0.5,0.5,1.5",
    "ellipsoid:1,2,3",
    "capsule:1,0.25",
    "cylinder:1,0.5",
    "cylinder:0.1,1",
    "cone:1,0.5",
    "cone:0.2,1",
    "frustum:1,0.7,0.3",
    "frustum:0.5,0.2,0.9",
    "hemisphere:0.8",
    "disc:0.7",
    "plate:1,1.3",
    "needle:2",
    "tetrahedron:1.3",
    "octahedron:1",
    "dodecahedron:0.5",
    "icosahedron:0.7",
    "rounded:0.2,plate:1,0.8",
    "rounded:0.1,tetrahedron:1",
};

/// Further bodies: each by itself meets the laws that those above do, but is paired with itself and one of those alone.
inline constexpr std::array kFurtherBodies = {
    "prism:5,0.7,1",     "antiprism:4,0.8,0.9",
    "pyramid:6,0.6,1.1", "truncated-tetrahedron:0.6",
    "snub-cube:0.5",     "truncated-icosidodecahedron:0.2",
};
/// Bodies without an exact form: they are undecided within rounding of contact.
inline constexpr std::array kFormlessBodies = {
    "lens:0.9,0.7",
    "cut-sphere:0.8,0.3,0.6",
    "spindle:1.8,0.5",
    "egg:0.6,0.5,1.1",
    "superball:0.7,0.8",
    "superball:4,0.6",
    "superellipsoid:0.5,0.7,0.9,1.5,0.75",
};
/// These are not paired at all.
inline constexpr std::array kUnpairedBodies = {
    "lens:1,0.01",
    "cut-sphere:0.7,0.7,0.1",
    "spindle:2,0.03",
    "egg:1,0.1,1",
    "cuboctahedron:0.8",
    "truncated-cube:0.5",
    "truncated-octahedron:0.6",
    "rhombicuboctahedron:0.5",
    "truncated-cuboctahedron:0.3",
    "icosidodecahedron:0.5",
    "truncated-dodecahedron:0.3",
    "truncated-icosahedron:0.4",
    "rhombicosidodecahedron:0.4",
    "snub-dodecahedron:0.4",
};

/// Of all these lists.
inline std::vector<const char*> every_test_body() {
  std::vector<const char*> all(kTestBodies.begin(), kTestBodies.end());
  all.insert(all.end(), kFurtherBodies.begin(), kFurtherBodies.end());
  all.insert(all.end(), kUnpairedBodies.begin(), kUnpairedBodies.end());
  all.insert(all.end(), kFormlessBodies.begin(), kFormlessBodies.end());
  return all;
}

/// Two bodies of the list, by the names they are made from.
struct NamedPair {
  std::string a, b;
};

/// Whether the bodies can meet at all, but by touching: two needles cannot.
inline bool exclude_volume(const NamedPair& pair) {
  return average_excluded_volume(parse_shape(pair.a).measures, parse_shape(pair.b).measures) > 0.0;
}

/// Of the further bodies: with itself, and with one that another further body is not paired with.
inline std::vector<NamedPair> further_pairs() {
  std::vector<NamedPair> pairs;
  for (std::size_t k = 0; k < kFurtherBodies.size(); ++k) {
    pairs.push_back({kFurtherBodies[k], kFurtherBodies[k]});
    pairs.push_back({kFurtherBodies[k], kTestBodies[(3 * k + 4) % kTestBodies.size()]});
  }
  return pairs;
}

/// Pairs of which one body has no exact form: not for laws of what is decided to the last bit.
template <class Bodies>
std::vector<NamedPair> pairs_without_form(const Bodies& bodies) {
  std::vector<NamedPair> pairs;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    pairs.push_back({bodies[k], bodies[k]});
    pairs.push_back({bodies[k], kTestBodies[(3 * k + 2) % kTestBodies.size()]});
  }
  return pairs;
}
inline std::vector<NamedPair> formless_pairs() { return pairs_without_form(kFormlessBodies); }

/// Every pair of `kTestBodies` in both orders, but those that exclude no volume; and the further ones.
inline std::vector<NamedPair> ordered_pairs() {
  std::vector<NamedPair> pairs;
  for (const char* a : kTestBodies) {
    for (const char* b : kTestBodies) {
      if (exclude_volume({a, b})) pairs.push_back({a, b});
    }
  }
  for (const NamedPair& pair : further_pairs()) pairs.push_back(pair);
  return pairs;
}

/// The same in one order, for laws that look at both orders themselves or do not depend on it.
inline std::vector<NamedPair> unordered_pairs() {
  std::vector<NamedPair> pairs;
  for (std::size_t i = 0; i < kTestBodies.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (exclude_volume({kTestBodies[i], kTestBodies[j]})) pairs.push_back({kTestBodies[i], kTestBodies[j]});
    }
  }
  for (const NamedPair& pair : further_pairs()) pairs.push_back(pair);
  return pairs;
}

/// box_1_1_1_needle_2: what a test of a pair is called.
inline std::string test_name(const NamedPair& pair) {
  std::string name = pair.a + "_" + pair.b;
  for (char& c : name) {
    if (c == ':' || c == ',' || c == '.' || c == '-') c = '_';
  }
  return name;
}

}  // namespace vex

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

/// Two bodies of the list, by the names they are made from.
struct BodyPair {
  std::string a, b;
};

/// Whether the bodies can meet at all, but by touching: two needles cannot.
inline bool exclude_volume(const BodyPair& pair) {
  return average_excluded_volume(parse_shape(pair.a).measures, parse_shape(pair.b).measures) > 0.0;
}

/// Every pair in both orders, but those that exclude no volume.
inline std::vector<BodyPair> ordered_pairs() {
  std::vector<BodyPair> pairs;
  for (const char* a : kTestBodies) {
    for (const char* b : kTestBodies) {
      if (exclude_volume({a, b})) pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Every pair in one order, for laws that look at both orders themselves or do not depend on it.
inline std::vector<BodyPair> unordered_pairs() {
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < kTestBodies.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (exclude_volume({kTestBodies[i], kTestBodies[j]})) pairs.push_back({kTestBodies[i], kTestBodies[j]});
    }
  }
  return pairs;
}

/// box_1_1_1_needle_2: what a test of a pair is called.
inline std::string test_name(const BodyPair& pair) {
  std::string name = pair.a + "_" + pair.b;
  for (char& c : name) {
    if (c == ':' || c == ',' || c == '.') c = '_';
  }
  return name;
}

}  // namespace vex

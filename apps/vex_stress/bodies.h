// The pairs of bodies that the strata are made of.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "apps/vex_stress/placement.h"
#include "shapes/polytope.h"

namespace vex {

/// Each text as `named_pair` reads it.
std::vector<StressPair> named_pairs(std::initializer_list<const char*> texts);

std::vector<StressPair> polytope_pairs();
std::vector<StressPair> rounded_pairs();
std::vector<StressPair> curved_pairs();
std::vector<StressPair> parallel_pairs();
std::vector<StressPair> feature_pairs();
std::vector<StressPair> identical_polytope_pairs();
std::vector<StressPair> identical_curved_pairs();

/// n points near the unit sphere times `stretch`, moved by `offset`; its centre is at the offset.
Polytope sphere_points(std::size_t n, const Vec3d& stretch, std::uint64_t seed, const Vec3d& offset = {});

}  // namespace vex

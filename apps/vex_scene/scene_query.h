// What a scene can be asked at the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/numeric/instruction_set.h"
#include "engine/scene/scene.h"

namespace vex {

enum class SceneQuery : std::uint8_t {
  pairs,     // every pair that overlaps
  within,    // every pair within a distance, with it
  any,       // whether there is one
  clusters,  // which bodies overlaps connect
  counts,    // how many pairs overlap, and no row for any
};

constexpr std::string_view name_of(SceneQuery query) {
  switch (query) {
    case SceneQuery::pairs: return "pairs";
    case SceneQuery::within: return "within";
    case SceneQuery::any: return "any";
    case SceneQuery::clusters: return "clusters";
    case SceneQuery::counts: break;
  }
  return "counts";
}

constexpr std::string_view name_of(BroadPhase broad_phase) {
  switch (broad_phase) {
    case BroadPhase::grid: return "grid";
    case BroadPhase::tree: return "tree";
    case BroadPhase::automatic: break;
  }
  return "automatic";
}

}  // namespace vex

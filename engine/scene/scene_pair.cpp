#include "engine/scene/scene_pair.h"

#include <utility>

namespace vex {

std::string_view name_of(SceneStage stage) {
  switch (stage) {
    case SceneStage::unmoved: return "unmoved";
    case SceneStage::balls: return "balls";
    case SceneStage::joined: return "joined";
    case SceneStage::cylinders: return "cylinders";
    case SceneStage::bounds: return "bounds";
    case SceneStage::packets: return "packets";
    case SceneStage::scalar: return "scalar";
    case SceneStage::double_double: return "double_double";
    case SceneStage::exact: break;
  }
  return "exact";
}

SceneCounts& SceneCounts::operator+=(const SceneCounts& other) {
  for (std::size_t k = 0; k < stages.size(); ++k) {
    stages[k].seen += other.stages[k].seen;
    stages[k].settled += other.stages[k].settled;
  }
  return *this;
}

void SceneManifolds::resize(std::size_t n) {
  while (entries.size() > n) {
    spare_.push_back(std::move(entries.back()));
    entries.pop_back();
  }
  while (entries.size() < n && !spare_.empty()) {
    entries.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
  entries.resize(n);
}

}  // namespace vex

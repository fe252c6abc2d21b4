#include "apps/vex_scene/scene_input.h"

#include <algorithm>

#include "engine/numeric/errors.h"
#include "engine/scene/scene_pair.h"
#include "meshes/machine_memory.h"

namespace vex {
namespace {

constexpr std::size_t kOften = 1 << 16;  // bodies are read between two looks at the room

}  // namespace

std::uint32_t SceneInput::shape_of_text(std::string_view text, std::uint64_t line) {
  if (const auto found = by_text_.find(text); found != by_text_.end()) return found->second;
  if (shapes_.size() % kOften == 0) require_room();
  const auto number = static_cast<std::uint32_t>(shapes_.size());
  by_text_.emplace(std::string(text), number);
  shapes_.push_back({std::string(text), line});
  return number;
}

void SceneInput::add(std::uint32_t shape, const Transformd& pose) {
  if (poses.size() % kOften == 0) require_room();
  ++shapes_[shape].n_bodies;
  shapes_of_bodies.push_back(shape);
  poses.push_back(pose);
}

void SceneInput::require_room() const {
  constexpr std::size_t kBodiesOfShape = 4;  // of whose memory a body that is like no other takes as much
  require_room_for(poses.size() + kBodiesOfShape * shapes_.size() + 1, source_);
}

std::string SceneInput::place_of(std::size_t body) const {
  return source_ + (is_file_ ? ", line " + std::to_string(body + 2) : ", body " + std::to_string(body));
}

std::vector<std::string> SceneInput::texts() const {
  std::vector<std::string> texts;
  for (const Shape& shape : shapes_) texts.push_back(shape.text);
  return texts;
}

void require_room_for(std::uint64_t n_bodies, const std::string& source) {
  constexpr std::uint64_t kBytesOfBody = 600;  // its pose as read, in the scene, in the broad phase, and its pairs
  const std::uint64_t most = std::min<std::uint64_t>(machine_memory() / 4 * 3 / kBytesOfBody, kNoBody - 1);
  if (n_bodies <= most) return;
  throw InputError("more bodies than this machine holds (" + source + ", and " + std::to_string(most) +
                   " is the most) - divide the scene");
}

}  // namespace vex

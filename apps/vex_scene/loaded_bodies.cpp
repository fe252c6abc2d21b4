#include "apps/vex_scene/loaded_bodies.h"

#include "engine/numeric/errors.h"
#include "shapes/closest_word.h"

namespace vex {
namespace {

// What is wrong with a body of the file is told with its line, and is no wrong usage.
template <class Action>
auto naming_the_line(const SceneInput& scene, const SceneInput::Shape& shape, const Action& action,
                     const std::string& more = "") {
  if (shape.line == 0) return action();
  try {
    return action();
  } catch (const Error& error) {
    throw InputError(scene.source() + ", line " + std::to_string(shape.line) + ": " + error.what() + more);
  }
}

// A name that nothing has is taken for the path of a mesh.
std::string meant_name(const std::string& text, const SceneOptions& options) {
  std::vector<std::string> names;
  for (const auto& [name, body] : options.named_bodies) names.push_back(name);
  const std::string meant = closest_word(text, names);
  return meant.empty() ? "" : "; or did you mean " + meant + ", which --body names?";
}

// One stream, and one reader of it.
void require_standard_input_once(const SceneInput& scene, const SceneOptions& options) {
  std::size_t n_readers = options.file == "-" ? 1 : 0;
  for (const SceneInput::Shape& shape : scene.shapes()) {
    if (file_named_by(shape.text) != "-") continue;
    if (shape.line != 0) {
      throw InputError(scene.source() + ", line " + std::to_string(shape.line) +
                       ": standard input is no body of a file (" + shape.text + ") - name it with --body NAME=-");
    }
    if (++n_readers > 1) {
      throw UsageError("standard input is wanted twice (" + shape.text + ") - give the scene, or the body, as a file");
    }
  }
}

}  // namespace

BodyOptions body_options_of(const SceneOptions& options, const SceneInput& scene) {
  for (const SceneInput::Shape& shape : scene.shapes()) {
    naming_the_line(scene, shape, [&] { return names_a_mesh(shape.text); });
  }
  require_standard_input_once(scene, options);
  BodyOptions body_options = interpret_bodies(options.body_words, scene.texts());
  body_options.with_measures = false;
  return body_options;
}

std::vector<LoadedBody> load_bodies(const SceneInput& scene, const SceneOptions& options,
                                    const BodyOptions& body_options) {
  std::vector<LoadedBody> bodies;
  bodies.reserve(scene.shapes().size());
  for (const SceneInput::Shape& shape : scene.shapes()) {
    bodies.push_back(naming_the_line(
        scene, shape, [&] { return load_body(shape.text, body_options); }, meant_name(shape.text, options)));
  }
  require_one_unit(bodies, body_options);
  return bodies;
}

}  // namespace vex

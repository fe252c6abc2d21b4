// What a refused mesh is told.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/numeric/errors.h"
#include "meshes/convex_mesh.h"

namespace vex::tests {

/// The message of the InputError that `action` ends with; a failure and "" where it does not.
template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

inline std::string refusal(const PolygonSoup& soup, const MeshOptions& options = {}) {
  return refusal_of([&] { static_cast<void>(convex_mesh_from(soup, options)); });
}

inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

}  // namespace vex::tests

// Overlap backends as users name them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/query/overlap_backend.h"

namespace vex {

/// The engine's own first, then the peers of this build, and the tests made for one kind of pair.
std::vector<BackendKind> every_backend();

/// `ccd` means `ccd-mpr`. `more`: others that a program takes besides. Throws UsageError where there is no such
/// backend, or this build was made without it.
BackendKind backend_named(const std::string& word, std::vector<BackendKind> more = {});

/// Which of the two bodies the backend has no representation of, or that it has no test of the two; empty where it
/// takes the pair. `a` and `b` name them in the message, with their kinds.
struct NamedBody {
  const ConvexBody* body;
  std::string source, kind;
};
std::string why_left_out(const BackendKind& kind, const NamedBody& a, const NamedBody& b);

}  // namespace vex

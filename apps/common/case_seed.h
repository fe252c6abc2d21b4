// Seeds of the cases of one command, so that neighbours on a curve do not err alike.
#pragma once

#include <cstdint>
#include <string>

namespace vex {

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
std::uint64_t fingerprint(const std::string& text);

/// The seed of the case that this text tells, whatever other cases there are. Below 2^53, so that every reader of JSON
/// gives it back.
std::uint64_t seed_of_text(std::uint64_t seed, const std::string& text);

}  // namespace vex

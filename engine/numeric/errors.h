// What a user can cause is one of these; the message reads "problem (where, which value) - what to do".
#pragma once

#include <stdexcept>

namespace vex {

/// The root of every error that a caller's input can cause.
class Error : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The call itself is wrong: a malformed text, an option out of its range, something that is not built yet.
class UsageError : public Error {
  using Error::Error;
};

/// The call is right, but what it names cannot be used: unreadable, not convex, not finite, without extent, too large.
class InputError : public Error {
  using Error::Error;
};

}  // namespace vex

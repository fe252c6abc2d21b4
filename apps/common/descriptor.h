// An open file of the system, closed again.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace vex {

[[noreturn]] inline void fail_with(int error) { throw std::system_error(error, std::generic_category()); }

class Descriptor {
 public:
  /// Negative where there is none.
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

  /// From now on it is the caller's to close.
  int release() { return std::exchange(number_, -1); }
  /// Closes it, and takes another one.
  void take(int number) { const Descriptor before(std::exchange(number_, number)); }

  /// Some disks tell only now that they are full. Throws std::system_error.
  void close() {
    const int number = std::exchange(number_, -1);
    if (::close(number) != 0 && errno != EINTR) fail_with(errno);
  }

 private:
  int number_;
};

}  // namespace vex

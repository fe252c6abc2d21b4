// An open file of this process, closed when this is gone.
#pragma once

#include <unistd.h>

#include <utility>

namespace vex {

class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {}
  OpenFile(OpenFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }

  /// Negative where nothing could be opened.
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace vex

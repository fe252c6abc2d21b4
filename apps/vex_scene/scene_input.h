// A scene as it is given: which bodies there are, and where each one is.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/numeric/transform.h"

namespace vex {

class SceneInput {
 public:
  /// A body's text, once however many bodies have it.
  struct Shape {
    std::string text;
    std::uint64_t line = 0;  // of the file, where it stands first; 0: it is of the command line
    std::uint64_t n_bodies = 0;
  };

  /// `source`: for messages, the file or the option that gives the bodies.
  explicit SceneInput(std::string source, bool is_file = true) : source_(std::move(source)), is_file_(is_file) {}

  /// The number of the shape with this text, which is one more where it is not there yet.
  std::uint32_t shape_of_text(std::string_view text, std::uint64_t line);
  /// One more body. Throws InputError where there are more than a scene or this machine can hold.
  void add(std::uint32_t shape, const Transformd& pose);

  const std::string& source() const { return source_; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  std::size_t n_bodies() const { return shapes_of_bodies.size(); }
  /// For messages: where body k was given. Rows follow each other without empty ones between.
  std::string place_of(std::size_t body) const;
  /// The texts of all shapes.
  std::vector<std::string> texts() const;

  /// Of the file, its last line if that has no end; otherwise 0.
  std::uint64_t open_line = 0;

  /// Of body k.
  std::vector<std::uint32_t> shapes_of_bodies;
  std::vector<Transformd> poses;

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
  };

  void require_room() const;

  std::string source_;
  bool is_file_;
  std::vector<Shape> shapes_;
  std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> by_text_;
};

/// Throws InputError where a scene of so many bodies does not fit into numbers of bodies, or this machine's memory.
void require_room_for(std::uint64_t n_bodies, const std::string& source);

}  // namespace vex

// The command line of vex_scene.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"
#include "apps/vex_scene/scene_query.h"

namespace vex {

/// The words of the command line, as they stand.
struct SceneCommandLine : CommonWords, BodyWords {
  std::string file, box, random, save, query, distance, broad_phase, isa, gltf, svg;
  std::vector<std::string> named_bodies;
  bool csv = false, jsonl = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, SceneCommandLine& words);

/// --random: so many copies of a body, at this share of the space.
struct RandomScene {
  std::uint64_t n_bodies = 0;
  std::string body;  // its text
  double eta = 0.0;  // N V / L^3
};

/// How rows are written.
enum class RowFormat : std::uint8_t { csv, jsonl };

/// What the words mean.
struct SceneOptions : CommonOptions {
  std::string file;  // empty where there is a random scene
  std::optional<RandomScene> random;
  std::map<std::string, std::string, std::less<>> named_bodies;  // texts by names
  std::optional<PeriodicBox> box;                                // as given: of a random scene none
  SceneQuery query = SceneQuery::pairs;
  double distance = 0.0;
  SceneSettings settings;
  RowFormat rows = RowFormat::csv;
  bool dump_vertices = false;
  std::string save, gltf, svg;
  BodyWords body_words;  // understood once all bodies are known

  /// Of the other bodies nothing is known before the file is read.
  std::vector<std::string> bodies_of_command_line() const;
  /// counts is a report alone.
  bool has_rows() const { return query != SceneQuery::counts; }
};

/// Throws UsageError where a word means nothing; InputError where a number is out of range.
SceneOptions interpret(const SceneCommandLine& words);

}  // namespace vex

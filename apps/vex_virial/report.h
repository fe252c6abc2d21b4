// What vex_virial says: on the screen, as JSON, as a picture.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_virial/options.h"

namespace vex {

struct VirialRun {
  std::string command;
  VirialOptions options;
  std::vector<LoadedBody> bodies;    // one, or two
  VirialCoefficients found;          // of one
  std::array<MixedVirial, 4> mixed;  // of two
  bool complete = true;
  double seconds = 0.0;
};

/// An equation of state that the series is held against, by the volume fraction.
struct EquationOfState {
  std::string name;
  double (*z)(const VirialRun& run, double volume_fraction);
};
/// None of flat bodies, or where bodies are not in random orientation.
std::vector<EquationOfState> equations_of_state(const VirialRun& run);

/// Of one coefficient: what follows from its record, and the record itself, of the run that `of` describes.
nlohmann::ordered_json coefficient_json(const VirialCoefficient& found, const std::vector<std::string>& of);
nlohmann::ordered_json mixed_json(const MixedVirial& mixed, const std::vector<std::string>& of);

/// B2, or what it is in some unit, with its error where it is not as good as exact.
std::string b2_text(const VirialCoefficients& found, double in_unit);
std::string report_text(const VirialRun& run);
std::string report_json(const VirialRun& run);
std::string picture_of(const VirialRun& run);
/// The page of --report; `document_text`: the text of --json. Takes some tenths of a second.
std::string html_report(const VirialRun& run, const std::string& document_text);

}  // namespace vex

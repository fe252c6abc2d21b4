#include "apps/common/orientation_options.h"

#include <optional>

#include "engine/numeric/errors.h"
#include "engine/sampling/poses/orientation_law_text.h"

namespace vex {
namespace {

OrientationLaw law_without_axes(const OrientationWords& words) {
  const std::string both = words.orientations.empty() ? "isotropic" : words.orientations;
  if (words.orientations_a.empty() && words.orientations_b.empty())
    return parse_orientation_law(both, "--orientations");
  const auto of_body = [&both](const std::string& word, const char* option) {
    return word.empty() ? parse_axis_law(both, "--orientations") : parse_axis_law(word, option);
  };
  return OrientationLaw::each(of_body(words.orientations_a, "--orientations-a"),
                              of_body(words.orientations_b, "--orientations-b"));
}

}  // namespace

void declare_axis(OptionParser& options, std::string& word, const std::string& group) {
  options
      .add_option("--axis", word,
                  "The axis of a body that its law is about, in its own frame: x, y, z (default) or a direction X,Y,Z")
      .type_name("AXIS")
      .group(group);
}

void declare_orientations(OptionParser& options, OrientationWords& words, const std::string& group) {
  options
      .add_option(
          "--orientations", words.orientations,
          std::string("isotropic (default); aligned; fixed:W,X,Y,Z, B's quaternion in A's frame; angle:DEG, B's "
                      "axis at this angle to A's, each body spun about its own; and of each body's axis, about a "
                      "common one: ") +
              kAxisLawsHelp)
      .type_name("LAW")
      .group(group);
  options
      .add_option("--orientations-a", words.orientations_a,
                  "The law of A's axis alone, in place of that of both: isotropic, aligned, or one of an axis")
      .type_name("LAW")
      .group(group);
  options.add_option("--orientations-b", words.orientations_b, "The law of B's axis alone")
      .type_name("LAW")
      .group(group);
  declare_axis(options, words.axis, group);
  options.add_option("--axis-a", words.axis_a, "The axis of A alone").type_name("AXIS").group(group);
  options.add_option("--axis-b", words.axis_b, "The axis of B alone").type_name("AXIS").group(group);
}

OrientationLaw interpret_orientations(const OrientationWords& words) {
  const OrientationLaw law = law_without_axes(words);
  if (words.axis.empty() && words.axis_a.empty() && words.axis_b.empty()) return law;
  const auto axis = [&words](const std::string& word, const char* option) -> Vec3d {
    if (!word.empty()) return parse_axis(word, option);
    return words.axis.empty() ? Vec3d{0.0, 0.0, 1.0} : parse_axis(words.axis, "--axis");
  };
  return law.about(axis(words.axis_a, "--axis-a"), axis(words.axis_b, "--axis-b"));
}

OrientationLaw law_of_bodies(const std::string& word, const std::string& axis, const std::string& also) {
  const std::string choices =
      "isotropic, aligned, cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE" + (also.empty() ? "" : ", " + also);
  const OrientationLaw law = word.empty() ? OrientationLaw() : parse_orientation_law(word, "--orientations", choices);
  if (axis.empty()) return law;
  const Vec3d own = parse_axis(axis, "--axis");
  return law.about(own, own);
}

std::vector<std::string> files_of_laws(const OrientationWords& words) {
  std::vector<std::string> files;
  for (const std::string* const word : {&words.orientations, &words.orientations_a, &words.orientations_b}) {
    if (const std::optional<std::string> file = file_of_law(*word); file && !file->empty()) files.push_back(*file);
  }
  return files;
}

}  // namespace vex

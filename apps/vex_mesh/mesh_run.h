// One pair, loaded, run and compared: what vex_mesh does once, and vex_scan for each of its cases.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_mesh/options.h"
#include "shapes/estimators/excluded_volume.h"

namespace vex {

/// All that is reported.
struct MeshRun {
  std::string command;
  Options options;
  LoadedBody a, b;
  std::vector<LoadedBody> control_bodies{};  // of a control variate: of both, or one for each
  std::vector<std::string> left_out{};       // of a cross-check: why a backend does not take part
  ExcludedVolume result{};
};

/// With the bodies of a control variate, and without the backends that cannot check the pair. Throws UsageError where
/// the backend that was asked for cannot answer it, or where vertices are asked for and there are none.
MeshRun prepare_run(Options options, std::pair<LoadedBody, LoadedBody> loaded, std::string command);

/// Fills `result`, until the stop rule or an interrupt ends it. `label` stands before the progress bar; the run saves
/// itself in the checkpoint, if there is one, and tells its progress.
void sample(
    MeshRun& run, const std::string& label = "", Checkpoint* checkpoint = nullptr,
    const std::function<void(const Progress&)>& on_progress = [](const Progress&) {});

/// What the result says: kFault where a verdict of the engine's own could not be proven again, kDisagreement, or
/// kSuccess.
int exit_code_of(const MeshRun& run);

}  // namespace vex

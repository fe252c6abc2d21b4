#include "apps/vex_mesh/mesh_run.h"

#include <algorithm>
#include <cmath>

#include "apps/common/backends.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/run_program.h"
#include "apps/vex_mesh/run_identity.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string why_pair_left_out(const BackendKind& kind, const MeshRun& run) {
  return why_left_out(kind, {&run.a.shape.body, run.a.source, run.a.shape.kind},
                      {&run.b.shape.body, run.b.source, run.b.shape.kind});
}

void choose_backends(MeshRun& run) {
  if (const std::string reason = why_pair_left_out(run.options.settings.backend, run); !reason.empty()) {
    throw UsageError(reason + " - use another --backend");
  }
  std::erase_if(run.options.settings.cross_check, [&run](const BackendKind& kind) {
    const std::string reason = why_pair_left_out(kind, run);
    if (!reason.empty()) run.left_out.push_back(reason);
    return !reason.empty();
  });
}

}  // namespace

MeshRun prepare_run(Options options, std::pair<LoadedBody, LoadedBody> loaded, std::string command) {
  MeshRun run{std::move(command), std::move(options), std::move(loaded.first), std::move(loaded.second)};
  if (const std::vector<std::string>& simpler = run.options.control_variate; !simpler.empty()) {
    auto [like_a, like_b] = load_two_bodies(simpler.front(), simpler.back(), run.options.bodies);
    run.control_bodies = {std::move(like_a), std::move(like_b)};
  }
  if (run.options.dump_vertices) require_vertices_to_list(run.a, run.b);
  choose_backends(run);
  return run;
}

void sample(MeshRun& run, const std::string& label, Checkpoint* checkpoint,
            const std::function<void(const Progress&)>& on_progress) {
  ExcludedVolumeSettings& settings = run.options.settings;
  for (const LoadedBody& simpler : run.control_bodies) settings.control_variate.push_back(simpler.shape);
  settings.interrupt = &interrupting_signal();
  ProgressBar bar(!run.options.quiet, label);
  settings.on_progress = [&](const Progress& progress) {
    bar.show(progress);
    on_progress(progress);
  };
  if (checkpoint != nullptr) {
    settings.on_state = [&](const RunState& state) {
      checkpoint->save(checkpoint_text(run, state), [&bar] { bar.erase(); });
    };
  }
  run.result = excluded_volume(run.a.shape, run.b.shape, settings);
  settings.on_progress = nullptr;  // the bar is gone, and so is all else that the run called or went on from
  settings.on_state = nullptr;
  settings.resume = nullptr;
}

int exit_code_of(const MeshRun& run) {
  // A peer's verdict that has no proof is the peer's fault, and reported as such.
  if (run.result.record.unproven.n_all > 0 && !run.options.settings.backend.is_peer) return kFault;
  return run.result.z && std::fabs(*run.result.z) > run.options.max_z ? kDisagreement : kSuccess;
}

}  // namespace vex

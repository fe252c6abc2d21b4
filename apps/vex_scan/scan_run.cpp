#include "apps/vex_scan/scan_run.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>

#include "apps/common/interrupt.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

/// The bodies of the last case, which are often the next one's.
class PairLoader {
 public:
  const std::pair<LoadedBody, LoadedBody>& load(const Options& options, const CommandLine& words) {
    std::string key = options.a + "\n" + options.b + "\n";
    for (const std::string* const word : {&words.convex_tolerance, &words.weld, &words.unit, &words.format,
                                          &words.scale, &words.scale_a, &words.scale_b}) {
      key += *word + "\n";
    }
    if (!pair_ || key != key_) {
      pair_.reset();
      pair_ = load_two_bodies(options.a, options.b, options.bodies);
      key_ = key;
    }
    return *pair_;
  }

 private:
  std::string key_;
  std::optional<std::pair<LoadedBody, LoadedBody>> pair_;
};

std::string name_of_case(const ScanCase& one, const Scan& scan) {
  std::string text = one.a() == one.b() ? one.a() : one.a() + " " + one.b();
  for (std::size_t k = 0; k < scan.variables.size(); ++k) {
    text += (k == 0 ? " with " : ", ") + scan.variables[k].name + " = " + one.values[k];
  }
  return text;
}

class ScanLoop {
 public:
  ScanLoop(ScanRun& run, const std::map<std::string, ScanRow>& earlier) : run_(run), earlier_(earlier) {}

  /// Nothing where an interrupt ended it.
  std::optional<ScanRow> row_of_case(std::size_t index) {
    const ScanCase one = case_of(run_.scan, index);
    try {
      const Options options = options_of(one);
      MeshRun run = prepare_run(options, loader_.load(options, one.words), run_.command);
      const std::string input = input_of(one, run);
      if (const auto kept = earlier_.find(input); kept != earlier_.end()) {
        ++run_.n_kept;
        ScanRow row = kept->second;
        row.values = one.values;
        if (std::fabs(row.z) > run_.options.max_z) run_.has_disagreement = true;
        return row;
      }
      sample(run,
             std::to_string(index + 1) + "/" + std::to_string(run_.scan.n_cases()) + " " + printable(one.a()) + " ");
      if (run.result.record.stopped_by == StopReason::interrupted) return std::nullopt;
      const int code = exit_code_of(run);
      if (code == kFault) run_.has_fault = true;
      if (code == kDisagreement) run_.has_disagreement = true;
      ScanRow row = row_of(one, run);
      row.input = input;
      return row;
    } catch (const Error& error) {
      return refused(one, error.what());
    } catch (const std::bad_alloc&) {
      return refused(one, "the input is too large for this machine's memory - give a smaller one");
    }
  }

 private:
  ScanRow refused(const ScanCase& one, const std::string& why) {
    ++run_.n_refused;
    std::fprintf(stderr, "vex_scan: %s\n", printable(name_of_case(one, run_.scan) + ": " + why).c_str());
    return refused_row(one, why);
  }

  ScanRun& run_;
  const std::map<std::string, ScanRow>& earlier_;
  PairLoader loader_;
};

}  // namespace

void require_a_case_that_means_something(const Scan& scan) {
  std::optional<UsageError> first;
  for (std::size_t index = 0; index < scan.n_cases(); ++index) {
    const ScanCase one = case_of(scan, index);
    try {
      const Options options = options_of(one);
      for (const auto& [text, of_body] :
           {std::pair{options.a, options.bodies.of_a()}, std::pair{options.b, options.bodies.of_b()}}) {
        if (!names_a_mesh(text)) load_body(text, of_body);
      }
      return;
    } catch (const UsageError& error) {
      if (!first) first = error;
    } catch (const InputError&) {
      return;
    }
  }
  if (first) throw UsageError(*first);
}

void run_scan(ScanRun& run, const std::map<std::string, ScanRow>& earlier, const std::function<void()>& on_row) {
  const auto start = std::chrono::steady_clock::now();
  ScanLoop loop(run, earlier);
  for (std::size_t index = 0; index < run.scan.n_cases() && run.complete; ++index) {
    on_row();
    std::optional<ScanRow> row;
    if (interrupting_signal() == 0) row = loop.row_of_case(index);
    if (row) {
      run.rows.push_back(std::move(*row));
    } else {
      run.complete = false;
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace vex

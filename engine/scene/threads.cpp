#include "engine/scene/threads.h"

#include <mutex>

namespace vex {
namespace {

struct Worst {
  std::mutex mutex;
  std::optional<ThreadShortage> shortage;
};

Worst& worst() {
  static Worst of_the_process;
  return of_the_process;
}

}  // namespace

std::optional<ThreadShortage> thread_shortage() {
  const std::lock_guard lock(worst().mutex);
  return worst().shortage;
}

void note_threads(int n_wanted, int n_had) {
  if (n_had >= n_wanted) return;
  const std::lock_guard lock(worst().mutex);
  std::optional<ThreadShortage>& shortage = worst().shortage;
  if (!shortage || n_had < shortage->n_had) shortage = ThreadShortage{n_wanted, n_had};
}

}  // namespace vex

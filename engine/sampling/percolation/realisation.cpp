#include "engine/sampling/percolation/realisation.h"

#include <atomic>
#include <limits>
#include <mutex>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// Bodies that are placed before their pairs are looked for: few, so that pairs of one cluster are known to be such, and
// enough to fill packets.
std::uint32_t batch_after(std::uint32_t n_bodies) { return std::clamp<std::uint32_t>(n_bodies / 32, 16, 512); }

std::vector<ShapeId> add_shapes(const Placements& placements, Scene& scene) {
  std::vector<ShapeId> shapes;
  for (const BodyPart& part : placements.parts()) shapes.push_back(scene.add_shape(part.body));
  return shapes;
}

SceneSettings scene_settings(const PercolationSystem& system) {
  SceneSettings settings;
  settings.instruction_set = system.instruction_set;
  return settings;
}

constexpr std::uint32_t kNotYet = std::numeric_limits<std::uint32_t>::max();

}  // namespace

PercolationCounts& PercolationCounts::operator+=(const PercolationCounts& other) {
  n_bodies += other.n_bodies;
  n_undecided += other.n_undecided;
  stages += other.stages;
  return *this;
}

Realisation::Realisation(const PercolationSystem& system)
    : system_(system),
      scene_(PeriodicBox::cube(system.edge), scene_settings(system)),
      shapes_(add_shapes(system.placements, scene_)) {
  if (system.usual_bodies > 0) scene_.expect(system.usual_bodies);
  if (system.size >= kMostSizes) throw UsageError("there are more than 64 sizes - give fewer");
  if (!system.backend) return;
  for (ShapeId a = 0; a < scene_.n_shapes(); ++a) {
    for (ShapeId b = 0; b < scene_.n_shapes(); ++b) {
      backends_.push_back(system.backend->make(scene_.shape(a), scene_.shape(b)));
    }
  }
  judge_ = [this](ShapeId a, ShapeId b, const Transformd& pose) { return ask_backend(a, b, pose); };
}

void Realisation::begin() {
  scene_.clear();
  clusters_.reset(0);
  news_.clear();
  counts_ = {};
}

void Realisation::place(std::uint32_t realisation, std::uint32_t n) {
  for (; n > 0; --n) {
    const Placements::Placed placed = system_.placements({system_.size, realisation}, scene_.end(), system_.edge);
    scene_.add(shapes_[placed.part], Pose::unchecked(placed.world_from_body));
    clusters_.add();
    ++counts_.n_bodies;
  }
}

Outcome Realisation::ask_backend(ShapeId a, ShapeId b, const Transformd& a_from_b) {
  return backends_[a * scene_.n_shapes() + b]->decide(Pose::unchecked(a_from_b)).outcome;
}

void Realisation::note_wrapping(const ScenePair& pair, WrappingNumbers& numbers) {
  const std::array<bool, 3> wraps = clusters_.wraps(pair.b);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (wraps[axis] && numbers.along[axis] == kNotYet) numbers.along[axis] = pair.b + 1;
  }
}

void Realisation::ask_pairs(BodyId first, Clusters* joined) {
  scene_.overlaps_of_added(first, pairs_, joined, judge_ ? &judge_ : nullptr);
}

// Pairs in the order of the bodies that brought them, none left out.
void Realisation::join_in_order(BodyId first, WrappingNumbers& numbers) {
  ask_pairs(first, nullptr);
  counts_.stages += pairs_.counts;
  std::sort(pairs_.pairs.begin(), pairs_.pairs.end(),
            [](const ScenePair& x, const ScenePair& y) { return x.b != y.b ? x.b < y.b : x < y; });
  for (const ScenePair& pair : pairs_.pairs) {
    if (clusters_.join(pair.a, pair.b, pair.image) == Clusters::Joined::wrapped) note_wrapping(pair, numbers);
  }
}

// Until a cluster wraps the order of pairs does not matter: what one of them joins another need not. In the batch that
// first brings a wrap it does, and from there on; so that batch is done once more, from the clusters before it, which
// are made of what had changed them.
std::optional<WrappingNumbers> Realisation::run(std::uint32_t realisation, const StopQuestion& stop) {
  if (realisation >= kMostRealisations)
    throw UsageError("there are more than 2^26 realisations of a size - give fewer");
  begin();
  WrappingNumbers numbers{{kNotYet, kNotYet, kNotYet}};
  bool has_wrapped = false;
  while (numbers.all() == kNotYet) {
    const std::uint32_t first = scene_.end();
    if (first >= system_.most_bodies) {
      throw UsageError("no cluster wraps around the cube along all three axes, though " + std::to_string(first) +
                       " bodies are in it, many times as many as a threshold should need - give bodies that overlap, " +
                       "or smaller cubes");
    }
    if (stop && stop()) return std::nullopt;
    place(realisation, batch_after(first));
    if (!has_wrapped) {
      ask_pairs(first, &clusters_);
      counts_.stages += pairs_.counts;
      has_wrapped = clusters_.any_wraps();
      if (has_wrapped) {
        clusters_.reset(scene_.end());
        for (const ScenePair& pair : news_) clusters_.join(pair.a, pair.b, pair.image);
      } else {
        news_.insert(news_.end(), pairs_.pairs.begin(), pairs_.pairs.end());
      }
    }
    if (has_wrapped) join_in_order(first, numbers);
    for (const ScenePair& pair : pairs_.undecided) {
      if (clusters_.would_change(pair.a, pair.b, pair.image)) ++counts_.n_undecided;
    }
  }
  return numbers;
}

void Realisation::place_and_join(std::uint32_t realisation, std::uint32_t n) {
  begin();
  place(realisation, n);
  ask_pairs(0, &clusters_);
}

void run_realisations(const PercolationSystem& system, std::uint32_t first, std::uint32_t n, int n_threads,
                      const OnRealisations& on_finished, const StopQuestion& stop) {
  if (n_threads < 1) {
    throw UsageError("no number of threads (" + std::to_string(n_threads) + ") - give one at least");
  }
  if (first > kMostRealisations || n > kMostRealisations - first) {
    throw UsageError("there are more than 2^26 realisations of a size - give fewer");
  }
  struct Finished {
    WrappingNumbers numbers;
    PercolationCounts counts;
  };
  std::vector<std::optional<Finished>> found(n);
  std::atomic<std::uint32_t> next{0};
  std::mutex mutex;
  std::uint32_t n_told = 0;
  on_threads(n_threads, [&](int) {
    Realisation realisation(system);
    for (std::uint32_t k = next++; k < n; k = next++) {
      const std::optional<WrappingNumbers> numbers = realisation.run(first + k, stop);
      if (!numbers) break;
      const std::lock_guard lock(mutex);
      found[k] = Finished{*numbers, realisation.counts()};
      std::vector<WrappingNumbers> finished;
      PercolationCounts counts;
      for (; n_told < n && found[n_told]; ++n_told) {
        finished.push_back(found[n_told]->numbers);
        counts += found[n_told]->counts;
      }
      if (!finished.empty()) on_finished(finished, counts);
    }
  });
}

std::vector<WrappingNumbers> run_realisations(const PercolationSystem& system, std::uint32_t first, std::uint32_t n,
                                              int n_threads, PercolationCounts& counts, const StopQuestion& stop) {
  std::vector<WrappingNumbers> numbers;
  const OnRealisations append = [&](std::span<const WrappingNumbers> finished, const PercolationCounts& theirs) {
    numbers.insert(numbers.end(), finished.begin(), finished.end());
    counts += theirs;
  };
  run_realisations(system, first, n, n_threads, append, stop);
  return numbers;
}

}  // namespace vex

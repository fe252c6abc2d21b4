#include "engine/sampling/percolation/realisation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/sampling/percolation/realisation_ranks.h"
#include "engine/sampling/ranks.h"
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

// Bodies of one size are best in a grid, whatever they are, as those that come one at a time are; what is chosen anew
// for each realisation would be the same.
SceneSettings scene_settings(const PercolationSystem& system) {
  double smallest = HUGE_VAL, largest = 0.0;
  for (const BodyPart& part : system.placements.parts()) {
    smallest = std::fmin(smallest, part.body.circumradius());
    largest = std::fmax(largest, part.body.circumradius());
  }
  SceneSettings settings;
  settings.instruction_set = system.instruction_set;
  settings.broad_phase = largest <= 2.0 * smallest ? BroadPhase::grid : BroadPhase::tree;
  return settings;
}

constexpr std::uint32_t kNotYet = std::numeric_limits<std::uint32_t>::max();

// Of best_at_once: the cube's edge, in extents of the largest body, and how many realisations of it.
constexpr double kSmall = 4.0, kLarge = 10.0;
constexpr std::uint32_t kSmallRealisations = 24;

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
  counts_.n_bodies += n;
  clusters_.add(n);
  const std::vector<std::uint32_t>& part = placed_.part;
  for (std::uint32_t left = n; left > 0; left -= static_cast<std::uint32_t>(part.size())) {
    system_.placements.many({system_.size, realisation}, scene_.end(), std::min(left, Placements::kAtOnce),
                            system_.edge, system_.instruction_set, placed_);
    // Those of one kind that follow each other are added together.
    for (auto begin = part.begin(), end = begin; begin != part.end(); begin = end) {
      end = std::find_if(begin, part.end(), [of = *begin](std::uint32_t one) { return one != of; });
      scene_.add(shapes_[*begin],
                 std::span(placed_.world_from_body)
                     .subspan(static_cast<std::size_t>(begin - part.begin()), static_cast<std::size_t>(end - begin)));
    }
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
  counts_.stages += pairs_.counts;
}

// None left out, and in the order of the bodies that brought them.
void Realisation::ask_and_join_in_order(BodyId first, WrappingNumbers& numbers) {
  ask_pairs(first, nullptr);
  for (const ScenePair& pair : pairs_.pairs) {
    if (clusters_.join(pair.a, pair.b, pair.image) == Clusters::Joined::wrapped) note_wrapping(pair, numbers);
  }
}

// Most bodies may come at once. In a batch, until a cluster wraps, the order of pairs does not matter: what one of them
// joins another need not. In the batch that first brings a wrap it does, and from there on; so that batch is done once
// more, from the clusters before it, which are made of what had changed them.
std::optional<WrappingNumbers> Realisation::run(std::uint32_t realisation, const StopQuestion& stop) {
  if (realisation >= kMostRealisations)
    throw UsageError("there are more than 2^26 realisations of a size - give fewer");
  begin();
  WrappingNumbers numbers{{kNotYet, kNotYet, kNotYet}};
  bool has_wrapped = false;
  const auto refuse = [this] {
    throw UsageError("no cluster wraps around the cube along all three axes with " +
                     std::to_string(system_.most_bodies) +
                     " bodies in it, many times as many as a threshold should need - give bodies that overlap, or " +
                     "smaller cubes");
  };
  while (numbers.all() == kNotYet) {
    const std::uint32_t first = scene_.end();
    if (first >= system_.most_bodies) refuse();
    if (stop && stop()) return std::nullopt;
    const bool is_at_once = first == 0 && system_.at_once > 0;
    place(realisation, is_at_once ? system_.at_once : batch_after(first));
    bool is_in_order = is_at_once || has_wrapped;
    if (!is_in_order) {
      ask_pairs(first, &clusters_);
      is_in_order = clusters_.any_wraps();
      if (is_in_order) {
        clusters_.reset(scene_.end());
        for (const ScenePair& pair : news_) clusters_.join(pair.a, pair.b, pair.image);
      }
    }
    if (is_in_order) ask_and_join_in_order(first, numbers);
    has_wrapped = clusters_.any_wraps();
    if (!has_wrapped) news_.insert(news_.end(), pairs_.pairs.begin(), pairs_.pairs.end());
    for (const ScenePair& pair : pairs_.undecided) {
      if (pair.b < numbers.all() && clusters_.would_change(pair.a, pair.b, pair.image)) ++counts_.n_undecided;
    }
  }
  if (numbers.all() > system_.most_bodies) refuse();
  return numbers;
}

// The densities at which clusters first wrap, along any axis and along all, scatter about the threshold, and the second
// is above it, by what shrinks as the size to the power of -1/nu (decision 0019).
std::uint32_t best_at_once(const PercolationSystem& system) {
  constexpr double kOneByNu = 1.141, kErrorsAbove = 2.2, kWorthIt = 256.0;
  double extent = 0.0;
  for (const BodyPart& part : system.placements.parts()) extent = std::fmax(extent, 2.0 * part.body.circumradius());
  if (system.backend || !(system.edge >= kLarge * extent)) return 0;
  const double scale = system.edge / (kSmall * extent), volumes = scale * scale * scale;
  PercolationSystem small = system;
  small.edge = kSmall * extent;
  small.usual_bodies = static_cast<std::uint32_t>(system.usual_bodies / volumes);
  small.at_once = 0;
  Realisation realisation(small);
  double any = 0.0, all = 0.0, square = 0.0;  // means
  for (std::uint32_t k = 0; k < kSmallRealisations; ++k) {
    const std::optional<WrappingNumbers> numbers = realisation.run(k);
    const double of_all = numbers->all();
    any += numbers->any() / double{kSmallRealisations};
    all += of_all / double{kSmallRealisations};
    square += of_all * of_all / double{kSmallRealisations};
  }
  const double scatter = std::sqrt(std::fmax(square - all * all, 0.0)), less = std::pow(scale, -kOneByNu),
               last = volumes * (any + (all - any + kErrorsAbove * scatter) * less);
  return last >= kWorthIt && last <= 0.5 * system.most_bodies ? static_cast<std::uint32_t>(last) : 0;
}

void Realisation::place_and_join(std::uint32_t realisation, std::uint32_t n) {
  begin();
  place(realisation, n);
  ask_pairs(0, &clusters_);
}

namespace {

// Realisations of one size, given out one after another to the threads, and in blocks to other ranks.
class RealisationsOfSize {
 public:
  RealisationsOfSize(const PercolationSystem& system, std::uint32_t first, std::uint32_t n, int n_threads,
                     const OnRealisations& on_finished, const StopQuestion& stop, Ranks* ranks)
      : system_(system),
        first_(first),
        n_(n),
        n_threads_(n_threads),
        on_finished_(on_finished),
        stop_(stop),
        ranks_(ranks),
        found_(n) {}

  void go() {
    if (ranks_ == nullptr) {
      on_threads(n_threads_, [this](int) { make(); });
      return;
    }
    on_threads(n_threads_ + 1, [this](int k) {
      if (k > 0) {
        make();
      } else {
        serve();
      }
    });
  }

 private:
  struct Finished {
    WrappingNumbers numbers;
    PercolationCounts counts;
  };

  // The next ones that nobody has, up to `most`: how many, from which on.
  std::pair<std::uint32_t, std::uint32_t> take(std::uint64_t most) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t begin = next_;
    next_ += static_cast<std::uint32_t>(std::min<std::uint64_t>(most, n_ - next_));
    return {begin, next_ - begin};
  }

  void make() {
    Realisation realisation(system_);
    while (true) {
      const auto [k, n] = take(1);
      if (n == 0) return;
      const std::optional<WrappingNumbers> numbers = realisation.run(first_ + k, stop_);
      if (!numbers) return;
      const std::lock_guard lock(mutex_);
      found_[k] = Finished{*numbers, realisation.counts()};
      tell();
    }
  }

  // With the lock held: what has no gap before it any more.
  void tell() {
    std::vector<WrappingNumbers> finished;
    PercolationCounts counts;
    for (; n_told_ < n_ && found_[n_told_]; ++n_told_) {
      finished.push_back(found_[n_told_]->numbers);
      counts += found_[n_told_]->counts;
    }
    if (!finished.empty()) on_finished_(finished, counts);
  }

  void serve() {
    constexpr auto kBetween = std::chrono::milliseconds(1);
    const Ranks::Desk desk{[this](std::uint64_t most) { return give(most); },
                           [this](std::string_view done) { bring(read_made(done)); }};
    while (true) {
      ranks_->serve(desk);
      {
        const std::lock_guard lock(mutex_);
        if (n_told_ == n_) return;
      }
      if (stop_ && stop_()) return;
      std::this_thread::sleep_for(kBetween);
    }
  }

  // A small part of what is left: who has the last ones is waited for.
  std::optional<Ranks::Block> give(std::uint64_t most) {
    const std::uint64_t n_left = n_ - std::min(n_, next_now());
    const std::uint64_t part = n_left / (2 * static_cast<std::uint64_t>(ranks_->n_ranks())) + 1;
    const auto [k, n] = take(std::min(most, part));
    if (n == 0) return std::nullopt;
    const std::uint64_t begin = number_of_realisation(system_.size, first_ + k);
    return Ranks::Block{begin, begin + n};
  }
  std::uint32_t next_now() {
    const std::lock_guard lock(mutex_);
    return next_;
  }

  void bring(MadeRealisations&& made) {
    const std::lock_guard lock(mutex_);
    if (made.size != system_.size || made.first < first_ || made.first - first_ > n_ ||
        made.numbers.size() > n_ - (made.first - first_)) {
      throw InputError("another rank hands in realisations that it was not given - give all ranks the same version");
    }
    for (std::size_t k = 0; k < made.numbers.size(); ++k) {
      found_[made.first - first_ + k] = Finished{made.numbers[k], k == 0 ? made.counts : PercolationCounts{}};
    }
    tell();
  }

  const PercolationSystem& system_;
  const std::uint32_t first_, n_;
  const int n_threads_;
  const OnRealisations& on_finished_;
  const StopQuestion& stop_;
  Ranks* const ranks_;
  std::mutex mutex_;  // guards all below
  std::uint32_t next_ = 0, n_told_ = 0;
  std::vector<std::optional<Finished>> found_;
};

}  // namespace

void run_realisations(const PercolationSystem& system, std::uint32_t first, std::uint32_t n, int n_threads,
                      const OnRealisations& on_finished, const StopQuestion& stop, Ranks* ranks) {
  if (n_threads < 1) {
    throw UsageError("no number of threads (" + std::to_string(n_threads) + ") - give one at least");
  }
  if (first > kMostRealisations || n > kMostRealisations - first) {
    throw UsageError("there are more than 2^26 realisations of a size - give fewer");
  }
  RealisationsOfSize(system, first, n, n_threads, on_finished, stop, ranks).go();
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

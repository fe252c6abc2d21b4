// Percolation of overlapping bodies: realisations, and what follows from them.
#include <pybind11/stl.h>

#include <cmath>
#include <thread>

#include "engine/sampling/percolation/crossing.h"
#include "engine/sampling/percolation/extrapolation.h"
#include "engine/sampling/percolation/isotropy.h"
#include "engine/sampling/percolation/realisation.h"
#include "engine/sampling/percolation/threshold.h"
#include "python/bindings/body.h"

namespace vex::python {
namespace {

using Numbers = py::array_t<std::uint32_t, py::array::c_style>;

/// One size of the periodic cube.
class PySystem {
 public:
  PySystem(const std::vector<std::pair<const PyBody*, double>>& parts, const OrientationLaw& law, std::uint64_t seed,
           bool uniform_angle, double edge, std::uint32_t size, double usual_bodies)
      : system_{Placements(parts_of(parts), {law, uniform_angle}, seed), edge, size} {
    if (!(edge > 0.0) || !std::isfinite(edge)) throw UsageError("an edge is a finite length above 0");
    if (!(usual_bodies <= kMostBodies)) {
      throw InputError("a cube of " + std::to_string(edge) + " holds too many bodies - give a smaller size");
    }
    system_.most_bodies = static_cast<std::uint32_t>(std::fmin(1e9, 1000.0 + kMoreThanUsual * usual_bodies));
    system_.usual_bodies = static_cast<std::uint32_t>(usual_bodies);
    system_.at_once = best_at_once(system_);
  }

  bool isotropic() const { return is_isotropic(system_.placements); }

  /// Realisations first ... first + n - 1: with how many bodies a cluster wrapped along x, y and z (n, 3); and how many
  /// pairs are undecided.
  py::tuple run(std::uint32_t first, std::uint32_t n, int threads) {
    PercolationCounts counts;
    std::vector<WrappingNumbers> found;
    SignalWatch watch;
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> is_stopped{false};
    const StopQuestion stop = [&] {
      if (std::this_thread::get_id() == caller && watch.has_thrown()) is_stopped = true;
      return is_stopped.load();
    };
    {
      const WithoutGil without_gil;
      found = run_realisations(system_, first, n, number_of_threads(threads), counts, stop);
      watch.rethrow();
    }
    Numbers numbers({static_cast<py::ssize_t>(found.size()), py::ssize_t{3}});
    std::uint32_t* to = numbers.mutable_data();
    for (const WrappingNumbers& wraps : found) {
      for (const std::uint32_t along : wraps.along) *to++ = along;
    }
    return py::make_tuple(numbers, counts.n_undecided);
  }

 private:
  static constexpr double kMostBodies = 5e7, kMoreThanUsual = 20.0;

  static std::vector<BodyPart> parts_of(const std::vector<std::pair<const PyBody*, double>>& parts) {
    std::vector<BodyPart> result;
    for (const auto& [body, fraction] : parts) result.push_back({body->body.body, fraction});
    return result;
  }

  PercolationSystem system_;
};

std::vector<WrappingNumbers> wrapping_numbers(const Numbers& numbers) {
  if (numbers.ndim() != 2 || numbers.shape(1) != 3) throw UsageError("not an array (N, 3) of numbers of bodies");
  std::vector<WrappingNumbers> result(static_cast<std::size_t>(numbers.shape(0)));
  const std::uint32_t* from = numbers.data();
  for (WrappingNumbers& wraps : result) {
    for (std::uint32_t& along : wraps.along) {
      along = *from++;
      if (along == 0) throw UsageError("a cluster of no bodies does not wrap - give numbers from 1 on");
    }
  }
  return result;
}

py::dict dict_of(const Extrapolation& found) {
  py::dict result;
  result["density"] = found.density;
  result["std_error"] = found.std_error;
  result["scatter_error"] = found.scatter_error;
  result["offset_error"] = found.offset_error;
  result["universal_error"] = found.universal_error;
  result["p_value"] = found.p_value;
  result["without_smallest"] = found.without_smallest;
  return result;
}

/// Of sizes, edges and realisations: number densities at the threshold of each size by each criterion, and of infinite
/// space; by universal probabilities where the system is isotropic, else by where the sizes' own cross.
py::tuple percolation_threshold(bool isotropic, const std::vector<double>& sizes, const std::vector<double>& edges,
                                const std::vector<Numbers>& numbers) {
  if (edges.size() != numbers.size() || sizes.size() != edges.size() || sizes.empty()) {
    throw UsageError("not as many sizes as arrays of realisations");
  }
  std::vector<std::vector<WrappingNumbers>> all;
  for (const Numbers& of_size : numbers) all.push_back(wrapping_numbers(of_size));
  const auto volume = [&edges](std::size_t k) { return edges[k] * edges[k] * edges[k]; };
  py::list rows;
  if (!isotropic) {
    std::vector<SizedRealisations> sized;
    for (std::size_t k = 0; k < sizes.size(); ++k) sized.push_back({sizes[k], volume(k), all[k]});
    const Crossing crossing = find_crossing(sized);
    for (const Crossing::OfSize& of_size : crossing.sizes) {
      py::dict row;
      for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
        row[py::str(std::string(name_of_crossing_criterion(c)))] =
            py::make_tuple(of_size.density[c], of_size.std_error[c]);
      }
      rows.append(row);
    }
    return py::make_tuple(rows, dict_of(crossing.threshold));
  }
  std::vector<SizedThreshold> thresholds;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    thresholds.push_back(sized_threshold(size_threshold(all[k]), sizes[k], volume(k)));
    py::dict row;
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      if (!(thresholds.back().covariance[c][c] > 0.0)) {
        throw UsageError("too few realisations to tell their scatter - make more");
      }
      row[py::str(std::string(name_of(static_cast<WrappingCriterion>(c))))] =
          py::make_tuple(thresholds.back().density[c], std::sqrt(thresholds.back().covariance[c][c]));
    }
    rows.append(row);
  }
  return py::make_tuple(rows, dict_of(extrapolate(thresholds)));
}

}  // namespace

void bind_percolation(py::module_& module) {
  py::class_<PySystem>(module, "PercolationSystem", "Bodies placed in a periodic cube of one size.")
      .def(py::init<const std::vector<std::pair<const PyBody*, double>>&, const OrientationLaw&, std::uint64_t, bool,
                    double, std::uint32_t, double>(),
           py::arg("parts"), py::arg("law"), py::arg("seed"), py::arg("uniform_angle"), py::arg("edge"),
           py::arg("size"), py::arg("usual_bodies"))
      .def_property_readonly("is_isotropic", &PySystem::isotropic)
      .def("run", &PySystem::run, py::arg("first"), py::arg("n"), py::arg("threads"));
  module.attr("fewest_realisations") = kFewestRealisations;
  module.def("percolation_threshold", &percolation_threshold, py::arg("isotropic"), py::arg("sizes"), py::arg("edges"),
             py::arg("numbers"));
}

}  // namespace vex::python

// Answers that are proven again, row by row.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/query/certificate.h"
#include "python/bindings/arrays.h"

namespace vex::python {

/// Whether each answer was proven again by the checker, and what is missing where it was not; where that was asked for.
class Proofs {
 public:
  Proofs(bool wanted, std::size_t n) : is_wanted_(wanted), checks_(wanted ? n : 0) {}

  bool is_wanted() const { return is_wanted_; }
  void set(std::size_t k, CertificateCheck check) { checks_[k] = std::move(check); }
  /// None; or an array of truth values, and the faults.
  py::object arrays() const {
    if (!is_wanted_) return py::none();
    py::array_t<bool> is_proven(static_cast<py::ssize_t>(checks_.size()));
    py::list faults;
    for (std::size_t k = 0; k < checks_.size(); ++k) {
      is_proven.mutable_data()[k] = checks_[k].is_proven;
      faults.append(checks_[k].fault);
    }
    return py::make_tuple(is_proven, faults);
  }

 private:
  bool is_wanted_;
  std::vector<CertificateCheck> checks_;
};

}  // namespace vex::python

#include <cmath>
#include <memory>
#include <utility>

#include "python/bindings/body.h"

namespace vex::python {
namespace {

/// Shared by copies of the body, on any thread; its last holder may not hold the GIL.
std::shared_ptr<const py::function> shared_function(py::function function) {
  return {new py::function(std::move(function)), [](const py::function* held) {
            if (Py_IsInitialized() == 0) return;  // the interpreter has ended, and with it the function
            const WithGil with_gil;
            delete held;
          }};
}

class CallableSupport {
 public:
  CallableSupport(py::function support, double support_error, const Vec3d& centre, double circumradius, double inradius)
      : function_(shared_function(std::move(support))),
        centre_(centre),
        support_error_(support_error),
        circumradius_(circumradius),
        inradius_(inradius) {}

  Vec3d support(const Vec3d& dir) const {
    end_if_interrupted();
    const WithGil with_gil;
    py::array_t<double> dirs({1, 3});
    // What has no direction is asked for any point, which a function that divides by the length has none for.
    put(dirs.mutable_data(), norm_1(dir) > 0.0 ? dir : Vec3d{0.0, 0.0, 1.0});
    const py::object answer = ask(std::move(dirs));
    const auto points = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(answer);
    if (!points) throw py::error_already_set();
    if (points.ndim() != 2 || points.shape(0) != 1 || points.shape(1) != 3) {
      throw InputError(
          "the support function did not give a point for a direction - of an array (N, 3) of directions "
          "give an array (N, 3) of points");
    }
    const Vec3d point = vec3_at(points.data());
    if (!is_finite(point)) {
      throw InputError("the support function gave a point that is not finite - give finite numbers");
    }
    return point;
  }
  double support_error() const { return support_error_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

 private:
  py::object ask(py::array_t<double> dirs) const {
    const CallOfPython call;
    try {
      return (*function_)(std::move(dirs));
    } catch (const py::error_already_set& error) {
      // What is no Exception, as Ctrl-C is none, ends the work of the other threads, too, and at once.
      Interruption* const interruption = Interruption::current();
      if (interruption != nullptr && !error.matches(PyExc_Exception)) interruption->end();
      throw;
    }
  }

  std::shared_ptr<const py::function> function_;
  Vec3d centre_;
  double support_error_, circumradius_, inradius_;
};

}  // namespace

ConvexBody callable_body(py::function support, double support_error, const Vec3d& centre, double circumradius,
                         double inradius) {
  return CallableSupport(std::move(support), support_error, centre, circumradius, inradius);
}

}  // namespace vex::python

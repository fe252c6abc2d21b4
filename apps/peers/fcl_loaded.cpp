#include "apps/peers/fcl_loaded.h"

#include "apps/modules/module.h"

namespace vex {
namespace {

const BackendKind& fcl_of_module() {
  static const BackendKind kind = [] {
    BackendKind result;
    reinterpret_cast<void (*)(BackendKind*)>(module_function("fcl", "vex_fcl_backend"))(&result);
    return result;
  }();
  return kind;
}

}  // namespace

BackendKind loaded_fcl_backend() {
  return {"fcl", true, [](const ConvexBody& a, const ConvexBody& b) { return fcl_of_module().make(a, b); },
          [](const ConvexBody& a, const ConvexBody& b) { return fcl_of_module().takes(a, b); }};
}

}  // namespace vex

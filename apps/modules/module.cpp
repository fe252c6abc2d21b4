#include "apps/modules/module.h"

#include <dlfcn.h>

#include <filesystem>

#include "engine/numeric/errors.h"

namespace vex {

void* module_function(const std::string& name, const char* function) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path file = program.parent_path().parent_path() / "lib" / "vex" / (name + ".so");
  // With RTLD_LOCAL, no symbol of the module takes the place of one of the program.
  void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* const found = module != nullptr ? ::dlsym(module, function) : nullptr;
  if (found == nullptr) {
    const char* const reason = ::dlerror();
    throw InputError("a part of the program cannot be loaded (" + std::string(reason != nullptr ? reason : name) +
                     ") - install all of vex, or keep lib/vex beside the folder of the program");
  }
  return found;
}

}  // namespace vex

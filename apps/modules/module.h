// Parts of programs that are loaded once they are asked for, because the dynamic linker takes longer for the libraries
// behind them than a short run takes altogether.
#pragma once

#include <string>

namespace vex {

/// A function of the module `name`, which is the file lib/vex/NAME.so beside the folder that this process's program is
/// in: so where it was built, and so where it was installed. The module stays loaded. Module and program were built
/// together and hold a copy each of the rooms below; objects with virtual functions pass between them.
/// Throws InputError where there is no such file or it cannot be loaded, with the dynamic linker's reason.
void* module_function(const std::string& name, const char* function);

}  // namespace vex

// without WHAT PROGRAM WORDS...: runs a program on a system that refuses it filters of system calls ("filter") or
// limits on itself ("limits"), as some containers do.
#include <unistd.h>

#include <cerrno>
#include <string>

#include "tests/setup/refused_calls.h"

int main(int argc, char** argv) {
  if (argc < 3) return 125;
  const std::string what = argv[1];
  const bool is_refused = what == "filter"   ? vex::tests::refuse_calls(vex::tests::kFilterCalls, EPERM)
                          : what == "limits" ? vex::tests::refuse_calls(vex::tests::kLimitCalls, EPERM)
                                             : false;
  if (is_refused) ::execv(argv[2], argv + 2);
  return 126;
}

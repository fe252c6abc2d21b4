# Third-party packages, all from Debian 12; cmake/packages.txt names the packages that provide them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)            # header-only parts: Math; in the tests also Multiprecision
find_package(assimp 5.2 REQUIRED)
find_package(Qhull 8 REQUIRED)              # 8.0.2 is qhull 2020.2
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)

# libseccomp filters the system calls of the process that reads by assimp. Without it that process keeps its limits, and
# what it read says that it was not confined. It ships no CMake package; -lseccomp is what programs that use vex link.
find_path(SECCOMP_INCLUDE_DIR seccomp.h)
find_library(SECCOMP_LIBRARY seccomp)
mark_as_advanced(SECCOMP_INCLUDE_DIR SECCOMP_LIBRARY)
set(default OFF)
if(SECCOMP_INCLUDE_DIR AND SECCOMP_LIBRARY)
  set(default ON)
endif()
option(VEX_WITH_SECCOMP "Filter the system calls of the process that reads files by assimp (libseccomp)" ${default})

# Random123 is headers only and ships no package file.
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
add_library(vex_random123 INTERFACE)
target_include_directories(vex_random123 SYSTEM INTERFACE ${RANDOM123_INCLUDE_DIR})

if(VEX_BUILD_PROGRAMS OR VEX_BUILD_TESTS)
  if(VEX_WITH_CCD)
    find_package(ccd REQUIRED)
  endif()
  if(VEX_WITH_FCL)
    find_package(fcl 0.7 REQUIRED)             # its package file finds libccd and octomap itself
  endif()
  find_package(MPI 3.0 QUIET COMPONENTS CXX)   # optional
  option(VEX_WITH_MPI "Let mpirun -n K start programs that make one run together" ${MPI_CXX_FOUND})
  if(VEX_WITH_MPI)
    find_package(MPI 3.0 REQUIRED COMPONENTS CXX)
  endif()
  find_package(CLI11 2.1 REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)

  # three.js makes the bodies of a report page turn; without it, or what packs it, they stand still.
  find_file(VEX_THREE three.min.js PATHS /usr/share/javascript/three /usr/share/javascript/three/build)
  find_file(VEX_ORBIT_CONTROLS OrbitControls.js PATHS /usr/share/javascript/three/examples/js/controls)
  find_program(GZIP_PROGRAM gzip)
  find_program(BASE64_PROGRAM base64)
  mark_as_advanced(VEX_THREE VEX_ORBIT_CONTROLS GZIP_PROGRAM BASE64_PROGRAM)
  set(default OFF)
  if(VEX_THREE AND VEX_ORBIT_CONTROLS AND GZIP_PROGRAM AND BASE64_PROGRAM)
    set(default ON)
  endif()
  option(VEX_WITH_VIEWER "Put three.js into report pages" ${default})
endif()

if(VEX_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(benchmark 1.7 REQUIRED)
endif()

# The Python package is built where Python, NumPy and pybind11 are: those of the first python3 that has NumPy, which
# need not be the first of the PATH. Another one is named by -DPython_EXECUTABLE.
set(default OFF)
if(PROJECT_IS_TOP_LEVEL AND NOT VEX_SANITIZE)
  if(NOT Python_EXECUTABLE)
    find_program(first_python NAMES python3 NO_CACHE)
    foreach(candidate IN ITEMS ${first_python} /usr/bin/python3)
      execute_process(COMMAND ${candidate} -c "import numpy" RESULT_VARIABLE failure OUTPUT_QUIET ERROR_QUIET)
      if(failure STREQUAL "0")
        execute_process(COMMAND ${candidate} -c "import sys; print(sys.executable)"
          OUTPUT_VARIABLE Python_EXECUTABLE OUTPUT_STRIP_TRAILING_WHITESPACE)
        break()
      endif()
    endforeach()
  endif()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 QUIET CONFIG)
  if(Python_Development.Module_FOUND AND Python_NumPy_FOUND AND pybind11_FOUND)
    set(default ON)
  endif()
endif()
option(VEX_BUILD_PYTHON "Build the Python package" ${default})
if(VEX_BUILD_PYTHON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module NumPy)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 REQUIRED CONFIG)
endif()

# Third-party packages, all from Debian 12; cmake/packages.txt names the packages that provide them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)            # header-only parts: Math; in the tests also Multiprecision
find_package(assimp 5.2 REQUIRED)
find_package(Qhull 8 REQUIRED)              # 8.0.2 is qhull 2020.2
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)

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
  find_package(CLI11 2.1 REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)
endif()

if(VEX_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(benchmark 1.7 REQUIRED)
endif()

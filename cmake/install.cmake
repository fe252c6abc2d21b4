# What `cmake --install` installs: the programs, the rooms as libraries with their headers, and find_package(vex).
#
# Components of the installation (cmake --install BUILD --component NAME); cmake/package.cmake makes a package of each of
# the first three:
#   programs      bin/, man pages, documentation in share/doc/vex
#   development   libraries, headers, lib/cmake/vex
#   python        the Python package
#   licence       share/doc/vex/LICENSE and THIRD_PARTY; a Debian package carries both as its own file `copyright`
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(vex_installed_programs)
if(VEX_BUILD_PROGRAMS)
  set(vex_installed_programs
    vex_mesh vex_merge vex_pair vex_scene vex_percolate vex_scan vex_nematic vex_depletion vex_virial vex_paper vex_bench vex_stress)
endif()
set(vex_installed_rooms engine shapes meshes)
set(vex_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vex)

# The date in man pages and packages, and of the packages' files, is that of the sources: made again from the same build,
# they are the same bytes (tests/package/deb_test.sh).
set(vex_source_date $ENV{SOURCE_DATE_EPOCH})
if(NOT vex_source_date)
  execute_process(COMMAND git log -1 --format=%ct WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE vex_source_date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT vex_source_date)  # neither told nor a checkout
  file(TIMESTAMP ${PROJECT_SOURCE_DIR}/CHANGELOG.md vex_source_date %s UTC)
endif()

find_program(GZIP_PROGRAM gzip)
mark_as_advanced(GZIP_PROGRAM)

# --- programs
if(vex_installed_programs)
  install(TARGETS ${vex_installed_programs} RUNTIME COMPONENT programs)
  get_property(modules GLOBAL PROPERTY vex_modules)
  if(modules)
    install(TARGETS ${modules} LIBRARY DESTINATION lib/vex COMPONENT programs)  # where apps/modules looks
  endif()
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(FILES cmake/third_party_licenses.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME THIRD_PARTY COMPONENT licence)
# The documentation lies as in the repository, so that its links lead on; headers refer to docs/derivations.md.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs
  FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.txt REGEX "/notebooks/[^/]*\\.py$")
include(cmake/man_pages.cmake)

# --- the Python package; a folder of Python's own search path, below the prefix
if(VEX_BUILD_PYTHON)
  set(VEX_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING "Where the Python package is installed, below the prefix")
  install(TARGETS vex_python LIBRARY DESTINATION ${VEX_PYTHON_INSTALL_DIR}/vex COMPONENT python)
  install(DIRECTORY python/vex DESTINATION ${VEX_PYTHON_INSTALL_DIR} COMPONENT python
    FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

# --- libraries: each room has a targets file of its own, so that who asks for the engine needs none of the others'
# libraries. An installed header is <vex/engine/...>; what its templates compute in a user's program must round as here
# (docs/decisions/0003), hence the one compiler option that goes along.
target_compile_options(vex_engine INTERFACE
  $<INSTALL_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-ffp-contract=off>>)
set_target_properties(vex_vex PROPERTIES EXPORT_NAME vex)
install(TARGETS vex_vex EXPORT vex_meshes)

foreach(room IN LISTS vex_installed_rooms)
  set_target_properties(vex_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS vex_${room} EXPORT vex_${room}
    ARCHIVE COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT vex_${room} FILE vex_${room}.cmake NAMESPACE vex:: DESTINATION ${vex_config_dir} COMPONENT development)
endforeach()

configure_package_config_file(cmake/vexConfig.cmake.in ${PROJECT_BINARY_DIR}/vexConfig.cmake
  INSTALL_DESTINATION ${vex_config_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vexConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vexConfig.cmake ${PROJECT_BINARY_DIR}/vexConfigVersion.cmake
  DESTINATION ${vex_config_dir} COMPONENT development)

# --- headers
set(vex_include_dir "\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}")
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(vex_include_dir "${CMAKE_INSTALL_INCLUDEDIR}")
endif()
install(CODE "
  set(vex_source_dir \"${PROJECT_SOURCE_DIR}\")
  set(vex_rooms ${vex_installed_rooms})
  set(vex_umbrella \"${PROJECT_BINARY_DIR}/include/vex/vex.h\")
  set(vex_staging_dir \"${PROJECT_BINARY_DIR}/install_headers\")
  set(vex_include_dir \"${vex_include_dir}\")
  include(\"${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake\")"
  COMPONENT development)

if(PROJECT_IS_TOP_LEVEL AND vex_installed_programs)
  include(cmake/package.cmake)
endif()

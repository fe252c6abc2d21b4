# Debian packages (cpack -G DEB --config BUILD/CPackConfig.cmake): vex with the programs, libvex-dev with the libraries,
# python3-vex with the Python package, where that is built.
set(vex_maintainer "The vex developers <vex@users.noreply.github.com>")

set(CPACK_PACKAGE_NAME vex)
set(CPACK_PACKAGE_VENDOR "The vex developers")
set(CPACK_PACKAGE_CONTACT "${vex_maintainer}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has its own
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL programs development)
set(vex_package_components PROGRAMS DEVELOPMENT)
if(VEX_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND vex_package_components PYTHON)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/before_packing.cmake)
set(CPACK_VEX_SOURCE_DATE ${vex_source_date})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME vex)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "orientation-averaged excluded volume of convex bodies
The program vex_mesh computes the volume that a convex body forbids to the
centre of another one, averaged over their orientations, and with it the
second virial coefficient of hard particles: by Monte Carlo with collision
verdicts that are proven against rounding, and by the formula from the
bodies' volume, surface and integrated mean curvature. vex_merge adds parts
of such a run that were made on several machines. vex_pair answers
whether two bodies overlap at given poses, how far apart or how deep in each
other they are, and when a motion makes them meet. vex_scene asks the same
of many bodies in open space or in a periodic box: pairs, distances, clusters.
vex_percolate finds the percolation threshold of bodies that may overlap.
vex_scan measures many bodies, sizes and angles in one command; vex_nematic
tells at which densities a fluid of a body becomes nematic; vex_virial finds
virial coefficients of hard bodies; vex_depletion how balls that they exclude
make two of them attract each other.
vex_paper repeats the computations of a paper of 2002 and explains its faulty
values. vex_bench measures run time against error of every estimator. vex_stress
holds overlap tests against exact arithmetic where they are known to fail.
.
Bodies are closed convex meshes (OBJ, PLY, STL, OFF, glTF, ...), or named
ones such as box:1,2,3.")

# Static libraries bring no dependencies of their own: these are what a program that uses them is built with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvex-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libassimp-dev (>= 5.2), libeigen3-dev (>= 3.4), libqhull-dev (>= 2020.2), zlib1g-dev")
if(VEX_WITH_SECCOMP)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libseccomp-dev (>= 2.5)")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS vex)  # for its documentation
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "overlap and excluded volume of convex bodies - development files
Static libraries, headers and CMake package of vex: an overlap query for
convex bodies whose verdicts are proven against rounding or reported as
undecided, Monte Carlo integration of excluded volumes, named bodies with
their volume, surface and mean curvature, and checked convex meshes.")

# Its compiled part is for the Python that it was built with.
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vex)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, vex")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/cmake/python3-vex/postinst;${PROJECT_SOURCE_DIR}/cmake/python3-vex/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "excluded volumes and collisions of convex bodies - Python package
The Python package vex: bodies by name, from mesh files or from arrays; their
average excluded volume by Monte Carlo and by the formula; overlap, distance,
penetration depth, casts and contacts over arrays of poses, each answer proven
or said not to be; scenes of many bodies; pictures.")

# What Debian has beside a package's files. Installed only where a component is named, as CPack does.
set(debian_dir ${PROJECT_BINARY_DIR}/debian)
file(READ LICENSE vex_license)
string(REGEX REPLACE "^BSD 3-Clause License\n+[^\n]*\n[^\n]*\n+" "" vex_license "${vex_license}")
string(STRIP "${vex_license}" vex_license)
string(REPLACE "\n\n" "\n.\n" vex_license "${vex_license}")
string(REPLACE "\n" "\n " vex_license "${vex_license}")
file(READ cmake/third_party_licenses.txt third_party_licenses)
file(CONFIGURE OUTPUT ${debian_dir}/copyright @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: vex

Files: *
Copyright: 2026 the vex developers
License: BSD-3-clause

License: BSD-3-clause
 @vex_license@

@third_party_licenses@")

set(ENV{SOURCE_DATE_EPOCH} ${vex_source_date})
set(ENV{LC_ALL} C)
string(TIMESTAMP vex_source_date_text "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS vex_package_components)
  set(package ${CPACK_DEBIAN_${component}_PACKAGE_NAME})
  string(TOLOWER ${component} component)
  file(CONFIGURE OUTPUT ${debian_dir}/${package}/changelog.Debian @ONLY CONTENT
"vex (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) unstable; urgency=medium

  * Version @PROJECT_VERSION@; what is new stands in CHANGELOG.md of the sources.

 -- @vex_maintainer@  @vex_source_date_text@
")
  if(GZIP_PROGRAM)
    execute_process(COMMAND ${GZIP_PROGRAM} -9nkf ${debian_dir}/${package}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${debian_dir}/${package}/changelog.Debian.gz DESTINATION share/doc/${package}
      COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
  install(FILES ${debian_dir}/copyright DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)

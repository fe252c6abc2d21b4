# What every target is compiled with. Floating point is the language's own, operation by operation: contraction into
# fused multiply-adds is off everywhere, because a pose must be the same bits on every machine (docs/decisions/0003),
# and -ffast-math is never used.
#
# The target vex_compile_options is what a program that is linked with vex needs too, also in a project of which vex is a
# subfolder. All else is for this folder and those below it.
include(CheckCXXCompilerFlag)

add_library(vex_compile_options INTERFACE)
target_compile_features(vex_compile_options INTERFACE cxx_std_20)
target_compile_options(vex_compile_options INTERFACE -ffp-contract=off)
if(VEX_SANITIZE)
  # Of a target with the property VEX_UNSANITIZED only what it links is.
  target_compile_options(vex_compile_options INTERFACE
    "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:VEX_UNSANITIZED>>>:-fsanitize=${VEX_SANITIZE};-fno-sanitize-recover=all;-fno-omit-frame-pointer>")
  if(VEX_SANITIZE_WITHOUT)
    target_compile_options(vex_compile_options INTERFACE
      "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:VEX_UNSANITIZED>>>:-fno-sanitize=${VEX_SANITIZE_WITHOUT}>")
  endif()
  # Whether a table of virtual functions can be read is asked of the system through a pipe, which a confined process may
  # not make: all tables would be wrong there.
  target_compile_options(vex_compile_options INTERFACE
    "$<$<BOOL:$<TARGET_PROPERTY:VEX_RUNS_CONFINED>>:-fno-sanitize=vptr>")
  target_link_options(vex_compile_options INTERFACE -fsanitize=${VEX_SANITIZE})
endif()

add_compile_options(
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion -Wnon-virtual-dtor
  -Wold-style-cast -Woverloaded-virtual -Wnull-dereference -Wformat=2)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 sees overlapping copies in the concatenation of strings where there are none (its bug 105329).
  add_compile_options(-Wno-restrict)
endif()
if(VEX_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

# Source files are named from the root of the repository, in __FILE__ and for debuggers (which find them when started
# there): what is installed does not tell where it was built.
check_cxx_compiler_flag(-ffile-prefix-map=/from=/to VEX_HAS_FILE_PREFIX_MAP)
if(VEX_HAS_FILE_PREFIX_MAP)
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/= -ffile-prefix-map=${PROJECT_BINARY_DIR}=.)
endif()

# A project of which vex is a subfolder includes <vex/engine/...>, as from an installation.
foreach(room IN ITEMS engine shapes meshes)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include/vex)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${room} ${PROJECT_BINARY_DIR}/include/vex/${room} SYMBOLIC)
endforeach()

# <vex/vex.h> is the list of the public headers.
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt vex_public_headers REGEX "^[a-z]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt)
list(TRANSFORM vex_public_headers REPLACE "(.+)" "#include \"vex/\\1\"" OUTPUT_VARIABLE includes)
list(JOIN includes "\n" includes)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/vex/vex.h @ONLY CONTENT
"// All that vex offers: see docs/library.md.
#pragma once

${includes}
")

# Sources of a target that are compiled together, a dozen at a time: half of the time of a build is the parsing of headers
# that all of them include. What users install is no other for it: no function's arithmetic depends on what stands beside
# it. Every file still includes what it needs, and names of its own clash with nobody's: a build without must succeed too.
# In a debug build, and with a compiler cache, what is compiled again after a change had better be small.
set(default ${PROJECT_IS_TOP_LEVEL})
if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND NOT VEX_SANITIZE OR CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(default OFF)
endif()
option(VEX_UNITY_BUILD "Compile sources of the libraries and programs together, a dozen at a time" ${default})

function(vex_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${VEX_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 12)
  if(VEX_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A class's private parts may have types of an anonymous namespace where only their own file sees them; GCC does not
    # take a file that is included for one.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# vex_module(NAME sources...): what programs load once they need it (apps/modules), the file lib/vex/NAME.so.
function(vex_module name)
  add_library(vex_${name}_module MODULE ${ARGN})
  target_link_libraries(vex_${name}_module PRIVATE vex_compile_options)
  target_compile_features(vex_${name}_module PRIVATE cxx_std_20)
  # What it holds a copy of is its own.
  target_link_options(vex_${name}_module PRIVATE LINKER:--as-needed LINKER:--exclude-libs,ALL)
  set_target_properties(vex_${name}_module PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/vex)
  set_property(GLOBAL APPEND PROPERTY vex_modules vex_${name}_module)
endfunction()

# vex_library(NAME sources...): a static library with the options above and an alias vex::NAME.
function(vex_library name)
  add_library(vex_${name} STATIC ${ARGN})
  add_library(vex::${name} ALIAS vex_${name})
  target_include_directories(vex_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
  target_link_libraries(vex_${name} PUBLIC $<BUILD_INTERFACE:vex_compile_options>)
  target_compile_features(vex_${name} PUBLIC cxx_std_20)
  vex_compile_together(vex_${name})
  # So that a plugin or a language binding can hold it.
  set_target_properties(vex_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

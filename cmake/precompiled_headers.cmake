# Headers that many tests include, parsed once for all targets that are compiled with the same options. Every file still
# includes what it needs: a build with -DVEX_PRECOMPILED_HEADERS=OFF must succeed too.
#
# For tests alone. GCC forgets the pragmas of a precompiled header, and with them that libstdc++ knows better than three
# warnings where characters are copied; the engine and the programs keep these. And a kernel shares no code with the
# rest (docs/decisions/0009).
#
# A compiler cache takes what is made from one for something else in each checkout, and does better without. So do files
# that are compiled together (VEX_UNITY_BUILD): to load 130 MB of parsed headers takes as long as to parse them once.
set(default ${PROJECT_IS_TOP_LEVEL})
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" OR VEX_UNITY_BUILD)
  set(default OFF)
endif()
option(VEX_PRECOMPILED_HEADERS "Parse headers that many tests include once" ${default})

# vex_precompiled_headers(NAME HEADERS... [OPTIONS options...]), for targets with the same options.
function(vex_precompiled_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "OPTIONS")
  if(NOT VEX_PRECOMPILED_HEADERS)
    return()
  endif()
  set(target vex_precompiled_${name})
  file(CONFIGURE OUTPUT ${target}.cpp CONTENT "")
  add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  target_link_libraries(${target} PRIVATE vex_test_support nlohmann_json::nlohmann_json)
  target_compile_options(${target} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${arg_UNPARSED_ARGUMENTS})
endfunction()

# vex_use_precompiled_headers(TARGET NAME)
function(vex_use_precompiled_headers target name)
  if(NOT VEX_PRECOMPILED_HEADERS)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM vex_precompiled_${name})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

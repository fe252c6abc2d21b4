# Installs the public headers (public_headers.txt), with what they include, below include/vex. Run by cmake --install,
# which sets vex_source_dir, vex_rooms, vex_umbrella, vex_staging_dir (its parent is there), vex_include_dir (without
# DESTDIR).
#
# In the repository an include is written from its root, "engine/numeric/vec3.h". Installed, that would claim names as
# common as "engine" of every user, so there it is "vex/engine/numeric/vec3.h".
string(RANDOM LENGTH 12 run)  # installations at the same time do not meet
string(APPEND vex_staging_dir ".${run}")
set(installed_dir "$ENV{DESTDIR}${vex_include_dir}")

list(JOIN vex_rooms "|" rooms_pattern)

# The public headers, and what they include, and so on.
file(STRINGS "${vex_source_dir}/cmake/public_headers.txt" headers REGEX "^[a-z]")
set(to_look_at ${headers})
while(to_look_at)
  list(POP_FRONT to_look_at header)
  file(STRINGS "${vex_source_dir}/${header}" includes REGEX "^#include \"(${rooms_pattern})/")
  list(TRANSFORM includes REPLACE "^#include \"([^\"]+)\".*" "\\1")
  list(REMOVE_ITEM includes ${headers})
  list(APPEND headers ${includes})
  list(APPEND to_look_at ${includes})
endwhile()

foreach(header IN LISTS headers ITEMS vex.h)
  if(header STREQUAL "vex.h")
    file(READ "${vex_umbrella}" text)
  else()
    file(READ "${vex_source_dir}/${header}" text)
  endif()
  string(REGEX REPLACE "(#include \")(${rooms_pattern})/" "\\1vex/\\2/" text "${text}")
  if(EXISTS "${installed_dir}/vex/${header}")
    file(READ "${installed_dir}/vex/${header}" installed_text)
    if(text STREQUAL installed_text)  # untouched, so that what includes it need not be built again
      message(STATUS "Up-to-date: ${installed_dir}/vex/${header}")
      list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${vex_include_dir}/vex/${header}")
      continue()
    endif()
    file(REMOVE "${installed_dir}/vex/${header}")  # file(INSTALL) takes files of the same second for the same
  endif()
  file(WRITE "${vex_staging_dir}/vex/${header}" "${text}")
endforeach()
if(EXISTS "${vex_staging_dir}")
  file(INSTALL DESTINATION "${vex_include_dir}" TYPE DIRECTORY FILES "${vex_staging_dir}/vex"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(REMOVE_RECURSE "${vex_staging_dir}")
endif()

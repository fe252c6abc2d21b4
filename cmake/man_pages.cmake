# A man page for each program, made by help2man from the program's own --help; what that does not say (examples) is in
# apps/PROGRAM/man_page.h2m. Without help2man there are no man pages; sanitized programs make none.
find_program(HELP2MAN_PROGRAM help2man)
find_program(GZIP_PROGRAM gzip)
mark_as_advanced(HELP2MAN_PROGRAM GZIP_PROGRAM)
if(NOT HELP2MAN_PROGRAM OR NOT GZIP_PROGRAM OR VEX_SANITIZE OR CMAKE_CROSSCOMPILING)
  return()
endif()

# The pages' date is that of the sources, so that the same sources give the same bytes.
set(vex_source_date $ENV{SOURCE_DATE_EPOCH})
if(NOT vex_source_date)
  execute_process(COMMAND git log -1 --format=%ct WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE vex_source_date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT vex_source_date)  # neither told nor a checkout
  file(TIMESTAMP ${PROJECT_SOURCE_DIR}/CHANGELOG.md vex_source_date %s UTC)
endif()

set(man_pages)
foreach(program IN LISTS vex_installed_programs)
  set(page ${PROJECT_BINARY_DIR}/man/${program}.1)
  set(more ${PROJECT_SOURCE_DIR}/apps/${program}/man_page.h2m)
  add_custom_command(OUTPUT ${page}.gz
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
    COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${vex_source_date} LC_ALL=C
      ${HELP2MAN_PROGRAM} --no-info --include=${more} --output=${page} $<TARGET_FILE:${program}>
    COMMAND ${GZIP_PROGRAM} -9nkf ${page}
    DEPENDS ${program} ${more}
    COMMENT "Man page of ${program}"
    VERBATIM)
  list(APPEND man_pages ${page}.gz)
endforeach()
add_custom_target(vex_man_pages ALL DEPENDS ${man_pages})
install(FILES ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)

# A man page for each program, made by help2man from the program's own --help; what that does not say (examples) is in
# apps/PROGRAM/man_page.h2m. Without help2man there are no man pages; sanitized programs make none.
find_program(HELP2MAN_PROGRAM help2man)
mark_as_advanced(HELP2MAN_PROGRAM)
if(NOT vex_installed_programs OR NOT HELP2MAN_PROGRAM OR NOT GZIP_PROGRAM OR VEX_SANITIZE OR CMAKE_CROSSCOMPILING)
  return()
endif()

set(man_pages)
foreach(program IN LISTS vex_installed_programs)
  set(page ${PROJECT_BINARY_DIR}/man/${program}.1)
  set(more ${PROJECT_SOURCE_DIR}/apps/${program}/man_page.h2m)
  add_custom_command(OUTPUT ${page}.gz
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
    COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${vex_source_date} LC_ALL=C
      ${HELP2MAN_PROGRAM} --no-info --include=${more} --output=${page} ./$<TARGET_FILE_NAME:${program}>
    COMMAND ${GZIP_PROGRAM} -9nkf ${page}
    # From its folder: help2man takes no blank in the program's path.
    WORKING_DIRECTORY $<TARGET_FILE_DIR:${program}>
    DEPENDS ${program} ${more}
    COMMENT "Man page of ${program}"
    VERBATIM)
  list(APPEND man_pages ${page}.gz)
endforeach()
add_custom_target(vex_man_pages ALL DEPENDS ${man_pages})
add_dependencies(vex_programs vex_man_pages)
# Who builds a program alone can install; what a package lacks, its test sees.
install(FILES ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs OPTIONAL)

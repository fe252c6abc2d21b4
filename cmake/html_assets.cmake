# Writes the C++ source of what every report page holds: style sheet, script and, where it is given, the packed viewer
# library, each with the hash by which the page's Content-Security-Policy knows it. The same bytes from the same files.
#
#   cmake -DSTYLE=... -DSCRIPT=... -DVIEWER="A.js;B.js" -DGZIP=... -DBASE64=... -DOUTPUT=... -P html_assets.cmake

# SHA-256 of a file in base64. Six hexadecimal digits are four characters.
function(base64_hash result file)
  set(alphabet "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  file(SHA256 ${file} hex)
  set(text "")
  foreach(begin RANGE 0 60 6)
    string(SUBSTRING "${hex}00" ${begin} 6 digits)
    math(EXPR bits "0x${digits}")
    foreach(shift IN ITEMS 18 12 6 0)
      math(EXPR index "(${bits} >> ${shift}) & 63")
      string(SUBSTRING "${alphabet}" ${index} 1 character)
      string(APPEND text ${character})
    endforeach()
  endforeach()
  string(SUBSTRING "${text}" 0 43 text)
  set(${result} "${text}=" PARENT_SCOPE)
endfunction()

file(READ ${STYLE} style)
file(READ ${SCRIPT} script)
base64_hash(style_hash ${STYLE})
base64_hash(script_hash ${SCRIPT})
set(viewer_hash "")
set(viewer "")
if(VIEWER)
  set(joined ${OUTPUT}.viewer.js)
  execute_process(COMMAND ${CMAKE_COMMAND} -E cat ${VIEWER} OUTPUT_FILE ${joined} COMMAND_ERROR_IS_FATAL ANY)
  base64_hash(viewer_hash ${joined})
  execute_process(COMMAND ${GZIP} -9nc ${joined} COMMAND ${BASE64} -w0 OUTPUT_VARIABLE viewer COMMAND_ERROR_IS_FATAL ANY)
endif()

# A string literal is cut where compilers need not take it longer.
function(literal result text)
  set(pieces "")
  string(LENGTH "${text}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 16000 piece)
    string(APPEND pieces "R\"vex_asset(${piece})vex_asset\"\n")
    math(EXPR begin "${begin} + 16000")
  endwhile()
  if(pieces STREQUAL "")
    set(pieces "\"\"")
  endif()
  set(${result} "${pieces}" PARENT_SCOPE)
endfunction()
literal(style_literal "${style}")
literal(script_literal "${script}")
literal(viewer_literal "${viewer}")
file(WRITE ${OUTPUT} "// Written by cmake/html_assets.cmake.
#include \"apps/common/html/assets.h\"

namespace vex {
const char* const kPageStyle = ${style_literal};
const char* const kPageStyleHash = \"${style_hash}\";
const char* const kPageScript = ${script_literal};
const char* const kPageScriptHash = \"${script_hash}\";
const char* const kViewerCode = ${viewer_literal};
const char* const kViewerHash = \"${viewer_hash}\";
}  // namespace vex
")

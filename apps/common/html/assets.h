// What every report page holds, made from files at build time (cmake/html_assets.cmake). Hashes are SHA-256 in base64.
#pragma once

namespace vex {

extern const char* const kPageStyle;  // page.css
extern const char* const kPageStyleHash;
extern const char* const kPageScript;  // page.js
extern const char* const kPageScriptHash;
/// three.js with its OrbitControls, by gzip and in base64; empty in a build without it.
extern const char* const kViewerCode;
extern const char* const kViewerHash;  // of the library as it is run

}  // namespace vex

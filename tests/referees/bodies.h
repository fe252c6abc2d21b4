// The bodies that the property, statistical and peer suites run over: a new body is one line here.
#pragma once

#include <array>

namespace vex {

inline constexpr std::array kTestBodies = {
    "sphere:0.6", "box:1,1,1", "box:0.2,1,3", "ellipsoid:0.5,0.5,1.5", "ellipsoid:1,2,3", "capsule:1,0.25",
};

}  // namespace vex

// What the paper prints: S. Sreenivasan, D. R. Baker, G. Paul, H. E. Stanley, "Discrepancy between Monte-Carlo results
// and analytic values for the average excluded volume of rectangular prisms", cond-mat/0207739 (2002), revision 2.
//
// Its uncertainty is the value divided by the square root of the number of hits, of 10^9 trials. Lengths are in units
// in which the bodies of the tables have volume 1.
#pragma once

#include <array>
#include <optional>

namespace vex::paper {

struct Printed {
  double excluded_volume, uncertainty;
  std::optional<double> calculated = {};  // what its column "Calculated", or its text, has from the formula
};

struct TableRow {
  double aspect_ratio;  // l1 / l2 of boxes with l2 = l3, a / b of spheroids with b = c
  Printed printed;
  const char* remark = "";
};

/// Table I: boxes. By the faulty code; the epilogue says that the corrected one gave the formula's values.
inline constexpr std::array<TableRow, 14> kTableOne = {{
    {1e-6, {1751600.0, 467.911, 2000002.0}},
    {0.01, {182.760, 0.048, 207.020}},
    {0.5, {11.488, 0.002, 12.0}},
    {0.6, {11.058, 0.002, 11.533}},
    {0.7, {10.804, 0.001, 11.257}},
    {0.8, {10.659, 0.001, 11.100}},
    {0.9, {10.591, 0.001, 11.022}},
    {1.0, {10.569, 0.001, 11.0}},
    {2.0, {11.543, 0.003, 12.0}, "its difference .477 is a slip for .457"},
    {4.0, {15.023, 0.003, 15.5}},
    {8.0, {22.774, 0.007, 23.25}},
    {16.0, {38.654, 0.016, 39.125}},
    {32.0, {70.624, 0.046, 39.125}},
    {64.0, {134.599, 0.175, 135.03125}},
}};

/// Table II: spheroids. By a code that was right.
inline constexpr std::array<TableRow, 11> kTableTwo = {{
    {0.03125, {77.739, 0.006, 77.741}},
    {0.0625, {40.281, 0.003, 40.281}},
    {0.125, {21.811, 0.002, 21.810}},
    {0.25, {12.956, 0.001, 12.956}},
    {0.5, {9.077, 0.007, 9.077}},
    {1.0, {8.001, 0.002, 8.0}},
    {2.0, {9.077, 0.001, 9.077}},
    {4.0, {12.957, 0.002, 12.956}},
    {8.0, {21.813, 0.005, 21.810}},
    {16.0, {40.28, 0.014, 40.281}},
    {32.0, {77.70, 0.04, 77.741}},
}};

/// The text: capsule L = 1, R = 0.25; sphere and cube of unit volume; parallel unit cubes; the epilogue's cubes.
inline constexpr Printed kCapsules = {2.8797, 0.0006, 2.8798};
inline constexpr Printed kSphereAndCube = {9.347, 0.001, 9.349};
inline constexpr Printed kAlignedCubes = {8.000, 0.002, 8.0};
inline constexpr Printed kCorrectedCubes = {11.00, 0.002, 11.0};

}  // namespace vex::paper

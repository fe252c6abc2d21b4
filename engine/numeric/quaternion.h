// A rotation from a quaternion that a user typed.
#pragma once

#include <array>
#include <cmath>

#include "engine/numeric/double_double.h"
#include "engine/numeric/transform.h"

namespace vex {

/// The square root of w^2 + x^2 + y^2 + z^2 for a largest magnitude in [1/2, 1), rounded to nearest.
///
/// Once from the sum in double-double, the root by one Newton step from the root of the high part: 2^-95 off. That
/// fixes the rounding wherever the norm is not within 2^-90 of the middle between two doubles; there the sign of norm^2
/// - middle^2 is taken from the exact products. Parts below 2^-480, whose squares would be lost, count as a positive
/// trifle.
double correctly_rounded_norm(const std::array<double, 4>& components);

/// R of the quaternion w + xi + yj + zk, which need not have length 1: divided by its
/// correctly rounded norm, then R = [1-2(yy+zz), 2(xy-wz), ...], unfused, in that order. The components may have any
/// magnitude: they are scaled by a power of two first, which changes nothing but over- and underflow. Throws InputError
/// for the quaternion 0 and where one is not finite.
Transformd rotation_from_quaternion(double w, double x, double y, double z);

/// The same of n quaternions that stand in four columns, bit for bit: R's nine entries by rows in columns of `stride`
/// values. Throws as it does, some columns being written then.
void rotations_from_quaternions(const std::array<const double*, 4>& components, std::size_t n, double* rotations,
                                std::size_t stride);

}  // namespace vex

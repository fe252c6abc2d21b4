// The first of three files of portable OpenCL C that are compiled together behind pair.h, here and in kernels.cl: the
// poses of vex's random trials, bit for bit (decision 0003). Each operation is rounded to nearest and none is fused,
// which OpenCL promises of + - * / and sqrt of doubles. kernel_as_cpp.h has the macros with which g++ and nvcc compile
// it as it stands.

#ifdef __OPENCL_VERSION__
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF
#define VEX_FUNCTION static
#define VEX_KERNEL __kernel
#define VEX_GLOBAL __global
#define VEX_CONSTANT __constant
#define VEX_LOCAL __local
#endif

// --- vectors, in the library's order of operations (vec3.h, transform.h)

VEX_FUNCTION VexVec vec(double x, double y, double z) {
  VexVec v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
VEX_FUNCTION VexVec sum(VexVec a, VexVec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
VEX_FUNCTION VexVec less(VexVec a, VexVec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
VEX_FUNCTION VexVec opposite(VexVec a) { return vec(-a.x, -a.y, -a.z); }
VEX_FUNCTION VexVec times(double s, VexVec a) { return vec(s * a.x, s * a.y, s * a.z); }
VEX_FUNCTION VexVec scaled(VexVec a, VexVec b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
VEX_FUNCTION double dot_of(VexVec a, VexVec b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
VEX_FUNCTION VexVec cross_of(VexVec a, VexVec b) {
  return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
VEX_FUNCTION double norm_1_of(VexVec a) { return (fabs(a.x) + fabs(a.y)) + fabs(a.z); }
VEX_FUNCTION VexVec turned(VexPose pose, VexVec p) {
  return vec(dot_of(pose.row_x, p), dot_of(pose.row_y, p), dot_of(pose.row_z, p));
}
VEX_FUNCTION VexVec turned_back(VexPose pose, VexVec d) {
  return vec((pose.row_x.x * d.x + pose.row_y.x * d.y) + pose.row_z.x * d.z,
             (pose.row_x.y * d.x + pose.row_y.y * d.y) + pose.row_z.y * d.z,
             (pose.row_x.z * d.x + pose.row_y.z * d.y) + pose.row_z.z * d.z);
}
VEX_FUNCTION double larger_of(double a, double b) { return a > b ? a : b; }

// --- the draw: random_stream.h, elementary.h, pose_map.h, orientation_law.h

typedef struct {
  double even, odd;
} VexTwo;

VEX_FUNCTION double unit_interval(uint low, uint high) {
  return ((double)((((ulong)high << 32) | low) >> 12) + 0.5) * 0x1p-52;
}

// Coordinates 2 block and 2 block + 1 of the trial: Philox4x32-10.
VEX_FUNCTION VexTwo two_coordinates(ulong seed, ulong trial, uint block) {
  uint key_0 = (uint)seed, key_1 = (uint)(seed >> 32);
  uint c0 = (uint)trial, c1 = (uint)(trial >> 32), c2 = block, c3 = 0u;
  for (int round = 0; round < 10; ++round) {
    const ulong product_0 = (ulong)c0 * 0xD2511F53u, product_1 = (ulong)c2 * 0xCD9E8D57u;
    c0 = (uint)(product_1 >> 32) ^ c1 ^ key_0;
    c1 = (uint)product_1;
    c2 = (uint)(product_0 >> 32) ^ c3 ^ key_1;
    c3 = (uint)product_0;
    key_0 += 0x9E3779B9u;
    key_1 += 0xBB67AE85u;
  }
  VexTwo two;
  two.even = unit_interval(c0, c1);
  two.odd = unit_interval(c2, c3);
  return two;
}

typedef struct {
  double sin, cos;
} VexSinCos;

// sin(pi x) and cos(pi x) for 0 <= x <= 2 (E3).
VEX_FUNCTION VexSinCos sin_cos_pi(double x) {
  const double shifted = (x + x) + 0x1.8p52;
  const double r = x - 0.5 * (shifted - 0x1.8p52);
  const double y = r * r;
  double s = -0x1.6fadb9f155744p-16;
  s = 0x1.e8f434d018d63p-12 + y * s;
  s = -0x1.e3074fde8871fp-8 + y * s;
  s = 0x1.50783487ee782p-4 + y * s;
  s = -0x1.32d2cce62bd86p-1 + y * s;
  s = 0x1.466bc6775aae2p+1 + y * s;
  s = -0x1.4abbce625be53p+2 + y * s;
  s = 0x1.921fb54442d18p+1 + y * s;
  s = r * s;
  double c = 0x1.20c62c2f2d7f5p-18;
  c = -0x1.b6e24f44b128fp-14 + y * c;
  c = 0x1.f9d38a3763cc3p-10 + y * c;
  c = -0x1.a6d1f2a204a8cp-6 + y * c;
  c = 0x1.e1f506891babbp-3 + y * c;
  c = -0x1.55d3c7e3cbffap+0 + y * c;
  c = 0x1.03c1f081b5ac4p+2 + y * c;
  c = -0x1.3bd3cc9be45dep+2 + y * c;
  c = 1.0 + y * c;
  const ulong q = as_ulong(shifted);
  const int swaps = (q & 1) != 0;
  VexSinCos found;
  found.sin = as_double(as_ulong(swaps ? c : s) ^ ((q & 2) << 62));
  found.cos = as_double(as_ulong(swaps ? s : c) ^ (((q + 1) & 2) << 62));
  return found;
}

// Of a normal x > 0 (E4).
VEX_FUNCTION double cube_root_of(double x) {
  double t = as_double(((((as_ulong(x) >> 32) * 0xAAAAAAABu) >> 33) + 715094163u) << 32);
  for (int round = 0; round < 3; ++round) {
    const double cube = t * t * t;
    t = t + t * ((x - cube) / ((cube + cube) + x));
  }
  return t;
}

// Where B's centre is put, which is known before B is turned, and the coordinate that is drawn with it.
typedef struct {
  VexVec position;
  double next;
} VexPlace;

VEX_FUNCTION VexPlace place_of(VEX_CONSTANT const VexPair* pair, ulong seed, ulong trial) {
  const VexTwo first = two_coordinates(seed, trial, 0), second = two_coordinates(seed, trial, 1);
  const double u = first.even, v = first.odd, w = second.even;
  VexPlace place;
  if (pair->domain_is_ball) {
    const VexSinCos azimuth = sin_cos_pi(v + v);
    const double radius = cube_root_of(w);
    const double cos_polar = 1.0 - (u + u), sin_polar = 2.0 * sqrt(u * (1.0 - u));
    const double across = radius * sin_polar;
    const VexVec in_ball = vec(across * azimuth.cos, across * azimuth.sin, radius * cos_polar);
    place.position = sum(pair->domain_middle, times(pair->domain_radius, in_ball));
  } else {
    const VexVec in_box = vec((u + u) - 1.0, (v + v) - 1.0, (w + w) - 1.0);
    place.position = sum(pair->domain_middle, scaled(pair->domain_half_extent, in_box));
  }
  place.next = second.odd;
  return place;
}

VEX_FUNCTION VexPose pose_of(VEX_CONSTANT const VexPair* pair, ulong seed, ulong trial, VexPlace place) {
  const VexTwo third = two_coordinates(seed, trial, 2);
  const double u = place.next;
  const VexSinCos first = sin_cos_pi(third.even + third.even), second = sin_cos_pi(third.odd + third.odd);
  const double short_leg = sqrt(1.0 - u), long_leg = sqrt(u);
  const double qx = short_leg * first.sin, qy = short_leg * first.cos;
  const double qz = long_leg * second.sin, qw = long_leg * second.cos;
  VexPose pose;
  pose.row_x = vec(1.0 - 2.0 * (qy * qy + qz * qz), 2.0 * (qx * qy - qw * qz), 2.0 * (qx * qz + qw * qy));
  pose.row_y = vec(2.0 * (qx * qy + qw * qz), 1.0 - 2.0 * (qx * qx + qz * qz), 2.0 * (qy * qz - qw * qx));
  pose.row_z = vec(2.0 * (qx * qz - qw * qy), 2.0 * (qy * qz + qw * qx), 1.0 - 2.0 * (qx * qx + qy * qy));
  pose.translation = less(place.position, sum(turned(pose, pair->centre_b), vec(0.0, 0.0, 0.0)));
  return pose;
}

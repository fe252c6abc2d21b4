// One pair of bodies and the domain of its trials, as the kernels (kernels.cl) take it: plain numbers in one
// layout, read by OpenCL C, C++ and CUDA. pair_of_bodies.h fills it in.
#ifndef VEX_TESTS_OPENCL_PAIR_H
#define VEX_TESTS_OPENCL_PAIR_H

#define VEX_MOST_VERTICES 64
#define VEX_POSE_COLUMNS 12
// Trials that a group of work items draws.
#define VEX_MOST_IN_GROUP 2048

typedef struct {
  double x, y, z;
} VexVec;

// p_a = R p_b + t; as columns of numbers R by rows, then t.
typedef struct {
  VexVec row_x, row_y, row_z, translation;
} VexPose;

enum { VEX_BOX, VEX_ELLIPSOID, VEX_VERTICES };
enum { VEX_OPEN, VEX_DISJOINT, VEX_OVERLAP };

// A body without its ball, as CoreForm has it.
typedef struct {
  int kind, n_vertices;
  int has_direction,
      unused;              // whether the body has a direction of its own to a point: not along the line to its centre
  VexVec lower, upper;     // a box itself
  VexVec semi_axes;        // of an ellipsoid
  VexVec middle, weights;  // of others than boxes: the direction to p is weights * (p - middle)
  VexVec vertices[VEX_MOST_VERTICES];
} VexCore;

// One body's bounds, in its own frame, against a ball of the other one (E5).
typedef struct {
  int kind, unused;  // VEX_BOX: the body is the box, rounded; VEX_ELLIPSOID alike; VEX_VERTICES: it is in the box
  VexVec centre, lower, upper, reciprocal_axes;
  double outer, inner;  // distances from the box or ellipsoid; of VEX_VERTICES the inner one from the centre
  double outer_ball;    // distance from the centre; not of ellipsoids
  double error;         // of the ball's place, in units of bounds_reach and its own size
} VexBounds;

typedef struct {
  VexCore a, b;
  VexBounds bounds_a, bounds_b;
  VexVec centre_a, centre_b, start;
  double ball_radius;           // of both
  double own_reach, own_error;  // E1's W and E but for what the translation adds
  double bounds_reach;
  int asks_bounds_b, domain_is_ball;
  VexVec domain_middle, domain_half_extent;
  double domain_radius;
} VexPair;

#endif

// The kernels as C++, for the host, or as CUDA, for nvcc: what OpenCL C has of its own, in either. Of C++ a work item
// is a group of its own, and its number is `work_item`; OpenCL's atomic functions are plain additions there.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "tests/opencl/pair.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"

namespace vex_kernel {

using uint = std::uint32_t;
using ulong = std::uint64_t;

#define VEX_GLOBAL
#define VEX_CONSTANT
#define CLK_LOCAL_MEM_FENCE 0

#ifdef __CUDACC__

#define VEX_FUNCTION __device__ inline
#define VEX_KERNEL __global__
#define VEX_LOCAL __shared__

__device__ inline ulong as_ulong(double x) { return static_cast<ulong>(__double_as_longlong(x)); }
__device__ inline double as_double(ulong x) { return __longlong_as_double(static_cast<long long>(x)); }
__device__ inline uint atomic_add(uint* to, uint n) { return atomicAdd(to, n); }
__device__ inline uint get_local_id(int) { return threadIdx.x; }
__device__ inline uint get_local_size(int) { return blockDim.x; }
__device__ inline uint get_group_id(int) { return blockIdx.x; }
__device__ inline uint get_global_id(int) { return blockIdx.x * blockDim.x + threadIdx.x; }
__device__ inline uint get_global_size(int) { return gridDim.x * blockDim.x; }
__device__ inline void barrier(int) { __syncthreads(); }

#else

#define VEX_FUNCTION inline
#define VEX_KERNEL inline
#define VEX_LOCAL

using std::fabs;
using std::sqrt;

struct WorkItem {
  uint id, n;
};
inline thread_local WorkItem work_item{0, 1};

inline ulong as_ulong(double x) {
  ulong bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline double as_double(ulong bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline uint atomic_add(uint* to, uint n) {
  const uint before = *to;
  *to += n;
  return before;
}
inline uint get_local_id(int) { return 0; }
inline uint get_local_size(int) { return 1; }
inline uint get_group_id(int) { return work_item.id; }
inline uint get_global_id(int) { return work_item.id; }
inline uint get_global_size(int) { return work_item.n; }
inline void barrier(int) {}

#endif

// Each needs the one before it.
// clang-format off
#include "tests/opencl/draw.cl"
#include "tests/opencl/search.cl"
#include "tests/opencl/kernels.cl"
// clang-format on

#undef VEX_FUNCTION
#undef VEX_KERNEL
#undef VEX_LOCAL
#undef VEX_GLOBAL
#undef VEX_CONSTANT
#undef CLK_LOCAL_MEM_FENCE

}  // namespace vex_kernel

#pragma GCC diagnostic pop

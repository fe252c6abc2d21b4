// What the host calls; compiled behind search.cl. `counts`: hits, misses, trials in `listed`, trials in `open`. The
// number of a trial is `first` plus what a list holds.

// Of `n` trials each work item draws `n_each`, consecutive in their group; groups of at most VEX_MOST_IN_GROUP trials.
// Those that quick verdicts leave open are listed.
VEX_KERNEL void draw(VEX_CONSTANT const VexPair* pair, ulong seed, ulong first, uint n, uint n_each,
                     VEX_GLOBAL uint* listed, VEX_GLOBAL uint* counts) {
  VEX_LOCAL uint rows[VEX_MOST_IN_GROUP];
  VEX_LOCAL uint tally[4];
  const uint lane = (uint)get_local_id(0), size = (uint)get_local_size(0);
  for (uint k = lane; k < 4; k += size) tally[k] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint begin = (uint)get_group_id(0) * size * n_each;
  uint hits = 0, misses = 0;
  for (uint k = 0; k < n_each; ++k) {
    const uint row = begin + k * size + lane;
    if (row >= n) continue;
    const VexPlace place = place_of(pair, seed, first + row);
    int answer = answer_by_place(pair, place.position);
    if (answer == VEX_OPEN && pair->asks_bounds_b) {
      answer = answer_by_turn(pair, pose_of(pair, seed, first + row, place));
    }
    hits += answer == VEX_OVERLAP ? 1u : 0u;
    misses += answer == VEX_DISJOINT ? 1u : 0u;
    if (answer == VEX_OPEN) rows[atomic_add(&tally[2], 1u)] = row;
  }
  atomic_add(&tally[0], hits);
  atomic_add(&tally[1], misses);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane == 0) {
    atomic_add(&counts[0], tally[0]);
    atomic_add(&counts[1], tally[1]);
    tally[3] = atomic_add(&counts[2], tally[2]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = lane; k < tally[2]; k += size) listed[tally[3] + k] = rows[k];
}

// The listed trials: drawn once more, which takes no longer than to keep their poses.
VEX_KERNEL void decide(VEX_CONSTANT const VexPair* pair, ulong seed, ulong first, VEX_GLOBAL const uint* listed,
                       VEX_GLOBAL uint* open, VEX_GLOBAL uint* counts) {
  uint hits = 0, misses = 0;
  const uint n = counts[2], stride = (uint)get_global_size(0);
  for (uint k = (uint)get_global_id(0); k < n; k += stride) {
    const ulong trial = first + listed[k];
    const int answer = answer_of_search(pair, pose_of(pair, seed, trial, place_of(pair, seed, trial)));
    hits += answer == VEX_OVERLAP ? 1u : 0u;
    misses += answer == VEX_DISJOINT ? 1u : 0u;
    if (answer == VEX_OPEN) open[atomic_add(&counts[3], 1u)] = listed[k];
  }
  if (hits > 0) atomic_add(&counts[0], hits);
  if (misses > 0) atomic_add(&counts[1], misses);
}

// For tests: the poses that `draw` draws, in VEX_POSE_COLUMNS columns of n numbers.
VEX_KERNEL void poses(VEX_CONSTANT const VexPair* pair, ulong seed, ulong first, uint n, VEX_GLOBAL double* columns) {
  const uint k = (uint)get_global_id(0);
  if (k >= n) return;
  const VexPose pose = pose_of(pair, seed, first + k, place_of(pair, seed, first + k));
  const VexVec parts[4] = {pose.row_x, pose.row_y, pose.row_z, pose.translation};
  for (uint part = 0; part < 4; ++part) {
    columns[(3 * part) * n + k] = parts[part].x;
    columns[(3 * part + 1) * n + k] = parts[part].y;
    columns[(3 * part + 2) * n + k] = parts[part].z;
  }
}

// For tests: what the search says of poses in such columns.
VEX_KERNEL void answers(VEX_CONSTANT const VexPair* pair, uint n, VEX_GLOBAL const double* columns,
                        VEX_GLOBAL int* found) {
  const uint k = (uint)get_global_id(0);
  if (k >= n) return;
  VexVec parts[4];
  for (uint part = 0; part < 4; ++part) {
    parts[part] = vec(columns[(3 * part) * n + k], columns[(3 * part + 1) * n + k], columns[(3 * part + 2) * n + k]);
  }
  VexPose pose;
  pose.row_x = parts[0];
  pose.row_y = parts[1];
  pose.row_z = parts[2];
  pose.translation = parts[3];
  found[k] = answer_of_search(pair, pose);
}

// Verdicts that are proven, or none; compiled behind draw.cl.
//
// Who says `overlap` or `disjoint` here has proven it in double; numbers in brackets are those of docs/derivations.md:
//   - disjoint: a direction d whose support point w, as computed, has d . w < -E |d|_1 (E1, and E18 for the order of
//     the operations that is used here);
//   - overlap: four points of the difference whose determinants with the origin all exceed T = 4.25 E W^2 (E18);
//   - either by one body's bounds against the balls of the other (E5), for the drawn poses alone, of whose rotations
//     E6 knows how far they are from true ones.
// W = own_reach + |t|_1 and E = own_error + 40 u W are those of E1 for each trial. What is not proven is left open, and
// so is what is not finite, or so large or small that products might over- or underflow (E18): every comparison that
// answers is false of a NaN. The proofs would bear fused operations.

// --- quick verdicts: quick_verdict.h

// Whether a ball of the other body about p meets what is bounded. `error`: how far p may be off, which is no number
// where p is none, and then nothing is answered.
VEX_FUNCTION int answer_of_bounds(VEX_CONSTANT const VexBounds* bounds, VexVec p, double error) {
  const double outer = bounds->outer + error, inner = bounds->inner - error;
  if (bounds->kind == VEX_ELLIPSOID) {
    const VexVec image = scaled(p, bounds->reciprocal_axes), normal = scaled(image, bounds->reciprocal_axes);
    const double k_sq = dot_of(image, image), k = sqrt(k_sq), rounding = 16.0 * 0x1p-53;
    const double ahead = (k_sq - k) - rounding * (k_sq + k);
    const double outside = larger_of((k - 1.0) + rounding * (k + 1.0), 0.0);
    if (ahead > 0.0 && ahead * ahead > (outer * outer) * dot_of(normal, normal)) return VEX_DISJOINT;
    return inner > 0.0 && dot_of(p, p) * (outside * outside) < (inner * inner) * k_sq ? VEX_OVERLAP : VEX_OPEN;
  }
  const VexVec gap = vec(larger_of(larger_of(bounds->lower.x - p.x, p.x - bounds->upper.x), 0.0),
                         larger_of(larger_of(bounds->lower.y - p.y, p.y - bounds->upper.y), 0.0),
                         larger_of(larger_of(bounds->lower.z - p.z, p.z - bounds->upper.z), 0.0));
  const VexVec from_centre = less(p, bounds->centre);
  const double gap_sq = dot_of(gap, gap), centre_sq = dot_of(from_centre, from_centre);
  const double outer_ball = bounds->outer_ball + error;
  if (gap_sq > outer * outer || centre_sq > outer_ball * outer_ball) return VEX_DISJOINT;
  return inner > 0.0 && (bounds->kind == VEX_BOX ? gap_sq : centre_sq) < inner * inner ? VEX_OVERLAP : VEX_OPEN;
}

VEX_FUNCTION int answer_by_place(VEX_CONSTANT const VexPair* pair, VexVec position) {
  const double error = pair->bounds_a.error * (pair->bounds_reach + norm_1_of(position));
  return answer_of_bounds(&pair->bounds_a, position, error);
}

// Of drawn poses alone.
VEX_FUNCTION int answer_by_turn(VEX_CONSTANT const VexPair* pair, VexPose pose) {
  const VexVec from_b = less(pair->centre_a, pose.translation);
  const double error = pair->bounds_b.error * (pair->bounds_reach + norm_1_of(from_b));
  return answer_of_bounds(&pair->bounds_b, turned_back(pose, from_b), error);
}

// --- the search: packet_search.h, one trial at a time

// A farthest vertex as computed (E2), or the ellipsoid's point D (D d / |D d|) (E18).
VEX_FUNCTION VexVec core_support(VEX_CONSTANT const VexCore* core, VexVec d) {
  if (core->kind == VEX_BOX) {
    return vec(d.x < 0.0 ? core->lower.x : core->upper.x, d.y < 0.0 ? core->lower.y : core->upper.y,
               d.z < 0.0 ? core->lower.z : core->upper.z);
  }
  if (core->kind == VEX_ELLIPSOID) {
    const VexVec image = scaled(core->semi_axes, d);
    return scaled(core->semi_axes, times(1.0 / sqrt(dot_of(image, image)), image));
  }
  int best = 0;
  double best_value = dot_of(core->vertices[0], d);
  for (int k = 1; k < core->n_vertices; ++k) {
    const double value = dot_of(core->vertices[k], d);
    best = value > best_value ? k : best;
    best_value = larger_of(value, best_value);
  }
  return core->vertices[best];
}

// A guess at what separates the core from a body about p; any direction proves (E18).
VEX_FUNCTION VexVec direction_to(VEX_CONSTANT const VexCore* core, VexVec p) {
  if (core->kind != VEX_BOX) return scaled(core->weights, less(p, core->middle));
  return vec(larger_of(p.x - core->upper.x, 0.0) - larger_of(core->lower.x - p.x, 0.0),
             larger_of(p.y - core->upper.y, 0.0) - larger_of(core->lower.y - p.y, 0.0),
             larger_of(p.z - core->upper.z, 0.0) - larger_of(core->lower.z - p.z, 0.0));
}
VEX_FUNCTION VexVec unless_nothing(VexVec d, VexVec otherwise) {
  return norm_1_of(d) > 0x1p-20 * norm_1_of(otherwise) ? d : otherwise;
}

// Of A - B, within E, in the order of operations of E18.
VEX_FUNCTION VexVec support_of(VEX_CONSTANT const VexPair* pair, VexPose pose, VexVec d) {
  const VexVec q = core_support(&pair->b, opposite(turned_back(pose, d)));
  const VexVec p = less(core_support(&pair->a, d), pose.translation);
  const VexVec w = vec(((p.x - pose.row_x.x * q.x) - pose.row_x.y * q.y) - pose.row_x.z * q.z,
                       ((p.y - pose.row_y.x * q.x) - pose.row_y.y * q.y) - pose.row_y.z * q.z,
                       ((p.z - pose.row_z.x * q.x) - pose.row_z.y * q.y) - pose.row_z.z * q.z);
  if (!(pair->ball_radius > 0.0)) return w;
  return sum(w, times(pair->ball_radius / sqrt(dot_of(d, d)), d));
}

#define VEX_MOST_STEPS 26
enum { VEX_FIRST, VEX_SECOND, VEX_ACROSS, VEX_THIRD, VEX_FOURTH };

// One loop with one call of the support mapping, so that work items at different steps wait for each other no longer
// than what follows from a point takes.
VEX_FUNCTION int answer_of_search(VEX_CONSTANT const VexPair* pair, VexPose pose) {
  const double reach = pair->own_reach + norm_1_of(pose.translation);
  const double turn = norm_1_of(pose.row_x) + (norm_1_of(pose.row_y) + norm_1_of(pose.row_z));
  // Of a rotation the magnitudes add up to 5.2 at most; of NaNs and infinities to nothing below 8.
  if (!(turn < 8.0 && reach < 0x1p60)) return VEX_OPEN;
  const double error = pair->own_error + (40.0 * 0x1p-53) * reach;
  const double threshold = 4.25 * error * (reach * reach);
  const VexVec v0 = less(pair->start, sum(turned(pose, pair->centre_b), pose.translation));
  VexVec v1 = v0, v2 = v0, v3 = v0;
  VexVec d = unless_nothing(direction_to(&pair->a, less(pair->start, v0)), opposite(v0));
  int awaited = VEX_FIRST;
  for (int step = 0; step < VEX_MOST_STEPS; ++step) {
    const double d_length = norm_1_of(d);
    if (!(d_length > 0x1p-200)) return VEX_OPEN;
    const VexVec w = support_of(pair, pose, d);
    const double slack = error * d_length, height = dot_of(d, w);
    if (height < -slack) return VEX_DISJOINT;
    if (awaited == VEX_FIRST) {
      v1 = w;
      awaited = pair->b.has_direction ? VEX_SECOND : VEX_ACROSS;
      d = cross_of(v1, v0);
      if (awaited == VEX_SECOND) {
        const VexVec from_b = direction_to(&pair->b, sum(turned_back(pose, v0), pair->centre_b));
        d = unless_nothing(opposite(turned(pose, from_b)), opposite(v0));
      }
    } else if (awaited == VEX_SECOND || awaited == VEX_ACROSS) {
      const VexVec across = cross_of(v1, v0);
      const double side = dot_of(across, w);
      if (awaited == VEX_SECOND && fabs(side) < (0x1p-30 * norm_1_of(across)) * norm_1_of(w)) {
        awaited = VEX_ACROSS;
        d = across;
        continue;
      }
      // Oriented so that the wedge's normal points to the origin's side.
      v2 = side < 0.0 ? v1 : w;
      v1 = side < 0.0 ? w : v1;
      awaited = VEX_THIRD;
      d = cross_of(less(v1, v0), less(v2, v0));
    } else {
      const VexVec w_v0 = cross_of(w, v0);
      VexVec left = v1, right = v2;
      double past_left = dot_of(w_v0, v1), past_right = dot_of(w_v0, v2);
      if (awaited == VEX_FOURTH) {  // portal_split.h
        const double past_3 = dot_of(w_v0, v3);
        const int beside_12 = past_left > 0.0 && !(past_right > 0.0), beside_31 = past_3 > 0.0 && !(past_left > 0.0);
        if (!beside_12) {
          left = beside_31 ? v3 : v2;
          right = beside_31 ? v1 : v3;
          const double past_1 = past_left;
          past_left = beside_31 ? past_3 : past_right;
          past_right = beside_31 ? past_1 : past_3;
        }
      }
      // The four determinants of the origin with the faces of (v0, left, right, w).
      const VexVec face = cross_of(left, right);
      if (dot_of(w, face) > threshold && -past_right > threshold && past_left > threshold &&
          -dot_of(face, v0) > threshold) {
        return VEX_OVERLAP;
      }
      if (awaited == VEX_THIRD && past_left < 0.0) {
        v2 = w;
      } else if (awaited == VEX_THIRD && -past_right < 0.0) {
        v1 = w;
      } else {
        // Where the height is not beyond the portal's own the search is at its end.
        if (awaited == VEX_FOURTH && !(height - dot_of(d, v1) > slack)) return VEX_OPEN;
        v1 = left;
        v2 = right;
        v3 = w;
        awaited = VEX_FOURTH;
      }
      d = awaited == VEX_THIRD ? cross_of(less(v1, v0), less(v2, v0)) : cross_of(less(v2, v1), less(v3, v1));
    }
  }
  return VEX_OPEN;
}

// What is known of the pairs of a scene from one step to the next: for bodies that move little (internal).
//
// After L. Verlet's neighbour lists (Phys. Rev. 159, 98, 1967): the pairs whose balls are nearer than a skin are listed
// once, and as long as no body has moved by more than half of it no other pair can meet. Beyond that each listed pair
// keeps how far its two bodies may still move, together, before what their balls prove of them may end.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/broad_phases.h"
#include "engine/scene/pair_search.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/shift_table.h"

namespace vex {

class PairMemory {
 public:
  /// Lists the pairs that the broad phase, made for the skin, finds, and has the bodies' travel tracked from now on.
  void build(SceneBodies& bodies, const BroadPhases& phases, const SceneKernel& kernel, double skin, int n_threads);
  void forget() { is_there_ = false; }
  /// Whether the list is of this skin and no body has moved too far since.
  bool holds(const SceneBodies& bodies, double skin) const;

  const ShiftTable& shifts() const { return shifts_; }
  std::size_t size() const { return known_.size(); }
  /// The pairs first ... end - 1 of the list: what is known still, and what balls tell, goes to the search's results;
  /// the rest to its near pairs, by numbers of bodies. Of bodies that have not moved since the stages were asked they
  /// are asked once more, and their answer is kept: of bodies that move on it would be of no use.
  void look(const SceneBodies& bodies, std::size_t first, std::size_t end, PairSearch& search);

 private:
  struct Known {
    BodyId a, b;
    std::uint32_t shift;  // of b's copy when the list was made
    bool overlaps;
    double until;  // what is known holds while the travels of a and b are no more than this, together
    double asked;  // the travels when the stages were asked; below 0: never
  };
  // A pair at rest that the stages are asked of, to keep their answer.
  struct AtRest {
    ScenePair pair;
    std::size_t number;
    double travel;
  };
  void keep_answers(std::vector<AtRest>& at_rest, std::size_t first_pair, std::size_t first_undecided,
                    PairSearch& search);

  bool is_there_ = false;
  double skin_ = 0.0;
  ShiftTable shifts_;
  std::vector<Known> known_;
};

}  // namespace vex

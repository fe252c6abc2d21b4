// What is known of the pairs of a scene from one step to the next: for bodies that move little (internal).
//
// After L. Verlet's neighbour lists (Phys. Rev. 159, 98, 1967): the pairs whose balls are nearer than a skin are listed
// once, and as long as no body has moved by more than half of it no other pair can meet. Of each listed pair it is kept
// what was last proven, a plane between the bodies or a ball in their Minkowski difference, and whether the bodies can
// have used up the clearance that it showed (E26): a pair is asked again only then.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/broad_phases.h"
#include "engine/scene/pair_search.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/shift_table.h"

namespace vex {

class PairMemory final : public PairKeeper {
 public:
  /// Lists the pairs that the broad phase, made for the skin, finds, and has the bodies tracked from now on. What is
  /// known of a pair that was listed before is kept.
  void build(SceneBodies& bodies, const BroadPhases& phases, const SceneKernel& kernel, double skin, int n_threads);
  void forget() { is_there_ = false; }
  /// Whether the list is of this skin and no body has moved too far since.
  bool holds(const SceneBodies& bodies, double skin) const;

  const ShiftTable& shifts() const { return shifts_; }
  std::size_t size() const { return known_.size(); }
  /// The pairs first ... end - 1 of the list: what is known still, and what balls tell, goes to the search's results;
  /// the rest is asked, by numbers of bodies, with this for a keeper.
  void look(std::size_t first, std::size_t end, PairSearch& search);

  void keep_as_it_stands(std::uint64_t tag, Outcome outcome) override;
  void keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) override;
  void keep_overlap(std::uint64_t tag, double clearance) override;

 private:
  struct Known {
    enum class Kind : std::uint32_t {
      nothing,
      // While the part along `at` of the way from a to b, less what both have turned, is above `limit`.
      apart,
      // While the distance of that way from `at`, and what both have turned, are together below `limit`.
      overlap,
      // While neither has moved: both have made `limit` moves, together.
      apart_at_rest,
      overlap_at_rest,
    };
    BodyId a, b;
    std::uint32_t shift;  // of b's copy when the list was made
    Kind kind;
    Vec3d at;
    double limit;
  };
  // A pair of the list: its place there is that of its bodies' numbers and of the shift's.
  struct Listed {
    BodyId a, b;
    std::uint32_t shift;
    friend auto operator<=>(const Listed&, const Listed&) = default;
  };
  void find_pairs_within_skin(const BroadPhases& phases, const SceneKernel& kernel, int n_threads);
  void list(bool keeps_old);
  void carry_over(Known& known) const;
  // From a's centre to that of b's copy.
  Vec3d way(const Known& known) const;
  double turned(const Known& known) const;
  double n_moves(const Known& known) const;
  ImageOffset image(const Known& known) const;
  bool holds(const Known& known, const Vec3d& way) const;
  bool keep_what_balls_tell(std::uint64_t tag, const Vec3d& way);

  bool is_there_ = false;
  double skin_ = 0.0;
  double rounding_ = 0.0;  // a clearance below this is as good as none (E26)
  const SceneBodies* bodies_ = nullptr;
  ShiftTable shifts_;
  std::vector<Known> known_;  // by numbers
  // Memory that is kept: for the last list, and for what the parts of the broad phase find, sorted.
  std::vector<Known> known_before_;
  std::vector<std::vector<Listed>> found_;
  std::vector<Listed> listed_;
  std::vector<std::uint32_t> next_;
};

}  // namespace vex

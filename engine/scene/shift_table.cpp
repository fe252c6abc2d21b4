#include "engine/scene/shift_table.h"

#include <algorithm>
#include <cmath>

namespace vex {

void ShiftTable::assign(const std::optional<PeriodicBox>& box, const std::array<int, 3>& n_images) {
  n_ = box ? n_images : std::array<int, 3>{};
  images_.clear();
  rows_.clear();
  for (int x = -n_[0]; x <= n_[0]; ++x) {
    for (int y = -n_[1]; y <= n_[1]; ++y) {
      for (int z = -n_[2]; z <= n_[2]; ++z) {
        const Vec3d shift = box ? box->shift({x, y, z}) : Vec3d{};
        images_.push_back({x, y, z});
        rows_.insert(rows_.end(), {shift.x, shift.y, shift.z, 0.0});
      }
    }
  }
}

double ShiftTable::largest_shift() const {
  double largest = 0.0;
  for (const double s : rows_) largest = std::max(largest, std::fabs(s));
  return largest;
}

}  // namespace vex

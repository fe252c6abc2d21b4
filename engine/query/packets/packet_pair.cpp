#include "engine/query/packets/packet_pair.h"

#include <optional>
#include <utility>

#include "engine/query/search/overlap_filter.h"
#include "engine/query/search/query_error.h"

namespace vex {
namespace {

bool lacks_table(const CoreForm& core) { return core.kind == CoreForm::Kind::table && core.table.cells == nullptr; }

}  // namespace

std::unique_ptr<PacketPair> PacketPair::make(const ConvexBody& a, const ConvexBody& b) {
  const double reach = query_error(a, b, Transformd{}).reach;
  if (!(reach > kLeastPacketReach && reach < kLargestPacketReach)) return nullptr;
  std::optional<CoreForm> core_a = core_form(a), core_b = core_form(b);
  if (!core_a || !core_b || lacks_table(*core_a) || lacks_table(*core_b)) return nullptr;
  return std::unique_ptr<PacketPair>(new PacketPair(a, b, std::move(*core_a), std::move(*core_b)));
}

PacketPair::PacketPair(const ConvexBody& a, const ConvexBody& b, CoreForm core_a, CoreForm core_b)
    : a_(a), b_(b), core_a_(std::move(core_a)), core_b_(std::move(core_b)) {}

bool PacketPair::are_polytopes() const {
  const auto is_polytope = [](const CoreForm& core) {
    return core.kind == CoreForm::Kind::box || core.kind == CoreForm::Kind::vertices ||
           core.kind == CoreForm::Kind::table;
  };
  return is_polytope(core_a_) && is_polytope(core_b_);
}

PacketPairForms PacketPair::forms() const {
  const QueryError<double> own = query_error(a_, b_, Transformd{});
  const double error = own.support + core_a_.support_error + 2.0 * core_b_.support_error;
  const double inradii = a_.inradius() + b_.inradius();
  return PacketPairForms{
      &core_a_,
      &core_b_,
      a_.centre(),
      b_.centre(),
      inradii * kStartOffset,
      a_.ball_radius() + b_.ball_radius(),
      own.reach,
      error - 40.0 * kUnitRoundoff * own.reach * (1.0 - 8.0 * kUnitRoundoff),
      inradii * (1.0 - 0x1p-19 - norm_1(kStartOffset)),
      pair_formula(core_a_, core_b_, a_.ball_radius() + b_.ball_radius(), kFarthestPacket * own.reach)};
}

}  // namespace vex

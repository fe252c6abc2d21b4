// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: a pose is the
// same bits everywhere.
#include "engine/numeric/packet.h"
#include "engine/sampling/pose_columns.h"
#include "engine/sampling/pose_map.h"
#include "engine/sampling/random_stream.h"

namespace vex {
namespace VEX_ISA {
namespace {

constexpr int W = kRegisterLanes;
using L = Packet<W>;
using Bits = PacketBits<W>;

constexpr std::uint64_t kLowWord = 0xffffffffu;

// The four words of a block of Philox4x32-10, counter (index, block, stream), as random_stream.cpp has them from
// Random123. A word is the lower half of its lane; what the upper one holds between rounds is never read.
struct Words {
  Bits w0, w1, w2, w3;
};

Words philox(std::uint64_t seed, const Bits& index, std::uint32_t block, Stream stream) {
  Bits c0 = index, c1 = index >> 32, c2(block), c3(static_cast<std::uint32_t>(stream));
  auto key_0 = static_cast<std::uint32_t>(seed), key_1 = static_cast<std::uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const Bits product_0 = product_of_low_words(c0, Bits(0xD2511F53u));
    const Bits product_1 = product_of_low_words(c2, Bits(0xCD9E8D57u));
    c0 = (product_1 >> 32) ^ c1 ^ Bits(key_0);
    c1 = product_1;
    c2 = (product_0 >> 32) ^ c3 ^ Bits(key_1);
    c3 = product_0;
    key_0 += 0x9E3779B9u;
    key_1 += 0xBB67AE85u;
  }
  return {c0, c1, c2, c3};
}

// The upper 52 of 64 bits, and a half, times 2^-52.
L to_unit_interval(const Bits& low, const Bits& high) {
  const Bits upper = ((high << 32) | (low & Bits(kLowWord))) >> 12;
  const L one_to_two = from_bits(upper | Bits(0x3ff0000000000000u));
  return (one_to_two - L(1.0)) + L(0x1p-53);  // both exact
}

// The twelve values of a pose, in the order of the columns.
template <class Visit>
void for_each_column(const Transform<L>& pose, const Visit& visit) {
  std::size_t column = 0;
  for (const Vec3<L>* part : {&pose.row_x, &pose.row_y, &pose.row_z, &pose.translation}) {
    visit(column++, part->x);
    visit(column++, part->y);
    visit(column++, part->z);
  }
}

}  // namespace

__attribute__((flatten)) void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n,
                                         PoseColumns& poses) {
  alignas(64) static constexpr std::uint64_t kWholeNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  Bits numbers;
  __builtin_memcpy(numbers.part, kWholeNumbers, sizeof numbers.part);
  const int n_coordinates = 3 + recipe.law->dimension();
  poses.n_open = 0;
  for (std::size_t k = 0; k < n; k += W) {
    const Bits index = Bits(first + k) + numbers;
    std::array<L, kPoseDimension> point;
    for (int c = 0; c < n_coordinates; c += 2) {
      const Words words = philox(recipe.seed, index, static_cast<std::uint32_t>(c / 2), Stream::pose);
      point[static_cast<std::size_t>(c)] = to_unit_interval(words.w0, words.w1);
      if (c + 1 < n_coordinates) point[static_cast<std::size_t>(c + 1)] = to_unit_interval(words.w2, words.w3);
    }
    const Transform<L> pose = pose_at(point, *recipe.law, *recipe.domain, recipe.centre_b);
    for_each_column(pose, [&](std::size_t c, const L& value) { value.store(poses.all[c] + k); });
    if (recipe.quick == nullptr) continue;
    const QuickVerdict::Answer<L> answer = (*recipe.quick)(pose);
    for (int j = 0; j < W; ++j) poses.quick[k + static_cast<std::size_t>(j)] = PacketAnswer::open;
    for (unsigned on = lanes_on(answer.disjoint); on != 0; on &= on - 1) {
      poses.quick[k + static_cast<std::size_t>(__builtin_ctz(on))] = PacketAnswer::disjoint;
    }
    for (unsigned on = lanes_on(but_not(answer.overlap, answer.disjoint)); on != 0; on &= on - 1) {
      poses.quick[k + static_cast<std::size_t>(__builtin_ctz(on))] = PacketAnswer::overlap;
    }
    const L row = L::numbers_from(static_cast<double>(k));
    const Compaction<W> open(but_not(row < L(static_cast<double>(n)), either(answer.disjoint, answer.overlap)));
    for_each_column(pose, [&](std::size_t c, const L& value) { open.store(poses.open[c] + poses.n_open, value); });
    open.store(poses.open_index + poses.n_open, row);
    poses.n_open += static_cast<std::size_t>(open.n());
  }
}

}  // namespace VEX_ISA
}  // namespace vex

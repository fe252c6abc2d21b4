// Several processes that make one run: what the driver asks of whoever carries messages between them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace vex {

/// One rank leads: it runs the driver, gives out blocks of trials and adds what comes back, so that stop rules, states
/// and progress are those of one process. The others make what they are given. All of it is called by one thread of
/// each process.
class Ranks {
 public:
  struct Block {
    std::uint64_t begin, end;
  };
  /// What the leader does with what arrives.
  struct Desk {
    std::function<std::optional<Block>(std::uint64_t most)> give;  // nothing: there is none now
    std::function<void(std::string_view done)> take;               // what a rank handed in
  };

  virtual ~Ranks() = default;
  /// Of all, before the first trial of each run: what was asked or handed in of the one before is void from now on.
  virtual void begin() = 0;
  virtual bool leads() const = 0;
  virtual int n_ranks() const = 0;

  /// Of the leader: answers all that has arrived, and waits for nothing. Throws what another rank failed with.
  virtual void serve(const Desk& desk) = 0;
  /// Of the leader: the run is over, and what others still bring is not wanted.
  virtual void end() = 0;

  /// Of the others: asks for a block of up to so many trials; hands in what one brought, as text.
  virtual void ask(std::uint64_t most) = 0;
  virtual void hand_in(const std::string& done) = 0;
  /// Of the others: what has arrived, without waiting.
  struct Arrived {
    bool is_over = false;
    std::optional<Block> block;
  };
  virtual Arrived receive() = 0;
};

}  // namespace vex

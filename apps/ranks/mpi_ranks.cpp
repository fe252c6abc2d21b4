// The module mpi.
#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "apps/ranks/program_ranks.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using Clock = std::chrono::steady_clock;

// What a message is, in its first letter. Of one rank they arrive in their order.
enum Letter : char {
  kHello = 'H',   // to the leader: what this rank works on
  kAsk = 'A',     // to the leader: for a block of up to so many trials
  kRecord = 'R',  // to the leader: what a block brought
  kFailed = 'F',  // to the leader: why this rank cannot go on
  kBye = 'B',     // to the leader: the last one
  kBlock = 'G',   // from the leader: begin and end
  kEnd = 'E',     // from the leader: the last one of a run
  kQuit = 'Q',    // from the leader: the last one of all
};
// Questions, records, blocks and ends begin with the number of their run and a blank: of a run that is over they are
// not looked at.

struct Message {
  int rank;
  char letter;
  std::string text;
};

constexpr int kTag = 24, kLeader = 0;

void send(int rank, char letter, const std::string& text = "") {
  const std::string all = letter + text;
  MPI_Send(all.data(), static_cast<int>(all.size()), MPI_CHAR, rank, kTag, MPI_COMM_WORLD);
}

// The next one that has arrived, if any.
std::optional<Message> receive_message() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (text.empty()) throw std::runtime_error("an empty message of another rank");
  return Message{status.MPI_SOURCE, text.front(), text.substr(1)};
}

class MpiRanks final : public ProgramRanks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks_);
    if (leads()) return;
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }

  bool leads() const override { return rank_ == kLeader; }
  int n_ranks() const override { return n_ranks_; }

  void begin() override { ++run_; }

  void introduce(const std::string& identity) override {
    identity_ = identity;
    if (!leads()) send(kLeader, kHello, identity);
  }

  int run(const std::function<int()>& action) override {
    if (leads()) return action();
    try {
      return action();
    } catch (const std::exception& error) {
      send(kLeader, kFailed, error.what());
      throw;
    }
  }

  void serve(const Desk& desk) override {
    // Not for ever: the run has other things to do.
    constexpr int kMostAtOnce = 1000;
    for (int k = 0; k < kMostAtOnce; ++k) {
      const std::optional<Message> message = receive_message();
      if (!message) break;
      switch (message->letter) {
        case kHello:
          if (message->text != identity_) {
            throw InputError("rank " + std::to_string(message->rank) +
                             " has other bodies or another version of vex - give all ranks the same files");
          }
          break;
        case kAsk:
          if (const auto most = of_this_run(message->text))
            asked_[message->rank] = {run_, std::stoull(std::string(*most))};
          break;
        case kRecord:
          if (const auto done = of_this_run(message->text)) desk.take(*done);
          break;
        case kFailed: throw InputError("rank " + std::to_string(message->rank) + ": " + message->text);
        default: note_bye(*message);
      }
    }
    for (auto asked = asked_.begin(); asked != asked_.end();) {
      if (asked->second.run != run_) {
        asked = asked_.erase(asked);
        continue;
      }
      const std::optional<Block> block = desk.give(asked->second.most);
      if (!block) break;
      send(asked->first, kBlock, this_run() + std::to_string(block->begin) + " " + std::to_string(block->end));
      asked = asked_.erase(asked);
    }
  }

  void end() override {
    for (int rank = 1; rank < n_ranks_; ++rank) send(rank, kEnd, this_run());
  }

  void ask(std::uint64_t most) override { send(kLeader, kAsk, this_run() + std::to_string(most)); }
  void hand_in(const std::string& done) override { send(kLeader, kRecord, this_run() + done); }

  Arrived receive() override {
    if (has_ended_) return {true, std::nullopt};
    const std::optional<Message> message = receive_message();
    if (!message) return {};
    if (message->letter == kQuit) {
      has_ended_ = true;
      return {true, std::nullopt};
    }
    const std::optional<std::string_view> text = of_this_run(message->text);
    if (!text) return {};
    if (message->letter == kEnd) return {true, std::nullopt};
    const std::string block(*text);
    const std::size_t blank = block.find(' ');
    return {false, Block{std::stoull(block.substr(0, blank)), std::stoull(block.substr(blank + 1))}};
  }

  int leave(int code) override {
    if (leads()) {
      for (int rank = 1; rank < n_ranks_; ++rank) send(rank, kQuit);
      // Where a rank was lost its farewell never comes; the launcher ends the job, and what is written is written.
      constexpr std::chrono::seconds kLongest{10};
      const Clock::time_point start = Clock::now();
      while (n_gone_ < n_ranks_ - 1) {
        if (const std::optional<Message> message = receive_message()) {
          note_bye(*message);
        } else if (Clock::now() - start > kLongest) {
          std::cout.flush();
          std::_Exit(code);
        } else {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      }
    } else {
      while (!has_ended_) {
        receive();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      send(kLeader, kBye);
    }
    MPI_Finalize();
    return leads() ? code : 0;
  }

 private:
  void note_bye(const Message& message) { n_gone_ += message.letter == kBye ? 1 : 0; }

  std::string this_run() const { return std::to_string(run_) + " "; }
  std::optional<std::string_view> of_this_run(std::string_view text) const {
    const std::string begin = this_run();
    if (!text.starts_with(begin)) return std::nullopt;
    return text.substr(begin.size());
  }

  int rank_ = 0, n_ranks_ = 1;
  std::string identity_;
  std::uint64_t run_ = 0;  // the number of the run that goes on
  struct Question {
    std::uint64_t run, most;
  };
  std::map<int, Question> asked_;  // of the leader: who waits for a block, of how many trials at most
  int n_gone_ = 0;
  bool has_ended_ = false;
};

}  // namespace

}  // namespace vex

extern "C" vex::ProgramRanks* vex_mpi_ranks() { return new vex::MpiRanks; }

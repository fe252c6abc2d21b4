// Runs in parts: killed at random moments and gone on with, they end with the result of one run; what is no state of
// the same run is refused.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/golden/program.h"
#include "tests/golden/run_documents.h"

namespace vex::golden {
namespace {

using nlohmann::json;

// Programs that save themselves, as variables of the shell, with a run of each.
struct Saving {
  std::string program, short_run, long_run;
};
const std::vector<Saving> kSaving = {
    {"$VEX", "box:1,1,1 --trials 1e4", "box:1,1,1 --estimator hit-or-miss --seconds 60 --threads 1"},
    {"$VIRIAL", "box:1,1,1 --trials 40", "box:1,1,1 --seconds 60 --threads 1"},
    {"$PERCOLATE", "box:1,1,1 --sizes 3 --realisations 9", "box:1,1,1 --sizes 3 --seconds 60 --threads 1"},
};

class Resume : public ProgramTest {
 protected:
  explicit Resume(const std::string& program = VEX_MESH_PROGRAM) : ProgramTest(program) {
    setenv("PERCOLATE", VEX_PERCOLATE_PROGRAM, 1);
    setenv("VIRIAL", VEX_VIRIAL_PROGRAM, 1);
  }

  Finished run_of(const Saving& one, const std::string& words) const {
    return shell("\"" + one.program + "\" --quiet " + words);
  }
  void expect_refused(const Words& words, int exit_code, const std::string& part) const {
    expect_refusal(run(words), exit_code, part);
  }

  void expect_killed_runs_end_as_one(const std::vector<Words>& runs) const;

  /// Kills the run with SIGKILL at random moments and starts it again until it ends; returns how often it was killed.
  int kill_until_it_ends(Words words, std::mt19937_64& random, int most_kills) const {
    words.insert(words.end(), {"--quiet", "--checkpoint", "c.state", "--resume", "c.state", "--checkpoint-every",
                               "0.01", "--json", "parts.json", "--threads", ""});
    int n_kills = 0;
    for (;; ++n_kills) {
      words.back() = std::to_string(std::vector<int>{1, 2, 3, 8}[random() % 4]);
      const auto wait = std::chrono::milliseconds(30 + random() % 150);
      const Finished finished = n_kills == most_kills ? run(words) : run_and_signal(words, SIGKILL, [wait](pid_t) {
        std::this_thread::sleep_for(wait);
        return true;
      });
      if (finished.exit_code != 128 + SIGKILL) {
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return n_kills;
      }
    }
  }
};

void Resume::expect_killed_runs_end_as_one(const std::vector<Words>& runs) const {
  std::mt19937_64 random(24);
  int n_kills = 0;
  for (const Words& words : runs) {
    Words whole = words;
    whole.insert(whole.end(), {"--quiet", "--json", "whole.json"});
    ASSERT_EQ(run(whole).exit_code, 0);
    n_kills += kill_until_it_ends(words, random, 3);
    EXPECT_EQ(without_times(json::parse(read_file("parts.json"))), without_times(json::parse(read_file("whole.json"))));
    std::filesystem::remove(path("c.state"));
    // A file that never took its name stays behind a killed run, and the next one removes it.
    EXPECT_EQ(files(), (Words{"parts.json", "whole.json"}));
  }
  EXPECT_GE(n_kills, static_cast<int>(runs.size()));
}

TEST_F(Resume, KilledRunsEndWithTheResultOfOneRun) {
  expect_killed_runs_end_as_one(
      {{"box:1,1,2", "ellipsoid:1,2,3", "--estimator", "hit-or-miss", "--trials", "1e7"},
       {"box:1,1,2", "capsule:1,0.5", "--rel-error", "5e-6"},
       {"box:1,1,2", "ellipsoid:1,2,3", "--estimator", "hit-or-miss-fitted", "--rel-error", "4e-4"}});
}

class ResumeVirial : public Resume {
 protected:
  ResumeVirial() : Resume(VEX_VIRIAL_PROGRAM) {}
};

TEST_F(ResumeVirial, KilledRunsEndWithTheResultOfOneRun) {
  expect_killed_runs_end_as_one(
      {{"box:1,1,2", "--order", "5", "--trials", "2500"}, {"cylinder:3,0.5", "--rel-error", "3e-3"}});
}

TEST_F(ResumeVirial, MoreCoefficientsAndMoreTrialsMayBeAskedForLater) {
  json_of({"box:1,1,2", "--trials", "50", "--checkpoint", "c", "--order", "4"});
  EXPECT_EQ(without_times(json_of({"box:1,1,2", "--trials", "90", "--order", "5", "--resume", "c"})),
            without_times(json_of({"box:1,1,2", "--trials", "90", "--order", "5"})));
  const Finished fewer = run({"box:1,1,2", "--trials", "90", "--order", "3", "--resume", "c"});
  EXPECT_EQ(fewer.exit_code, 3);
  EXPECT_NE(fewer.err.find("has more coefficients than this run (2, and 1)"), std::string::npos) << fewer.err;
}

class ResumePercolate : public Resume {
 protected:
  ResumePercolate() : Resume(VEX_PERCOLATE_PROGRAM) {}
};

TEST_F(ResumePercolate, KilledRunsEndWithTheResultOfOneRun) {
  expect_killed_runs_end_as_one({{"box:1,1,1", "--sizes", "3,4", "--realisations", "700"}});
}

TEST_F(Resume, AnInterruptedRunIsSavedToItsLastTrial) {
  const Words words = {"box:1,1,1", "--estimator", "hit-or-miss",  "--trials", "1.5e7",
                       "--json",    "r.json",      "--checkpoint", "c.state"};
  const Finished finished = run_and_signal(words, SIGTERM, has_worker_threads);
  ASSERT_EQ(finished.exit_code, 143) << finished.err;
  const json part = json::parse(read_file("r.json"));
  EXPECT_EQ(part["complete"], false);
  EXPECT_NE(read_file("c.state").find("\ntrials " + part["estimate"]["trials"].dump() + " "), std::string::npos);
  EXPECT_EQ(json_of({"box:1,1,1", "--estimator", "hit-or-miss", "--trials", "1.5e7", "--resume",
                     "c.state"})["estimate"]["hits"],
            json_of({"box:1,1,1", "--estimator", "hit-or-miss", "--trials", "1.5e7"})["estimate"]["hits"]);
}

TEST_F(Resume, TheFirstRunOfManyBeginsAndTheLastOneIsDone) {
  const Words words = {"box:1,1,1", "--trials", "1e5", "--checkpoint", "c.state", "--resume", "c.state"};
  const Finished first = run(words);
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(first.err, "vex_mesh: no run to go on from yet (c.state): it begins\n");
  const json once = without_times(json_of(words)), again = without_times(json_of(words));
  EXPECT_EQ(once, again);
  EXPECT_EQ(once, without_times(json_of({"box:1,1,1", "--trials", "1e5"})));
  // Of as many trials more than there are, at the end of whole classes.
  EXPECT_EQ(without_times(json_of({"box:1,1,1", "--trials", "2e5", "--resume", "c.state"})),
            without_times(json_of({"box:1,1,1", "--trials", "2e5"})));
  EXPECT_LT(read_file("c.state").size(), 4096u);
}

// A run that took days was overwritten by the same command line without --resume.
TEST_F(Resume, NoOtherRunOverwritesAState) {
  for (const Saving& one : kSaving) {
    ASSERT_EQ(run_of(one, one.short_run + " --checkpoint c").exit_code, 0);
    const std::string saved = read_file("c");
    for (const char* const more : {"", " --seed 2", " --resume other"}) {
      write_file("other", saved);
      const Finished finished = run_of(one, one.short_run + " --checkpoint c" + more);
      EXPECT_EQ(finished.exit_code, 2) << one.program;
      EXPECT_NE(finished.err.find("holds something already (c) - go on from it with --resume c, name another file, or "
                                  "remove it"),
                std::string::npos)
          << finished.err;
    }
    EXPECT_EQ(run_of(one, one.short_run + " --seed 2 --checkpoint c --resume c").exit_code, 3);
    EXPECT_EQ(read_file("c"), saved);
    EXPECT_EQ(run_of(one, one.short_run + " --checkpoint c --resume c").exit_code, 0);  // which is done
    EXPECT_EQ(run_of(one, one.short_run + " --checkpoint new --resume c").exit_code, 0);
    write_file("notes", "not to be lost");
    EXPECT_EQ(run_of(one, one.short_run + " --checkpoint notes").exit_code, 2);
    EXPECT_EQ(run_of(one, one.short_run + " --checkpoint notes --resume notes").exit_code, 3);
    EXPECT_EQ(read_file("notes"), "not to be lost");
    // What a run leaves that was killed before it saved itself is no state.
    write_file("begun", "");
    EXPECT_EQ(run_of(one, one.short_run + " --checkpoint begun --resume begun").exit_code, 0);
    EXPECT_NE(run_of(one, "missing.obj --checkpoint refused").exit_code, 0);
    ASSERT_EQ(shell("mkfifo pipe").exit_code, 0);
    for (const char* const file : {"pipe", "/dev/zero", "."}) {
      const Finished refused = run_of(one, one.short_run + " --resume " + file);
      EXPECT_EQ(refused.exit_code, 3) << one.program << " " << file;
      EXPECT_NE(refused.err.find("a state is no regular file"), std::string::npos) << refused.err;
    }
    for (const std::string& name : files()) {
      EXPECT_NE(name, "refused");
      std::filesystem::remove(path(name));
    }
  }
}

TEST_F(Resume, OfTwoLiveRunsOneHasTheFile) {
  for (const Saving& one : kSaving) {
    // Looked at while the first one saves itself again and again, under a new file each time.
    const Finished finished =
        shell("\"" + one.program + "\" --quiet " + one.long_run +
              " --checkpoint c --checkpoint-every 0.01 & until [ -s c ]; do sleep 0.02; done; ln -s c link; "
              "for k in 1 2 3 4 5 6; do for file in c link; do \"" +
              one.program + "\" --quiet " + one.short_run +
              " --checkpoint $file --resume $file || echo refused $?; done; done; kill -KILL $!; wait $!");
    EXPECT_EQ(finished.exit_code, 128 + SIGKILL) << finished.err;
    std::string refused;
    for (int k = 0; k < 12; ++k) refused += "refused 2\n";
    EXPECT_EQ(finished.out, refused);
    EXPECT_NE(finished.err.find("another run that lives saves itself in this file (link for --checkpoint) - wait for "
                                "its end, or name another file"),
              std::string::npos)
        << finished.err;
    // The lock goes with the process, however that ends.
    write_file(".c.0123456789", "left behind");
    write_file(".c.012345678", "another's");
    const Finished next = run_of(one, one.short_run + " --seed 3 --checkpoint c --resume c");
    EXPECT_EQ(next.exit_code, 3) << next.err;
    EXPECT_EQ(files(), (Words{".c.012345678", "c", "link"}));
    for (const std::string& name : files()) std::filesystem::remove(path(name));
  }
}

TEST_F(Resume, AFileThatTookTheNameMeanwhileIsLeft) {
  const Finished finished = shell(
      "\"$VEX\" box:1,1,1 --estimator hit-or-miss --rel-error 1e-12 --threads 1 --json r --checkpoint c "
      "--checkpoint-every 0.05 & "
      "until [ -s c ]; do sleep 0.02; done; rm c; until [ -s c ]; do sleep 0.02; done; echo mine > d; mv d c; "
      "sleep 0.3; kill -TERM $!; wait $!");
  EXPECT_EQ(finished.exit_code, 1) << finished.err;
  EXPECT_NE(finished.out.find("# vex_mesh checkpoint\n"), std::string::npos) << finished.out;
  EXPECT_NE(finished.err.find("no state was saved: another file has taken the name of this run's (c)"),
            std::string::npos)
      << finished.err;
  EXPECT_EQ(read_file("c"), "mine\n");
  EXPECT_EQ(files(), (Words{"c", "r"}));
}

TEST_F(Resume, TheTimeAlreadySpentCounts) {
  const Words words = {"box:1,1,1",    "--seconds", "0.5",      "--estimator", "hit-or-miss",
                       "--checkpoint", "c.state",   "--resume", "c.state"};
  const json first = json_of(words), second = json_of(words);
  EXPECT_EQ(second["estimate"]["trials"], first["estimate"]["trials"]);
  EXPECT_LT(second["seconds"].get<double>(), first["seconds"].get<double>() + 0.1);
}

TEST_F(Resume, GoesOnFromNothingElse) {
  const Words words = {"box:1,1,1", "--trials", "1e4"};
  const auto with = [](Words all, const Words& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(run(with(words, {"--checkpoint", "c.state"})).exit_code, 0);
  expect_refused({"box:1,1,1.5", "--trials", "1e4", "--resume", "c.state"}, 3,
                 "a state of another run (c.state has \"A: box");
  for (const Words& more : std::vector<Words>{{"--seed", "2"},
                                              {"--estimator", "radial"},
                                              {"--orientations", "aligned"},
                                              {"--rel-error", "1e-3"},
                                              {"--max-trials", "1e6"},
                                              {"--no-quick-verdicts"},
                                              {"--verify"},
                                              {"--sequence", "random"},
                                              {"--scale", "2"}}) {
    expect_refused(with(with(words, more), {"--resume", "c.state"}), 3, "a state of another run");
  }
  expect_refused(with(words, {"--resume", "missing.state"}), 3, "missing.state: No such file");
  expect_refused({"box:1,1,1", "--trials", "1e3", "--resume", "c.state"}, 3, "more trials than the run may have");
  const std::string whole = read_file("c.state");
  const auto broken = [&](const std::string& content, const std::string& part) {
    write_file("broken.state", content);
    expect_refused(with(words, {"--resume", "broken.state"}), 3, part);
  };
  broken("", "the file is empty or cut off");
  broken("box 1 2 3\n", "not a vex_mesh checkpoint");
  for (std::size_t n = 30; n < whole.size() - 1; n += 997) broken(whole.substr(0, n), "");
  std::mt19937_64 random(3);
  for (int k = 0; k < 10; ++k) {
    std::string changed = whole;
    char& letter = changed[random() % (whole.size() - 1)];
    letter = letter == '7' ? '8' : '7';
    broken(changed, "");
  }
  broken(whole + "more\n", "something stands behind the end");
  broken(whole + whole, "something stands behind the end");
}

TEST_F(Resume, WhereItCannotBeSavedTheRunGoesOn) {
  std::filesystem::create_directory(path("there"));
  const Finished finished =
      shell(kWithoutOverride +
            "sh -c '(until [ -e there/c.state ]; do sleep 0.05; done; chmod a-w there) & exec \"$VEX\" box:1,1,1 "
            "--estimator hit-or-miss --trials 3e7 --threads 1 --checkpoint there/c.state --checkpoint-every 0.1 "
            "--json r.json --quiet'");
  EXPECT_EQ(finished.exit_code, 1) << finished.err;
  const std::string said = "no state was saved";
  EXPECT_NE(finished.err.find(said), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.find(said), finished.err.rfind(said)) << finished.err;
  EXPECT_EQ(json::parse(read_file("r.json"))["complete"], true);
  std::filesystem::permissions(path("there"), std::filesystem::perms::owner_all);
  // The last state is on standard output, and a run goes on from it.
  EXPECT_NE(finished.err.find("the last state could not be saved in there/c.state; its text is on standard output"),
            std::string::npos)
      << finished.err;
  write_file("rescued.state", finished.out);
  const Finished resumed = shell(
      "exec \"$VEX\" box:1,1,1 --estimator hit-or-miss --trials 3e7 --threads 1 --resume rescued.state --json s.json");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(json::parse(read_file("s.json"))["estimate"]["hits"], json::parse(read_file("r.json"))["estimate"]["hits"]);
}

TEST_F(Resume, WhatNamesNoFileIsWrongUsage) {
  expect_refused({"box:1,1,1", "--checkpoint", "-"}, 2, "name a file");
  expect_refused({"box:1,1,1", "--checkpoint", "/dev/null"}, 2, "cannot be replaced");
  expect_refused({"box:1,1,1", "--resume", "-"}, 2, "is read from a file");
  expect_refused({"box:1,1,1", "--checkpoint-every", "1"}, 2, "without --checkpoint");
  expect_refused({"box:1,1,1", "--checkpoint", "c", "--checkpoint-every", "0"}, 2, "--checkpoint-every");
  expect_refused({"box:1,1,1", "--checkpoint", "no/folder/c"}, 2, "no/folder");
  expect_refused({"box:1,1,1", "--checkpoint", "c", "--json", "c"}, 2, "one file for two outputs");
  expect_refused({"box:1,1,1", "--first-trial", "32"}, 2, "give --trials");
  expect_refused({"box:1,1,1", "--first-trial", "32", "--trials", "10", "--rel-error", "1"}, 2, "give --trials");
  expect_refused({"box:1,1,1", "--first-trial", "33", "--trials", "10", "--sequence", "sobol"}, 2, "multiple of 32");
  expect_refused({"box:1,1,1", "--first-trial", "1e19", "--trials", "10"}, 2, "below 2^62");
}

TEST_F(Resume, ALongRunIsAnnouncedAndAdvised) {
  const Words words = {"box:1,1,1", "--estimator", "hit-or-miss", "--rel-error", "1e-7", "--max-trials", "1e18"};
  const auto said_by = [&](Words all) { return run_and_signal(all, SIGINT, has_worker_threads).err; };
  EXPECT_NE(said_by({"box:1,1,1", "--estimator", "hit-or-miss", "--rel-error", "1e-7"}).find("reach --max-trials"),
            std::string::npos);
  const std::string said = said_by(words);
  EXPECT_NE(said.find("vex_mesh: hit-or-miss will take about "), std::string::npos) << said;
  EXPECT_NE(said.find("--checkpoint FILE saves what is done"), std::string::npos) << said;
  Words saved = words;
  saved.insert(saved.end(), {"--checkpoint", "c.state"});
  EXPECT_EQ(said_by(saved).find("--checkpoint FILE"), std::string::npos);
  Words quiet = words;
  quiet.emplace_back("--quiet");
  EXPECT_EQ(said_by(quiet), "");
  EXPECT_EQ(run({"box:1,1,1", "--trials", "1e4"}).err, "");
}

// No pilot foresees them: it is said once they have gone on for two seconds.
TEST_F(Resume, ALongRunOfOtherProgramsIsAnnouncedAndAdvised) {
  const std::string until_told =
      " --threads 1 2> told & program=$!; for k in $(seq 1200); do [ -s told ] && break; sleep 0.05; done; "
      "kill -TERM $program; wait $program; cat told >&2";
  for (const auto& [words, told] :
       {std::pair{"\"$VIRIAL\" box:1,1,1 --rel-error 1e-7", "vex_virial: B3 will take about "},
        std::pair{"\"$PERCOLATE\" box:1,1,1 --sizes 3,12 --realisations 6e7",
                  "vex_percolate: the run will take about "},
        std::pair{"\"$PERCOLATE\" box:1,1,1 --sizes 3,4 --std-error 1e-7",
                  "vex_percolate: the run will take about "}}) {
    for (const bool is_saved : {false, true}) {
      // What the run before said must not be taken for what this one says, before it has begun.
      std::filesystem::remove(path("told"));
      const std::string said = shell(words + std::string(is_saved ? " --checkpoint c.state" : "") + until_told).err;
      EXPECT_TRUE(said.starts_with(told)) << said;
      EXPECT_EQ(said.find("--checkpoint FILE saves what is done") != std::string::npos, !is_saved) << said;
      std::filesystem::remove(path("c.state"));
    }
  }
}

// Of equal V, S, M and radii, and without an exact form: they were taken for each other, and the mean was of both.
TEST_F(Resume, BodiesThatOnlyTurnOrMirrorMakeAnotherRun) {
  const std::string rest = " box:0.2,3,0.2 --orientations aligned --estimator hit-or-miss --quiet ";
  for (const auto& [body, other] :
       {std::pair{"superellipsoid:1,2,3,2,1.5", "superellipsoid:2,1,3,2,1.5"},
        std::pair{"rounded:0.1,superellipsoid:1,2,3,2,1.5", "rounded:0.1,superellipsoid:2,1,3,2,1.5"},
        std::pair{"egg:1,0.5,1", "egg:1,1,0.5"}}) {
    ASSERT_EQ(shell(std::string("\"$VEX\" ") + body + rest + "--trials 6400 --checkpoint s --json a.json").exit_code,
              0);
    const Finished finished = shell(std::string("\"$VEX\" ") + other + rest + "--trials 12800 --resume s");
    EXPECT_EQ(finished.exit_code, 3) << body;
    EXPECT_NE(finished.err.find("a state of another run"), std::string::npos) << finished.err;
    EXPECT_EQ(shell(std::string("\"$VEX\" ") + body + rest + "--trials 12800 --resume s").exit_code, 0);
    std::filesystem::remove(path("s"));
  }
}

}  // namespace
}  // namespace vex::golden

// Learning from logs: small ones counted by hand, and the same counts as from the steps themselves.

#include "quoll/experiment/log_learning.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/experiment/logged_steps.hpp"
#include "quoll/experiment/player.hpp"
#include "quoll/model/formats/fields.hpp"

namespace quoll {
namespace {

constexpr const char* header = "state,action,reward,next_state,terminated,truncated\n";

// A file with this content, removed at the end of the test.
class File {
 public:
  explicit File(const std::string& content) {
    static int count = 0;
    path_ = testing::TempDir() + "quoll_log_" + std::to_string(getpid()) + "_" +
            std::to_string(++count) + ".csv";
    EXPECT_TRUE(write_file(path_, content));
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

RunSettings at_discount(double discount) {
  RunSettings settings;
  settings.learn.discount = discount;
  return settings;
}

LogLearning learned(const std::vector<std::string>& files, const std::optional<World>& world,
                    const RunSettings& settings) {
  Result<LogLearning> result = learn_from_logs(files, world, settings);
  EXPECT_TRUE(result) << message(result.error());
  return std::move(*result);
}

const std::string by_hand = std::string(header) +
                            "A,go,1,B,0,0\n"
                            "B,go,4,C,1,0\n"
                            "A,go,3,A,0,0\n"
                            "A,stay,0,A,0,0\n"
                            "A,go,2,B,0,1\n"
                            "B,go,6,C,1,0\n"
                            "A,go,2,B,0,0\n"
                            "B,jump,0,D,0,0\n";

// Four of A's go: reward 8 / 4, three to B (one of them cut off, which stops nothing), one to A.
// B's go: 10 / 2 and an end. B's jump: to D, where nothing was tried; the least possible there is
// the least reward of the log that goes on, 0, for ever. At discount 1/2
//   V(B) = max(5, 0 + 0) = 5;  V(A) = 2 + (3 * 5 + V(A)) / 8 = 31 / 7 by go, half of it by stay.
TEST(LogLearning, CountsAndPlansAsByHand) {
  const File file(by_hand);
  const LogLearning from = learned({file.path()}, std::nullopt, at_discount(0.5));
  EXPECT_EQ(from.steps, 8U);
  EXPECT_EQ(from.ended, 2U);
  EXPECT_EQ(from.cut, 1U);
  const Mdp& names = *from.names;
  ASSERT_EQ(names.states(), 4U);
  const State a = *names.find_state("A"), b = *names.find_state("B");
  const State c = *names.find_state("C"), d = *names.find_state("D");
  const std::uint64_t go = names.choice_begin(a), jump = names.choice_begin(b) + 1;
  EXPECT_EQ(from.model.tried(go), 4U);
  EXPECT_EQ(from.model.tried(go + 1), 1U);
  EXPECT_EQ(from.mean_reward(go), 2.0);
  EXPECT_EQ(from.mean_reward(names.choice_begin(b)), 5.0);
  EXPECT_TRUE(names.terminal(c));
  EXPECT_TRUE(from.unknown(d));
  EXPECT_NEAR(from.plan.state_value[a], 31.0 / 7.0, 1e-8);
  EXPECT_NEAR(from.plan.state_value[b], 5.0, 1e-8);
  EXPECT_NEAR(from.plan.pair_value[go + 1], 31.0 / 14.0, 1e-8);
  EXPECT_NEAR(from.plan.pair_value[jump], 0.0, 1e-8);
  EXPECT_EQ(from.plan.policy[a], 0U);
  EXPECT_EQ(from.plan.policy[b], 0U);
  EXPECT_EQ(from.plan.policy[c], no_action);
  EXPECT_EQ(from.plan.policy[d], no_action);
  // Episodes began at A, at A after the first end, at B after the cut, at A after the second end.
  EXPECT_EQ(names.start_probability(0), 0.75);
  EXPECT_EQ(names.start_probability(1), 0.25);
  EXPECT_FALSE(from.certifier);
}

// A loss on the way: what leads to the unknown is worth the loss for ever, -1 / (1 - 1/2).
TEST(LogLearning, ExpectsTheLeastOfTheUnknown) {
  const File file(std::string(header) + "A,try,-1,B,0,0\nA,end,-1.5,C,1,0\n");
  const LogLearning from = learned({file.path()}, std::nullopt, at_discount(0.5));
  EXPECT_EQ(from.stuck, -2.0);
  EXPECT_NEAR(from.plan.pair_value[0], -2.0, 1e-8);
  EXPECT_NEAR(from.plan.pair_value[1], -1.5, 1e-12);
  EXPECT_EQ(from.plan.policy[0], 1U);
}

TEST(LogLearning, TwoFilesAreOneExperience) {
  const File first(std::string(header) + "A,go,1,B,0,0\n");
  const File second("terminated,next_state,reward,action,state\nTrue,,3,go,B\n0,A,0,back,B\n");
  const LogLearning from = learned({first.path(), second.path()}, std::nullopt, at_discount(0.5));
  EXPECT_EQ(from.steps, 3U);
  // The second file begins an episode: at B.
  ASSERT_EQ(from.names->start().size(), 2U);
  EXPECT_NEAR(from.plan.state_value[0], 1.0 + 0.5 * 3.0, 1e-8);
}

TEST(LogLearning, BoundsNeedARangeThatTheLogKeeps) {
  const File file(by_hand);
  RunSettings settings = at_discount(0.5);
  settings.learn.reward_range = "0,6";
  const LogLearning wide = learned({file.path()}, std::nullopt, settings);
  ASSERT_TRUE(wide.certifier);
  const ExperienceCertificate& bounds = wide.certifier->certificate();
  for (State s = 0; s < wide.names->states(); ++s) {
    EXPECT_LE(bounds.lower[s], wide.plan.state_value[s]);
    EXPECT_GE(bounds.upper[s], wide.plan.state_value[s]);
  }
  settings.learn.reward_range = "0,5";
  EXPECT_FALSE(learned({file.path()}, std::nullopt, settings).certifier);
}

TEST(LogLearning, AStepThatTheWorldCannotMakeIsCounted) {
  const Result<World> world = find_world("adventure");
  const File file(std::string(header) + "GATE,To-POOL,0,GOAL,1,0\nGATE,To-POOL,0,POOL,0,0\n");
  const LogLearning from = learned({file.path()}, *world, RunSettings());
  EXPECT_EQ(from.misfits, 1U);
  EXPECT_FALSE(from.certifier);
}

// Steps as they were made, and the same steps through a file: equal counts, rewards and plans.
TEST(LogLearning, ALogIsWorthTheStepsItTells) {
  const Result<World> world = find_world("frozen-lake");
  const Mdp& mdp = *world->mdp;
  Player player(*world, {1, 7, 0, nullptr}, 1.0);
  Rng rng = stream(7, "behaviour");
  CountedModel direct(mdp.choices());
  std::string text = header;
  player.restart();
  for (int i = 0; i < 30'000; ++i) {
    if (player.now().over()) player.restart();
    const State from = player.now().number;
    const auto action = static_cast<Action>(rng.next() % player.actions());
    player.step(action);
    const Moment& now = player.now();
    direct.observe(mdp.choice_begin(from) + action, now.terminated ? the_end : now.number,
                   now.reward);
    text += as_field(mdp.state_name(from)) + "," + as_field(now.action_name) + "," +
            shortest(now.reward) + "," + as_field(mdp.state_name(now.number)) +
            (now.terminated ? ",1," : ",0,") + (now.truncated ? "1\n" : "0\n");
  }
  const File file(text);
  const LogLearning from = learned({file.path()}, *world, RunSettings());
  EXPECT_EQ(from.misfits, 0U);
  const std::vector<std::uint64_t>& begin = mdp.arrays().choice_begin;
  Planning planning;
  planning.discount = from.discount;
  const Plan same = plan(direct, begin, planning);
  for (std::uint64_t pair = 0; pair < mdp.choices(); ++pair) {
    EXPECT_EQ(from.model.tried(pair), direct.tried(pair));
    EXPECT_EQ(from.plan.pair_value[pair], same.pair_value[pair]);
  }
  ASSERT_TRUE(from.certifier && from.exact && from.optimality);
  const ExperienceCertificate& bounds = from.certifier->certificate();
  for (State s = 0; s < mdp.states(); ++s) {
    EXPECT_LE(bounds.lower[s], from.exact->upper[s]);
    EXPECT_GE(bounds.upper[s], from.exact->lower[s]);
  }
  EXPECT_LT(from.optimality->regret, 0.1);
}

TEST(LoggedSteps, NameTheNearestOfWhatIsUnknown) {
  const Result<World> world = find_world("adventure");
  const File file(std::string(header) + "GATE,To-POOL,0,POOL,0,0\nPOOL,To-CAV,0,CAVE,0,0\n");
  const std::vector<std::string> files = {file.path()};
  const Result<void> read = read_steps(files, *world->mdp, [](std::span<const Update>) {});
  ASSERT_FALSE(read);
  EXPECT_EQ(message(read.error()),
            file.path() + ":3:6: no action 'To-CAV' at state POOL; did you mean 'To-CAVE'?");
}

}  // namespace
}  // namespace quoll

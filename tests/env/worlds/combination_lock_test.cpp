#include <array>

#include "moves.hpp"

namespace quoll {
namespace {

using world_tests::made;

TEST(CombinationLock, OneButtonLeadsOn) {
  const World world = made("combination-lock", {{"length", "50"}, {"buttons", "3"}});
  const Mdp& mdp = *world.mdp;
  EXPECT_EQ(mdp.states(), 51u);
  std::array<int, 3> right{};
  for (State s = 0; s < 50; ++s) {
    int on = 0;
    for (Action a = 0; a < 3; ++a) {
      const std::uint64_t c = mdp.choice_begin(s) + a;
      if (mdp.next(c) == s + 1) {
        ++on;
        ++right[a];
        EXPECT_EQ(mdp.reward(c), s == 49 ? 1.0 : 0.0);
      } else {
        EXPECT_EQ(mdp.next(c), 0u);
        EXPECT_EQ(mdp.reward(c), 0.0);
      }
    }
    EXPECT_EQ(on, 1) << s;
  }
  for (const int count : right) EXPECT_GT(count, 5);
  EXPECT_TRUE(mdp.terminal(50));
  EXPECT_EQ(mdp.state_name(50), "open");
}

}  // namespace
}  // namespace quoll

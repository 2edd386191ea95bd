// A world built in code, learned and queried.
#include <cstdio>
#include <quoll/quoll.hpp>

int main() {
  quoll::MdpBuilder game(0.8);  // the discount
  const char* const paths[][2] = {
      {"GATE", "POOL"}, {"POOL", "HALL"}, {"HALL", "CAVE"}, {"POOL", "CAVE"}, {"POOL", "WELL"}};
  for (const auto& [here, there] : paths) {
    game.move(here, std::string("To-") + there, there);
    game.move(there, std::string("To-") + here, here);
  }
  game.move("CAVE", "To-GOAL", "GOAL", 100.0);
  game.move("WELL", "To-GOAL", "GOAL", 100.0);

  const quoll::Learned learned = quoll::learn(quoll::world("adventure", game));

  for (const char* state : {"GATE", "HALL", "POOL", "CAVE", "WELL"}) {
    std::printf("at %s take %s\n", state, learned.best(state).c_str());
  }
  std::printf("Q(HALL, To-CAVE) = %g, optimal: %s\n", learned.q("HALL", "To-CAVE"),
              learned.optimal() ? "proved" : "no");
}

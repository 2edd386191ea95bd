#include <algorithm>
#include <cmath>
#include <memory>

#include "quoll/solve/discounted.hpp"
#include "quoll/solve/methods.hpp"
#include "quoll/solve/sweep.hpp"

// Value iteration in place, to and fro: good news travels along a sweep. From a lower bound on V*,
// so that states of which nothing is known yet stand still. Gauss-Seidel: Puterman 1994, 6.3.3.
//
//   1  V(s) <- max over a of r + g E V(s'), state by state, backward and forward in turn, until no
//      value changes by more than the aim
//   2  W <- T V with MacQueen's bounds; if they are not narrow enough, a smaller aim and 1 again
//
// V: run.value().

namespace quoll {

void gauss_seidel(Discounted& run) {
  const Mdp& mdp = run.mdp();
  if (run.certify()) return;
  bool backward = true;
  double goal = run.aim();
  do {
    for (double change = infinity; change > goal; backward = !backward) {
      InPlace backend{run.value().data()};
      sweep(mdp, run.discount(), run.value().data(),
            {0, static_cast<State>(mdp.states()), backward}, backend);
      change = backend.change;
      if (!run.count(mdp.states(), change)) break;
    }
    goal *= 0.25;
  } while (!run.certify());
}

namespace {

class GaussSeidel : public Solver {
 public:
  Result<Solution> solve(const Mdp& mdp, const SolveSettings& settings) override {
    if (!settings.maximise) return solve_minimised(*this, mdp, settings);
    const Result<double> discount = discounted_only(mdp, settings, "gauss-seidel");
    if (!discount) return discount.error();
    Discounted run(mdp, settings, *discount, "gauss-seidel");
    gauss_seidel(run);
    return run.finish();
  }
};

}  // namespace

std::unique_ptr<Solver> make_gauss_seidel() {
  return std::make_unique<GaussSeidel>();
}

}  // namespace quoll

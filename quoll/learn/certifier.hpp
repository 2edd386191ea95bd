#pragma once
// Stopping with a certificate from experience alone: counts what any learner meets, and bounds, at
// checkpoints, the optimal values and what a policy is sure of. Whatever the world declares of
// itself is an assumption, and is told.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quoll/learn/interval_model.hpp"
#include "quoll/learn/settings.hpp"
#include "quoll/learn/tabular/planning.hpp"
#include "quoll/learn/update.hpp"

namespace quoll {

/// What is to be certified.
struct CertifyGoal {
  /// Largest upper - lower in the states asked about; 0 = equal but for rounding, 1e-12 of the
  /// largest value.
  double gap = 0.0;
  bool relative = false;     ///< gap is a share of the start value, the smaller of its two bounds
  bool everywhere = false;   ///< asked about every state, not only where episodes begin
  double confidence = 0.95;  ///< in noisy worlds: of all checkpoints together
  bool once = false;         ///< there is one check: it need not share the failure with later ones
  bool listed = false;  ///< the world's lists of successors are taken as known, not their shares
};

/// A pair that keeps the bounds apart.
struct Blocking {
  State state = 0;
  Action action = 0;
  std::uint32_t tried = 0;
  double width = 0.0;        ///< of its value
  std::uint64_t needed = 0;  ///< samples it may still need, from width ~ 1 / sqrt(samples)
};

struct ExperienceCertificate {
  std::vector<double> lower, upper;  ///< per state; the policy is worth at least `lower`
  std::vector<Action> policy;        ///< no_action where nothing is known
  double gap = 0.0;                  ///< largest in the states asked about
  State widest = 0;
  double start_lower = 0.0, start_upper = 0.0;  ///< over the states episodes began in: worst gap's
  std::uint64_t steps = 0, checks = 0;
  bool reached = false;

  void persist(Archive& archive);
};

class Certifier {
 public:
  Certifier() = default;
  /// Error: no declared rewards, or no bound on values.
  static Result<Certifier> make(const LearnSetup& setup, const CertifyGoal& goal);

  /// The step at which check() is due; a chunk should not run over it.
  std::uint64_t due() const { return due_; }
  /// Counts steps.
  void observe(std::span<const Update> updates);
  /// Bounds anew; true when the goal is reached.
  bool check();

  const ExperienceCertificate& certificate() const { return certificate_; }
  /// The pairs of the optimistic policy whose values are least certain, at most `count`.
  std::vector<Blocking> blocking(std::size_t count = ~std::size_t{0}) const;
  /// What the certificate takes for granted, a sentence each.
  std::vector<std::string> assumptions() const;
  bool certain() const { return certain_; }
  const CertifyGoal& goal() const { return goal_; }

  void persist(Archive& archive);

 private:
  void check_certain();
  void check_noisy();
  double allowed() const;
  std::vector<State> asked() const;

  CertifyGoal goal_;
  bool certain_ = false;
  double discount_ = 1.0;
  RewardRange rewards_{};
  std::pair<double, double> values_{0.0, 0.0};  // of any policy
  std::vector<std::uint64_t> begin_;
  ListedSuccessors successors_;
  Planning pessimism_, hope_;
  CountedModel model_;
  std::vector<double> square_sum_;
  bool noisy_rewards_ = false;
  std::vector<std::uint8_t> acted_, began_;  // per state
  std::vector<State> chosen_;                // where episodes can be made to begin
  bool begins_ = true;                       // the next step begins an episode
  bool starts_listed_ = false;               // the world says where episodes begin
  std::uint64_t steps_ = 0, outcomes_ = 0, due_ = 1;
  ExperienceCertificate certificate_;
};

}  // namespace quoll

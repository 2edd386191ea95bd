#pragma once
// Learning in one call, for programs: a world in, a policy and its values out. Whatever is wrong is
// raised as quoll::Exception (base/raise.hpp), whose message is the line the program quoll would
// print.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/experiment/run.hpp"
#include "quoll/model/builder.hpp"

namespace quoll {

/// A built-in world or a file, as `quoll learn` takes them.
World world(const std::string& name_or_file,
            const std::vector<std::pair<std::string, std::string>>& parameters = {});

/// The world that was built move by move.
World world(std::string name, const MdpBuilder& builder);

/// What learning came to. Names need a world whose model is known; indices do for every world.
/// Everything asked for is that of the first seed.
class Learned {
 public:
  Learned(const Run& run, RunResult result);

  /// The learned value of an action; raises an unknown name with the nearest known one.
  double q(std::string_view state, std::string_view action) const;
  double q(State state, Action action) const;
  /// How often the action was tried.
  std::uint32_t visits(State state, Action action) const;
  /// The name of the action the policy takes; "" for an end or where nothing was tried.
  std::string best(std::string_view state) const;
  /// The policy as a function: policy()(state) costs one load, never throws, never allocates.
  const TablePolicy& policy() const { return policy_; }
  /// True: proved optimal. False: proved that it is not, or not decided (result() says which).
  bool optimal() const;
  /// Steps, stops, proof, exact answer, returns: of all seeds.
  const RunResult& result() const { return result_; }
  const World& world() const { return world_; }
  /// The method that was chosen for the world, and why; none where the settings named one.
  const std::optional<MethodChoice>& choice() const { return choice_; }

 private:
  State find(std::string_view state) const;
  std::uint64_t pair(State state, Action action) const;

  World world_;
  std::optional<MethodChoice> choice_;
  Estimates estimates_;
  RunResult result_;
  TablePolicy policy_;
};

/// As `quoll learn WORLD`: by the method that fits what the world declares (learn/choice.hpp),
/// until nothing changes any more, or for max(10^6, 2000 x pairs) steps.
Learned learn(const World& world);
/// The same by settings, those of `quoll learn`, until one of their limits is met. The method is
/// the one they name; "auto" names the one that fits.
Learned learn(const World& world, const RunSettings& settings);
Learned learn(const World& world, const LearnSettings& settings);

}  // namespace quoll

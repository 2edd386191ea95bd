#pragma once
// The explicit files of PRISM and Storm: transitions (.tra) with states (.sta), labels (.lab) and
// rewards (.srew of states, .trew of transitions) beside them. PRISM manual, appendix "Explicit
// model files"; what Storm's dialect has otherwise: docs/formats.md.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quoll/model/formats/format.hpp"
#include "quoll/model/formats/lines.hpp"

namespace quoll {

/// A file beside the transitions.
struct PrismPart {
  enum class Kind : std::uint8_t { states, labels, rewards } kind;
  std::string path;  ///< for messages
  std::string name;  ///< of the rewards, unless the file says another; may be empty
  Lines lines;
};

/// The model of these transitions and parts; parts of one kind in the order in which they count.
/// Rewards of one name are added: states and transitions may both have some. `path` is for
/// messages.
Result<MdpArrays> read_prism_parts(Lines& transitions, const std::string& path,
                                   std::vector<PrismPart>& parts);

/// The parts of the model at `path`: those that --with names, and for each kind it does not name,
/// the files in the folder that are called like it (docs/formats.md). Opens them.
Result<std::vector<PrismPart>> prism_parts(const std::string& path, const Parameters& given,
                                           bool look_beside);

/// Refuses to write these files where a reader would take another file for one of theirs.
Result<void> no_strangers_beside(const std::string& path, const std::vector<WrittenFile>& files);

/// One pass over a file of states, labels or rewards into the arrays, which are complete but for
/// them.
Result<void> read_prism_states(PrismPart& part, MdpArrays& arrays);
Result<void> read_prism_labels(PrismPart& part, MdpArrays& arrays);

/// Rewards while they are gathered: per state, per outcome or both.
struct PrismRewards {
  std::string name;
  std::vector<double> state;
  std::vector<double> outcome;
};
/// `chain`: the model's transitions have no numbers of choices.
Result<void> read_prism_rewards(PrismPart& part, const MdpArrays& arrays, bool chain,
                                std::vector<PrismRewards>& gathered);

}  // namespace quoll

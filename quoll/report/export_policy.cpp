#include "quoll/report/export_policy.hpp"

#include "quoll/base/json.hpp"
#include "quoll/model/formats/fields.hpp"

namespace quoll {

std::string policy_csv(const PolicyExport& policy) {
  std::string out = "state,action\n";
  const Mdp& mdp = *policy.mdp;
  for (State s = 0; s < mdp.states(); ++s) {
    if (policy.policy[s] == no_action) continue;
    std::string state = as_field(mdp.state_name(s));
    if (state.starts_with('#')) state = '"' + state + '"';  // would be a comment
    out += state + "," + as_field(mdp.action_name(mdp.choice_begin(s) + policy.policy[s])) + "\n";
  }
  return out;
}

std::string policy_json(const PolicyExport& policy) {
  const Mdp& mdp = *policy.mdp;
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("world", policy.name);
  json.key("origin").begin_array();
  for (const std::string& sentence : policy.origin) json.value(sentence);
  json.end_array();
  json.rows("policy", mdp.states(), true, [&](std::uint64_t i) {
    const auto s = static_cast<State>(i);
    json.begin_object().member("state", mdp.state_name(s));
    if (policy.policy[s] == no_action)
      json.null_member("action");
    else
      json.member("action", mdp.action_name(mdp.choice_begin(s) + policy.policy[s]));
    json.end_object();
  });
  json.end_object();
  return json.text() + "\n";
}

}  // namespace quoll

#include "quoll/model/digest.hpp"

#include <bit>

#include "quoll/base/random.hpp"

namespace quoll {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = mix(value_ + golden_gamma) ^ mix(word + golden_gamma * 3);
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const std::string& text) {
    std::uint64_t word = 0xcbf29ce484222325ULL;
    for (const char letter : text) {
      word = (word ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
    }
    add(word);
  }
  template <class T>
  void add_all(const std::vector<T>& items) {
    add(std::uint64_t{items.size()});
    for (const T& item : items) {
      if constexpr (std::is_same_v<T, double>)
        add(item);
      else
        add(std::uint64_t{item});
    }
  }
  void add_all(const Column& items) {
    add(std::uint64_t{items.size()});
    for (std::size_t i = 0; i < items.size(); ++i) add(items[i]);
  }
  std::uint64_t value() const { return mix(value_); }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace

std::uint64_t digest(const Mdp& mdp) {
  const MdpArrays& a = mdp.arrays();
  Hash hash;
  hash.add_all(a.choice_begin);
  hash.add_all(a.outcome_begin);
  hash.add_all(a.next);
  hash.add_all(a.probability);
  hash.add_all(a.reward);
  hash.add_all(a.outcome_reward);
  hash.add_all(a.action);
  hash.add_all(a.start);
  hash.add_all(a.start_probability);
  hash.add_all(a.terminal);
  for (std::uint64_t i = 0; i < a.action_names.size(); ++i) hash.add(a.action_names[i]);
  for (std::uint64_t i = 0; i < a.state_names.size(); ++i) hash.add(a.state_names[i]);
  hash.add(a.discount);
  if (a.alternating) hash.add(std::uint64_t{2});
  return hash.value();
}

}  // namespace quoll

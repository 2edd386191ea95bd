// Blackjack against a dealer who draws to 17, cards from an endless deck.
//
// Cards count 1 to 9 with probability 1/13 each and 10 with 4/13; an ace is usable when counting it
// as 11 does not exceed 21. The dealer shows one card. Actions stick 0, hit 1. Exceeding 21 loses;
// after a stick the dealer draws while his sum is below 17 (a usable ace counts 11). Win 1, draw 0,
// loss -1. A natural is a sum of 21 with the first two cards. rules: sab, a natural wins unless the
// dealer has one too (then it is a draw); natural, a natural that wins pays 1.5; plain, it is a 21
// like others. No step limit.
// States: the player's hand (hard 4 to 21, soft 12 to 21, natural) * 10 + the dealer's card - 1,
// named "hard-14-vs-10", "soft-17-vs-A", "natural-vs-9"; then the ends lost, drawn, won. The
// observation is [sum, dealer's card, usable ace], which does not tell a natural from another 21.
//
// Source: Sutton and Barto 2018, example 5.1; Gymnasium, Blackjack-v1 (rules=sab).
// Draws: a card is a whole number below 13 (0 the ace, 9 to 12 tens). A start draws two cards of
// the dealer (the first is shown), two of the player, the suit of the shown card (below 4), and if
// it is a ten its face (below 3). State for people: {"player": cards, "dealer": cards, "suit",
// "face", "result"}, result 0 = playing, 1 = lost, 2 = drawn, 3 = won; a dealer with one card draws
// the hidden one when it is needed.

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "quoll/base/text.hpp"
#include "quoll/env/dynamics.hpp"
#include "quoll/env/world.hpp"
#include "quoll/env/worlds/table_writer.hpp"

namespace quoll {
namespace {

enum class Rules : std::uint8_t { sab, natural, plain };
constexpr std::string_view rules_names[] = {"sab", "natural", "plain"};

struct BlackjackSettings {
  Rules rules = Rules::sab;
  Seeding seeding = Seeding::quoll;

  void describe(Describer& describe) {
    describe.choice("rules", rules, rules_names, "what a natural is worth");
    describe.choice("seeding", seeding, seeding_names, "whose random numbers a seed gives");
  }
};

// What counts of a hand.
struct Hand {
  std::uint32_t hard = 0;  // aces as 1
  bool ace = false, natural = false;

  bool usable() const { return ace && hard + 10 <= 21; }
  std::uint32_t sum() const { return hard + (usable() ? 10 : 0); }
  Hand with(std::uint32_t card) const { return {hard + card, ace || card == 1, false}; }
};

Hand hand_of(const std::vector<std::uint32_t>& cards) {
  Hand hand;
  for (const std::uint32_t card : cards) hand = hand.with(card);
  hand.natural = cards.size() == 2 && hand.sum() == 21;
  return hand;
}

constexpr std::uint32_t hands = 29, natural_hand = 28;
constexpr State lost = hands * 10, drawn = lost + 1, won = lost + 2, states = lost + 3;

State state_of(const Hand& hand, std::uint32_t shown) {
  if (hand.sum() > 21) return lost;
  const std::uint32_t index = hand.natural    ? natural_hand
                              : hand.usable() ? 18 + hand.sum() - 12
                                              : hand.sum() - 4;
  return index * 10 + shown - 1;
}

// Some cards that make a hand.
std::vector<std::uint32_t> cards_of(State s) {
  const std::uint32_t index = s / 10;
  if (index == natural_hand) return {1, 10};
  if (index == natural_hand - 1) return {1, 5, 5};
  if (index >= 18) return {1, index - 17};
  const std::uint32_t sum = index + 4;
  if (sum == 21) return {2, 9, 10};
  return sum <= 12 ? std::vector<std::uint32_t>{2, sum - 2}
                   : std::vector<std::uint32_t>{10, sum - 10};
}

// What the player earns by sticking when the dealer has drawn.
double settle(Rules rules, const Hand& player, const Hand& dealer) {
  if (rules == Rules::sab && player.natural && !dealer.natural) return 1.0;
  if (dealer.sum() > 21 || player.sum() > dealer.sum()) {
    return rules == Rules::natural && player.natural ? 1.5 : 1.0;
  }
  return player.sum() < dealer.sum() ? -1.0 : 0.0;
}

State end_of(double reward) {
  return reward > 0.0 ? won : reward < 0.0 ? lost : drawn;
}

std::string card_name(std::uint32_t card) {
  return card == 1 ? "A" : std::to_string(card);
}

std::string state_name(State s) {
  if (s >= lost) return s == lost ? "lost" : s == drawn ? "drawn" : "won";
  const std::uint32_t index = s / 10;
  const std::string hand = index == natural_hand ? "natural"
                           : index >= 18         ? "soft-" + std::to_string(index - 6)
                                                 : "hard-" + std::to_string(index + 4);
  return hand + "-vs-" + card_name(s % 10 + 1);
}

double probability_of(std::uint32_t card) {
  return card == 10 ? 4.0 / 13.0 : 1.0 / 13.0;
}

// The dealer's last hands with their probabilities: those that follow from a shown card.
std::vector<std::pair<Hand, double>> dealer_hands(std::uint32_t shown) {
  std::array<std::array<double, 2>, 32> open{};  // by hard sum and ace
  std::vector<std::pair<Hand, double>> last;
  const auto draw = [&](const Hand& hand, double probability, bool first) {
    for (std::uint32_t card = 1; card <= 10; ++card) {
      Hand next = hand.with(card);
      next.natural = first && next.sum() == 21;
      const double share = probability * probability_of(card);
      if (next.sum() >= 17) {
        last.emplace_back(next, share);
      } else {
        open[next.hard][next.ace] += share;
      }
    }
  };
  draw(Hand{}.with(shown), 1.0, true);
  for (std::uint32_t hard = 0; hard < 17; ++hard) {  // a card leads to a larger hard sum
    for (const bool ace : {false, true}) {
      if (open[hard][ace] > 0.0) draw({hard, ace, false}, open[hard][ace], false);
    }
  }
  return last;
}

using Outcomes = std::map<std::pair<State, double>, double>;  // (next, reward): probability

void write(TableWriter& table, Action action, const Outcomes& outcomes) {
  table.choice(action);
  for (const auto& [to, probability] : outcomes) {  // a sum of shares may round to above 1
    table.outcome(std::min(probability, 1.0), to.first, to.second);
  }
}

Result<Mdp> blackjack_model(Rules rules) {
  TableWriter table(0.99);
  std::vector<std::vector<std::pair<Hand, double>>> dealer;
  for (std::uint32_t shown = 1; shown <= 10; ++shown) dealer.push_back(dealer_hands(shown));
  for (State s = 0; s < lost; ++s) {
    table.state(state_name(s));
    const Hand player = hand_of(cards_of(s));
    Outcomes stick, hit;
    for (const auto& [hand, probability] : dealer[s % 10]) {
      const double reward = settle(rules, player, hand);
      stick[{end_of(reward), reward}] += probability;
    }
    for (std::uint32_t card = 1; card <= 10; ++card) {
      const State next = state_of(player.with(card), s % 10 + 1);
      hit[{next, next == lost ? -1.0 : 0.0}] += probability_of(card);
    }
    write(table, 0, stick);
    write(table, 1, hit);
  }
  for (const State s : {lost, drawn, won}) table.state(state_name(s));
  std::map<State, double> starts;
  for (std::uint32_t shown = 1; shown <= 10; ++shown) {
    for (std::uint32_t first = 1; first <= 10; ++first) {
      for (std::uint32_t second = 1; second <= 10; ++second) {
        starts[state_of(hand_of({first, second}), shown)] +=
            probability_of(shown) * probability_of(first) * probability_of(second);
      }
    }
  }
  for (const auto& [s, probability] : starts) table.start(s, probability);
  for (const std::string_view name : {"stick", "hit"}) table.arrays().action_names.push_back(name);
  return table.finish();
}

struct Blackjack {
  struct Position {
    std::vector<std::uint32_t> player, dealer;
    std::uint32_t suit = 0, face = 0, result = 0;

    template <class A>
    void persist(A& archive) {
      archive("player", player);
      archive("dealer", dealer);
      archive("suit", suit);
      archive("face", face);
      archive("result", result);
      if (!archive.saving() && !sound()) {
        archive.fail(
            "at least two cards of the player and one of the dealer, each from 1 to 10, not "
            "more after a sum of 21 or 17, suit, face and result at most 3, 2 and 3 expected");
      }
    }

   private:
    static bool is_hand(const std::vector<std::uint32_t>& cards, std::uint32_t last) {
      Hand hand;
      for (const std::uint32_t card : cards) {
        if (card < 1 || card > 10 || hand.sum() >= last) return false;
        hand = hand.with(card);
      }
      return !cards.empty();
    }
    bool sound() const {
      return is_hand(player, 22) && is_hand(dealer, 17) && player.size() >= 2 && suit < 4 &&
             face < 3 && result <= 3 && (hand_of(player).sum() <= 21 || result == 1) &&
             (result != 0 || dealer.size() <= 2);
    }
  };
  Rules rules;

  Spaces spaces() const { return {.actions = 2, .states = states}; }
  Action actions(State s) const { return s < lost ? 2 : 0; }
  std::vector<std::string> action_names() const { return {"stick", "hit"}; }
  State number(const Position& at) const {
    return at.result > 0 ? lost + at.result - 1 : state_of(hand_of(at.player), at.dealer[0]);
  }
  Position position(State s) const {
    if (s >= lost) return {{10, 10}, {10}, 0, 0, s - lost + 1};
    return {cards_of(s), {s % 10 + 1}, 0, 0, 0};
  }

  Position start(auto& dice) const {
    Position at;
    for (std::vector<std::uint32_t>* const hand : {&at.dealer, &at.player}) {
      for (int i = 0; i < 2; ++i) hand->push_back(card(dice));
    }
    at.suit = dice.below(4);
    if (at.dealer[0] == 10) at.face = dice.below(3);
    return at;
  }
  Feedback step(Position& at, Action action, auto& dice) const {
    if (at.result > 0) return {0.0, true, false};
    if (action == 1) {
      at.player.push_back(card(dice));
      if (hand_of(at.player).sum() <= 21) return {0.0, false, false};
      at.result = 1;
      return {-1.0, true, false};
    }
    while (hand_of(at.dealer).sum() < 17) at.dealer.push_back(card(dice));
    const double reward = settle(rules, hand_of(at.player), hand_of(at.dealer));
    at.result = end_of(reward) - lost + 1;
    return {reward, true, false};
  }

  Tree observation(const Position& at) const {
    const Hand hand = hand_of(at.player);
    return Tree(Tree::List{Tree(std::int64_t{hand.sum()}), Tree(std::int64_t{at.dealer[0]}),
                           Tree(std::int64_t{hand.usable()})});
  }
  std::string text(const Position& at) const {
    constexpr std::string_view suits[] = {"clubs", "diamonds", "hearts", "spades"};
    constexpr std::string_view faces[] = {"J", "Q", "K"};
    std::string text = "dealer  ";
    text += at.dealer[0] == 10 ? std::string(faces[at.face]) : card_name(at.dealer[0]);
    text += " of " + std::string(suits[at.suit]);
    if (at.result == 0 || at.dealer.size() == 1) text += ", one card hidden";
    for (std::size_t i = 1; i < at.dealer.size() && at.result > 0; ++i) {
      text += ", " + card_name(at.dealer[i]);
    }
    if (at.result > 0) text += ": " + std::to_string(hand_of(at.dealer).sum());
    text += "\nplayer  ";
    for (const std::uint32_t card : at.player) text += card_name(card) + ", ";
    text.resize(text.size() - 2);
    const Hand hand = hand_of(at.player);
    text += ": " + std::string(hand.usable() ? "soft " : "") + std::to_string(hand.sum());
    if (at.result > 0) text += ", " + state_name(lost + at.result - 1);
    return text + '\n';
  }

 private:
  static std::uint32_t card(auto& dice) {
    const std::uint32_t drawn_card = dice.below(13);
    return drawn_card < 9 ? drawn_card + 1 : 10;
  }
};

Result<World> make(const Parameters& parameters) {
  const Result<BlackjackSettings> settings =
      read_parameters<BlackjackSettings>("blackjack", parameters);
  if (!settings) return settings.error();
  Result<Mdp> mdp = blackjack_model(settings->rules);
  if (!mdp) return mdp.error();
  World world = to_world("blackjack", std::move(*mdp), {}, 0, settings->seeding);
  world.make = [game = Blackjack{settings->rules}, seeding = settings->seeding](Lanes lanes) {
    return batch(game, lanes, seeding);
  };
  return world;
}

}  // namespace

extern const WorldEntry blackjack_world;
const WorldEntry blackjack_world{"blackjack",
                                 "Blackjack-v1",
                                 "draw cards towards 21 against a dealer",
                                 "Sutton and Barto 2018, example 5.1; Gymnasium, Blackjack-v1",
                                 make,
                                 parameters_of<BlackjackSettings>};

}  // namespace quoll

#pragma once
// A settings struct says once, in describe(Describer&), what each field is called, which values it
// takes and what it means. Command line, TOML, help, manual page, reports and checkpoints read
// that.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "quoll/base/error.hpp"

namespace quoll {

/// A field that holds one of a fixed list of words, stored as its index.
struct Choice {
  std::uint8_t* value;
  std::span<const std::string_view> names;
};

/// One described field. The pointers lead into the described struct, which must outlive this. Both
/// bounds are allowed values; an end that is excluded is given by the next double inside, and shown
/// as such: low = denorm_min, high = 1 is "(0, 1]".
struct Setting {
  std::string_view name;      ///< snake_case key; the flag is the same with '-' for '_'
  std::string_view sentence;  ///< one sentence for people, without its readers
  std::variant<bool*, std::int64_t*, std::uint64_t*, double*, std::string*, Choice> field;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// Words, ", " between them, of which one must be chosen for the field to be read, and " with "
  /// between several such lists; empty = always read.
  std::string_view readers = {};
};

/// Collects the fields of a settings struct.
class Describer {
 public:
  /// Describes fields that only some read: d.of("dqn, nfq")("replay", ...).
  class Part {
   public:
    Part(Describer& all, std::string_view readers) : all_(all), readers_(readers) {}
    template <class T, class... Rest>
    void operator()(std::string_view name, T& field, Rest... rest) {
      all_(name, field, rest...);
      all_.settings_.back().readers = readers_;
    }
    template <class Enum>
    void choice(std::string_view name, Enum& field, std::span<const std::string_view> names,
                std::string_view sentence) {
      all_.choice(name, field, names, sentence);
      all_.settings_.back().readers = readers_;
    }

   private:
    Describer& all_;
    std::string_view readers_;
  };
  Part of(std::string_view readers) { return {*this, readers}; }

  template <class T>
  void operator()(std::string_view name, T& field, std::string_view sentence) {
    settings_.push_back({name, sentence, &field});
  }
  template <class T>
  void operator()(std::string_view name, T& field, double low, double high,
                  std::string_view sentence) {
    settings_.push_back({name, sentence, &field, low, high});
  }
  template <class Enum>
  void choice(std::string_view name, Enum& field, std::span<const std::string_view> names,
              std::string_view sentence) {
    static_assert(sizeof(Enum) == 1, "a choice is an enum class over std::uint8_t");
    settings_.push_back({name, sentence, Choice{reinterpret_cast<std::uint8_t*>(&field), names}});
  }
  std::vector<Setting>& settings() { return settings_; }

 private:
  std::vector<Setting> settings_;
};

template <class Struct>
std::vector<Setting> settings_of(Struct& values) {
  Describer describer;
  values.describe(describer);
  return std::move(describer.settings());
}

/// The field's value as text that assign() takes back unchanged.
std::string text_of(const Setting& setting);

/// "dqn, nfq: what it means": the sentence with its readers.
std::string sentence_of(const Setting& setting);

/// What the field takes, for help: "number in [0, 1]", "uniform | greedy | ...".
std::string range_of(const Setting& setting);

/// Parses `text` into the field; a nan is no number here. On an error the field is unchanged.
/// Errors name the key as `place` (a flag or file:line), the range and the nearest word.
Result<void> assign(const Setting& setting, std::string_view text, std::string_view place);

/// The setting called `name` ('-' and '_' are the same), or nullptr.
const Setting* find(std::span<const Setting> settings, std::string_view name);

}  // namespace quoll

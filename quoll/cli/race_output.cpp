#include "quoll/cli/race_output.hpp"

#include "quoll/base/json.hpp"

namespace quoll::cli {
namespace {

void write_quartiles(JsonWriter& json, std::string_view key, const Quartiles& quartiles) {
  json.key(key).begin_object().member("lower", quartiles.lower);
  json.member("median", quartiles.median).member("upper", quartiles.upper).end_object();
}

void write_entrant(JsonWriter& json, const EntrantResult& entrant) {
  json.begin_object().member("entrant", entrant.word).member("settings", entrant.settings);
  if (entrant.note.empty())
    json.null_member("note");
  else
    json.member("note", entrant.note);
  if (entrant.refused.empty())
    json.null_member("refused");
  else
    json.member("refused", entrant.refused);
  write_quartiles(json, "steps", entrant.steps);
  write_quartiles(json, "seconds", entrant.seconds);
  json.member("seconds_per_step", entrant.step_seconds).member("failures", entrant.failures);
  json.member("bytes", entrant.bytes);
  json.member("fewer_steps", entrant.fewer_steps).member("fewer_seconds", entrant.fewer_seconds);
  json.key("heats").begin_array();
  for (const Heat& heat : entrant.heats) {
    json.begin_object().member("seed", heat.seed);
    json.member("end", heat_end_names[static_cast<std::size_t>(heat.end)]);
    json.member("steps", heat.steps).member("seconds", heat.seconds);
    json.member("bytes", heat.bytes).end_object();
  }
  json.end_array().end_object();
}

void write_race(JsonWriter& json, const RaceResult& race) {
  json.begin_object().member("world", race.world);
  json.member("mode", race_mode_names[static_cast<std::size_t>(race.mode)]);
  json.member("discount", race.discount);
  json.member("states", race.states).member("choices", race.choices);
  json.member("deterministic", race.deterministic);
  json.member("seeds", race.seeds).member("seed", race.first_seed);
  json.member("cap_steps", race.cap_steps);
  if (race.cap_seconds > 0.0)
    json.member("cap_seconds", race.cap_seconds);
  else
    json.null_member("cap_seconds");
  json.member("interrupted", race.interrupted).key("entrants").begin_array();
  for (const EntrantResult& entrant : race.entrants) write_entrant(json, entrant);
  json.end_array().end_object();
}

}  // namespace

std::string race_json(const RaceResult& race) {
  JsonWriter json(JsonStyle::pretty);
  write_race(json, race);
  return json.text() + "\n";
}

std::string suite_json(std::string_view suite, std::span<const PageRace> races) {
  JsonWriter json(JsonStyle::pretty);
  json.begin_object().member("suite", suite).key("races").begin_array();
  for (const PageRace& race : races) {
    json.begin_object().member("name", race.name).key("race");
    write_race(json, race.result);
    json.end_object();
  }
  json.end_array().end_object();
  return json.text() + "\n";
}

}  // namespace quoll::cli

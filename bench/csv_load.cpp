// How fast, and in how much memory, a CSV world of many named rows becomes a model: seconds, rows
// per second, bytes of the arrays, peak resident memory. The same work as `quoll check FILE.csv`
// does before its first finding.
//
//   csv_load [rows] [grouped|random] [file]
//
// "grouped" has 4 actions per state and 3 outcomes per action, each state's rows together and the
// successors anywhere; "random" the same rows in random order, which need sorting.

#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "quoll/base/random.hpp"
#include "quoll/model/formats/format.hpp"

namespace {

constexpr std::uint64_t rows_per_state = 12;

// The row number `row` of a world with `states` states, without a table: three outcomes with
// probabilities 0.5, 0.3, 0.2 and a reward per action.
void write_row(std::FILE* file, std::uint64_t row, std::uint64_t states) {
  static constexpr const char* probability[] = {"0.5", "0.3", "0.2"};
  const std::uint64_t state = row / rows_per_state;
  const std::uint64_t action = row % rows_per_state / 3;
  const std::uint64_t next = quoll::mix(row) % states;
  std::fprintf(file, "s%llu,a%llu,s%llu,%s,-%llu.25\n", static_cast<unsigned long long>(state),
               static_cast<unsigned long long>(action), static_cast<unsigned long long>(next),
               probability[row % 3], static_cast<unsigned long long>(action));
}

bool generate(const std::string& path, std::uint64_t rows, bool random) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  std::fputs("# discount = 0.9\nstate,action,next_state,probability,reward\n", file);
  const std::uint64_t states = rows / rows_per_state;
  // A walk with a step coprime to the number of rows meets each row once, in no useful order.
  std::uint64_t step = 1;
  if (random) {
    for (step = rows / 2 + 1;; ++step) {
      std::uint64_t a = step;
      std::uint64_t b = rows;
      while (b != 0) {
        const std::uint64_t rest = a % b;
        a = b;
        b = rest;
      }
      if (a == 1) break;
    }
  }
  std::uint64_t row = 0;
  for (std::uint64_t i = 0; i < rows; ++i, row = (row + step) % rows) write_row(file, row, states);
  return std::fclose(file) == 0;
}

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

int main(int count, char** values) {
  std::uint64_t rows = count > 1 ? std::strtoull(values[1], nullptr, 10) : 10'000'000;
  const bool random = count > 2 && std::strcmp(values[2], "random") == 0;
  const std::string path = count > 3 ? values[3] : "csv_load.csv";
  rows -= rows % rows_per_state;
  if (rows == 0 || !generate(path, rows, random)) {
    std::fprintf(stderr, "csv_load: cannot write %s\n", path.c_str());
    return 1;
  }
  const std::uint64_t before = peak_bytes();
  const auto begin = std::chrono::steady_clock::now();
  const auto mdp = quoll::read_model(path);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (!mdp) {
    std::fprintf(stderr, "%s\n", quoll::message(mdp.error()).c_str());
    return 1;
  }
  if (count <= 3) std::remove(path.c_str());
  const double megabyte = 1e6;
  const auto bytes = static_cast<double>(mdp->bytes());
  const auto peak = static_cast<double>(peak_bytes());
  std::printf("rows %llu, states %llu, choices %llu, outcomes %llu, order %s\n",
              static_cast<unsigned long long>(rows), static_cast<unsigned long long>(mdp->states()),
              static_cast<unsigned long long>(mdp->choices()),
              static_cast<unsigned long long>(mdp->outcomes()), random ? "random" : "grouped");
  std::printf("seconds %.2f, rows per second %.1f M\n", seconds.count(),
              static_cast<double>(rows) / seconds.count() / 1e6);
  std::printf("arrays %.0f MB, peak %.0f MB (before loading %.0f MB), peak / arrays %.2f\n",
              bytes / megabyte, peak / megabyte, static_cast<double>(before) / megabyte,
              peak / bytes);
  return 0;
}

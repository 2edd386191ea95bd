// Logs of steps: columns in any order, and one error with its place for whatever is none.

#include "quoll/model/formats/step_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace quoll {
namespace {

// Each row as "state action reward next ended cut"; then the error, if there is one.
std::vector<std::string> rows_of(std::string_view text) {
  Lines lines(text);
  StepLog log(lines, "log.csv");
  std::vector<std::string> rows;
  LoggedStep step;
  while (log.next(step)) {
    rows.push_back(std::string(step.state) + " " + std::string(step.action) + " " +
                   std::to_string(step.reward) + " " + std::string(step.next_state) + " " +
                   (step.terminated ? "1" : "0") + (step.truncated ? "1" : "0"));
  }
  if (log.error()) rows.push_back(message(*log.error()));
  return rows;
}

TEST(StepLog, FindsItsColumnsByName) {
  const std::vector<std::string> expected = {"A go 1.500000 B 00", "B stop, now -2.000000 C 10"};
  EXPECT_EQ(rows_of("state,action,reward,next_state,terminated,truncated\n"
                    "A,go,1.5,B,0,0\n"
                    "B,\"stop, now\",-2,C,1,0\n"),
            expected);
  EXPECT_EQ(rows_of("# from a robot\r\nt,terminated,next_state,reward,action,state\r\n"
                    "0,False,B,1.5,go,A\r\n,,,,,\r\n1,True,C,-2,\"stop, now\",B\r\n"),
            expected);
}

TEST(StepLog, AnEndNeedsNoSuccessor) {
  EXPECT_EQ(rows_of("state,action,reward,next_state,terminated\nA,go,1,,1\n"),
            std::vector<std::string>{"A go 1.000000  10"});
  EXPECT_EQ(rows_of("state,action,reward,next_state,terminated\nA,go,1,,0\n"),
            std::vector<std::string>{"log.csv:2:8: a name expected for the next_state"});
}

TEST(StepLog, StopsAtTheFirstRowThatIsNone) {
  const std::vector<std::string> expected = {
      "A go 1.000000 B 00", "log.csv:3:10: 0, 1, false or true expected for terminated, not 'yes'"};
  EXPECT_EQ(
      rows_of("state,action,reward,next_state,terminated\nA,go,1,B,0\nB,go,1,A,yes\nA,go,1\n"),
      expected);
}

TEST(StepLog, NamesTheColumnThatIsMissing) {
  EXPECT_EQ(rows_of("state,action,rewards,next_state,terminated\n"),
            std::vector<std::string>{"log.csv:1:14: a column 'reward' expected, not 'rewards'"});
  EXPECT_EQ(rows_of("state,action,reward,next_state\n"),
            std::vector<std::string>{"log.csv:1: a column 'terminated' expected"});
}

}  // namespace
}  // namespace quoll

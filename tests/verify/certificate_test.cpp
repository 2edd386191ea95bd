#include "quoll/verify/certificate.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "../solve/models.hpp"
#include "quoll/model/digest.hpp"

namespace quoll {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Mdp odd_names() {
  MdpBuilder b(0.5);
  b.move("a, b", "say \"go\"", "end", 1).move("a, b", "stay", "a, b", 0);
  b.move("c", "stay", "a, b", 0);
  return test::built(b);  // "a, b", "end", "c"
}

Certificate about(const Mdp& mdp) {
  return {"odd",
          {{"size", "5"}, {"--goal", "a=b"}},
          digest(mdp),
          0.1,
          false,
          "some-method",
          {0.1 + 0.2, 0.0, -inf},
          {0x1.fffffffffffffp1023, 0.0, inf},
          {0, no_action, no_action}};
}

std::string saved(const std::string& text) {
  const std::string path = testing::TempDir() + "quoll_certificate.cert";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The one line a damaged file gives, without the file's name.
std::string complaint(const std::string& text, const Mdp& mdp) {
  const std::string path = saved(text);
  auto open = open_certificate(path);
  if (!open) return message(open.error()).substr(path.size());
  const auto fits = read_claims(*open, mdp);
  return fits ? "" : message(fits.error()).substr(path.size());
}

TEST(Certificate, ComesBackBitForBit) {
  const Mdp mdp = odd_names();
  const Certificate written = about(mdp);
  const auto text = certificate_text(written, mdp);
  ASSERT_TRUE(text);
  const std::string path = saved(*text);
  EXPECT_TRUE(is_certificate(path));
  auto open = open_certificate(path);
  ASSERT_TRUE(open) << message(open.error());
  const auto fits = read_claims(*open, mdp);
  ASSERT_TRUE(fits && fits->accepted);
  const Certificate& read = open->content;
  EXPECT_EQ(read.world, written.world);
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(read.digest, written.digest);
  EXPECT_EQ(read.discount, written.discount);
  EXPECT_EQ(read.maximise, written.maximise);
  EXPECT_EQ(read.method, written.method);
  EXPECT_EQ(read.lower, written.lower);
  EXPECT_EQ(read.upper, written.upper);
  EXPECT_EQ(read.policy, written.policy);
}

TEST(Certificate, StatesMayStandInAnyOrderAndLinesEndAsOnWindows) {
  const Mdp mdp = odd_names();
  auto open = open_certificate(
      saved("quoll certificate 1\r\nmodel = 0000000000000000\r\ndiscount = 0.5\r\n"
            "objective = maximise\r\nstates = 3\r\nstate,action,lower,upper\r\n"
            "c,stay,0,1\r\nend,,0,0\r\n\"a, b\",\"say \"\"go\"\"\",1,1\r\nend\r\n"));
  ASSERT_TRUE(open) << message(open.error());
  const auto fits = read_claims(*open, mdp);
  ASSERT_TRUE(fits && fits->accepted);
  EXPECT_EQ(open->content.upper, (std::vector<double>{1, 0, 1}));
  EXPECT_EQ(open->content.policy, (std::vector<Action>{0, no_action, 0}));
}

TEST(Certificate, ADamagedFileIsOneLine) {
  const Mdp mdp = odd_names();
  const std::string text = *certificate_text(about(mdp), mdp);
  EXPECT_EQ(complaint(text, mdp), "");
  for (std::size_t length = 0; length < text.size(); length += 3) {
    const std::string why = complaint(text.substr(0, length), mdp);
    // Only the end of the last line may be missing.
    EXPECT_EQ(why.empty(), length + 1 >= text.size()) << length;
    EXPECT_EQ(why.find('\n'), std::string::npos);
  }
  EXPECT_EQ(complaint(text + "more\n", mdp), ":15: nothing expected after the line 'end'");
  EXPECT_EQ(complaint("state,action\n", mdp),
            ": not a certificate: it does not begin with 'quoll certificate 1'");
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& why) {
    EXPECT_EQ(complaint(changed(text, from, to), mdp), why);
  };
  expect("certificate 1", "certificate 2",
         ":1: written by another Quoll (certificate 2, this program reads 1)");
  expect("discount = 0.1", "discount = 1.5",
         ":6: discount: a number above 0 and at most 1 expected, not '1.5'");
  expect("discount = 0.1", "discount = nan",
         ":6: discount: a number above 0 and at most 1 expected, not 'nan'");
  expect("discount =", "discuont =", ":6: unknown key 'discuont'; did you mean 'discount'?");
  expect("discount = 0.1\n", "", ":9: no line says discount = ...");
  expect("discount = 0.1", "states = 3", ":9: states stands twice");
  expect("minimise", "least", ":7: objective: maximise or minimise expected, not 'least'");
  expect("states = 3", "states = 1099511627776", ": truncated: 3 of 1,099,511,627,776 states");
  expect("states = 3", "states = 2", ":14: states = 2, but 3 stand here");
  expect("end,,0,0", "end,,0,zero", ":12:8: a number expected, not 'zero'");
  expect("end,,0,0", "end,,nan,0", ":12:6: a number expected, not 'nan'");
  expect("end,,0,0", "end,,0", ":12: 'state,action,lower,upper' expected, found 3 fields");
  expect("end,,0,0", "c,,0,0", ":13: state c stands twice");
  expect("\"a, b\"", "\"a, b", ":11:8: a quote without its partner, or followed by text");
}

TEST(Certificate, WhatDoesNotFitTheModelIsRefusedWithTheState) {
  const Mdp mdp = odd_names();
  const std::string text = *certificate_text(about(mdp), mdp);
  const auto refused = [&](const std::string& from, const std::string& to) {
    auto open = open_certificate(saved(changed(text, from, to)));
    const auto fits = read_claims(*open, mdp);
    EXPECT_FALSE(fits->accepted);
    return fits->reason;
  };
  EXPECT_EQ(refused("end,,0,0", "goal,,0,0"), "state goal of the certificate is not in the model");
  EXPECT_EQ(refused("end,,0,0", "end,jump,0,0"), "state end: it has no action 'jump'");
  const Mdp more = test::adventure();
  auto open = open_certificate(saved(text));
  EXPECT_EQ(read_claims(*open, more)->reason, "state a, b of the certificate is not in the model");
  open = open_certificate(saved(changed(changed(text, "c,,-inf,inf\n", ""), "= 3", "= 2")));
  const auto fits = read_claims(*open, mdp);
  EXPECT_EQ(fits->reason, "state c: the certificate does not speak of it");
  EXPECT_EQ(fits->state, std::optional<State>(2));
}

}  // namespace
}  // namespace quoll

// What a confined process can do, and what its end is called.
#include "unilateral/base/confined_process.h"
#include "unilateral/base/progress.h"
#include "unilateral/base/visible_text.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{
  using namespace unilateral;
  using End = ConfinedResult::End;

  ConfinedResult confined(const std::function<std::string()> &work, const SandboxRules &rules = {}, const std::function<bool()> &stop = {})
  {
    return run_confined([] {}, [&](const SandboxState &) { return work(); }, rules, stop);
  }

  std::string by_number(const bool succeeded)
  {
    return succeeded ? "done" : "refused";
  }
} // namespace

TEST(Sandbox, returns_what_the_work_returns)
{
  EXPECT_EQ(confined([] { return std::string(3'000'000, 'x'); }).answer, std::string(3'000'000, 'x'));
  EXPECT_EQ(confined([] { return ""; }).end, End::finished);
  EXPECT_EQ(confined([] { return std::getenv("PATH") ? "has an environment" : "has none"; }).answer, "has none");
  const auto result = confined(
    []
    {
      std::string text;
      std::thread([&] { text = "threads run"; }).join();
      return text;
    });
  EXPECT_EQ(result.answer, "threads run");
}

TEST(Sandbox, refuses_commands_network_and_writing)
{
  EXPECT_EQ(confined([] { return by_number(std::system("true") == 0); }).end, End::command);
  EXPECT_EQ(confined([] { return by_number(fork() >= 0); }).end, End::command);
  EXPECT_EQ(confined(
              []
              {
                char *const arguments[] = {nullptr};
                return by_number(execve("/bin/true", arguments, arguments) == 0);
              })
              .end,
            End::command);
  EXPECT_EQ(confined([] { return by_number(static_cast<bool>(std::ofstream("/tmp/unilateral-must-not-be"))); }).end, End::writing);
  EXPECT_NE(access("/tmp/unilateral-must-not-be", F_OK), 0);
  EXPECT_EQ(confined([] { return by_number(socket(AF_INET, SOCK_STREAM, 0) >= 0); }).answer, "refused");
  EXPECT_EQ(confined([] { return by_number(mkdir("/tmp/unilateral-must-not-be", 0700) == 0); }).answer, "refused");
  EXPECT_EQ(confined([] { return by_number(kill(getppid(), 0) == 0); }).answer, "refused");
  EXPECT_EQ(confined([] { return by_number(unlink("/tmp/unilateral-is-not-there") == 0 || errno == ENOENT); }).answer, "refused");
}

TEST(Sandbox, reads_only_what_it_may)
{
  const auto reads = [](const std::string &file, const SandboxRules &rules)
  {
    return run_confined([] {},
                        [&](const SandboxState &state)
                        { return state.paths ? by_number(static_cast<bool>(std::ifstream(file))) : "no Landlock"; },
                        rules, {})
      .answer;
  };
  SandboxRules rules;
  rules.readable = {PROJECT_DIR "/tests/data", PROJECT_DIR "/README.md"};
  if (reads("/etc/passwd", rules) == "no Landlock")
    GTEST_SKIP();
  EXPECT_EQ(reads("/etc/passwd", rules), "refused");
  EXPECT_EQ(reads(PROJECT_DIR "/tests/data/square.geo", rules), "done");
  EXPECT_EQ(reads(PROJECT_DIR "/README.md", rules), "done");
  EXPECT_EQ(reads(PROJECT_DIR "/LICENSE", rules), "refused");
}

TEST(Sandbox, names_every_end)
{
  EXPECT_EQ(confined([]() -> std::string { std::exit(0); }).end, End::exited);
  EXPECT_EQ(confined([]() -> std::string { throw std::runtime_error("no"); }).end, End::crashed);
  const auto crash = confined(
    []() -> std::string
    {
      std::raise(SIGSEGV);
      return "";
    });
  EXPECT_EQ(crash.end, End::crashed);
  EXPECT_EQ(confined([]() -> std::string { std::abort(); }).signal, SIGABRT);

  SandboxRules little;
  little.memory = std::uint64_t(64) << 20;
#ifndef __SANITIZE_ADDRESS__ // which ends the process itself then
  // Of which a byte is looked at: memory that nobody reads, a compiler need not take.
  volatile std::size_t some = 12345;
  EXPECT_EQ(confined([&some] { return std::string(1, std::vector<char>(std::size_t(1) << 30, 'x')[some]); }, little).end,
            End::out_of_memory);
#endif
  little.cpu_seconds = 1;
  EXPECT_EQ(confined(
              []() -> std::string
              {
                for (volatile bool go_on = true; go_on;)
                  ;
                return "";
              },
              little)
              .end,
            End::out_of_time);
}

TEST(Sandbox, does_not_wait_for_one_that_waits)
{
  SandboxRules rules;
  rules.idle_seconds = 0.5;
  EXPECT_EQ(confined(
              []() -> std::string
              {
                for (;;)
                  sleep(1);
              },
              rules)
              .end,
            End::out_of_time);
}

TEST(Sandbox, stops_when_asked)
{
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(confined(
                 []() -> std::string
                 {
                   for (;;)
                     pause();
                 },
                 {}, [&] { return std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(300); }),
               Interrupted);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 1.3);
}

TEST(VisibleText, has_nothing_that_a_terminal_obeys)
{
  EXPECT_EQ(visible("Straße, 曲面, ∂Ω, 😀"), "Straße, 曲面, ∂Ω, 😀");
  EXPECT_EQ(visible("a\033[31mb\a\r\t\x7f"), "a\\x1b[31mb\\x07\\x0d\\x09\\x7f");
  EXPECT_EQ(visible("a\nb"), "a\\nb");
  EXPECT_EQ(visible_lines("a\nb\033"), "a\nb\\x1b");
  EXPECT_EQ(visible("\xc2\x9b\xe2\x80\xae\xe2\x80\xa8"), "\\u009b\\u202e\\u2028");
  EXPECT_EQ(visible("\xff\xc3(\xe2\x82"), "\\xff\\xc3(\\xe2\\x82") << "no UTF-8";
  EXPECT_EQ(visible("\xc0\x9b\xed\xa0\x80"), "\\xc0\\x9b\\xed\\xa0\\x80") << "UTF-8 that hides what it means";
  EXPECT_EQ(visible(std::string("\0", 1)), "\\x00");
}

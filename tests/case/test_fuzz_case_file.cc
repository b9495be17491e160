// Whatever the bytes, a case is read or refused with messages: no crash, no other exception, no hang, no large allocation.
#include "mutated_case_text.h"

using namespace unilateral;

TEST(FuzzCaseFile, TenThousandMutationsAreReadOrRefused)
{
  expect_mutations_to_be_read_or_refused(10000, 20240229);
}

TEST(FuzzCaseFile, HostileTextsAreRefused)
{
  const std::string rest = "\n[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n[exact]\nu = ";
  const auto        repeat = [](const std::string &piece, const unsigned n)
  {
    std::string text;
    for (unsigned i = 0; i < n; ++i)
      text += piece;
    return text;
  };
  for (const std::string &text :
       {std::string(), std::string("\0", 1), repeat("[", 100000), "a = " + repeat("[", 100000), "a = " + repeat("{a=", 100000),
        repeat("a.", 100000) + "a = 1", "[" + repeat("a.", 100000) + "a]", repeat("\"a\" . ", 100000) + "a = 1",
        rest + "\"" + repeat("(", 5000) + "\"", rest + "\"" + repeat("(", 100000) + "\"", rest + "\"" + repeat("-", 5000) + "x\"",
        rest + "\"" + repeat("sin(", 2000) + "\"", rest + "\"" + repeat("x?", 2000) + "\"", rest + "\"" + std::string(200, 'a') + "\"",
        rest + "\"" + std::string(5000, '9') + "\""})
    EXPECT_FALSE(read_or_refuse(text)) << text.substr(0, 60);

  // Deep but sound.
  for (const std::string &expression :
       {repeat("(", 2000) + "x" + repeat(")", 2000), repeat("sin(", 1000) + "x" + repeat(")", 1000), repeat("x>0?1:", 1000) + "0",
        "x" + repeat("+x", 4000), "x" + repeat("^x", 1000), "max(x" + repeat(",x", 1000) + ")"})
    EXPECT_TRUE(read_or_refuse(rest + "\"" + expression + "\"")) << expression.substr(0, 60);
}

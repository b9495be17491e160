#include "unilateral/report/report.h"

#include "unilateral/base/sha256.h"
#include "unilateral/report/html.h"
#include "unilateral/report/report_page.h"
#include "unilateral/report/svg_plot.h"
#include "unilateral/report/verdict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace
{
  using namespace unilateral;
  using Json = nlohmann::ordered_json;

  const std::string hostile = "</script><img src=x onerror=alert(1)>\"'&";

  ResultsFolder results()
  {
    ResultsFolder folder;
    folder.name = hostile;
    folder.results =
      Json{{"status", "converged"},
           {"case", {{"path", hostile}, {"title", hostile}, {"expanded", hostile}}},
           {"constraint", {{{"on", hostile}, {"side", "lower"}, {"n_points", 9}, {"n_active", 3}, {"total_contact_force", 4.25}}}},
           {"solution", {{"norm_energy", 2.0}, {"energy", 1.5}}},
           {"certificate", {{"available", true}, {"penalty_error_bound", 2e-6}, {"discretisation_indicator", 0.4}}},
           {"solver", {{"reason", "done"}, {"history", {{{"level", 0}, {"residual", 1.0}}, {{"level", 0}, {"residual", 1e-9}}}}}},
           {"warnings", {{{"message", hostile}}}},
           {"expect", {{{"quantity", "a"}, {"value", 1.0}, {"expected", 2.0}, {"rtol", 0.1}, {"atol", 0.0}, {"passed", false}}}}};
    folder.log = hostile;
    return folder;
  }

  TEST(Verdict, SaysWhatIsGuaranteed)
  {
    ResultsFolder folder = results();
    EXPECT_NE(verdict_sentence(*folder.results).find("estimated"), std::string::npos);
    (*folder.results)["estimate"] = {{"total", 0.06}, {"relative", 0.03}, {"guaranteed", true}};
    EXPECT_NE(verdict_sentence(*folder.results).find("exact solution at most 3 % (guaranteed)"), std::string::npos)
      << verdict_sentence(*folder.results);
    EXPECT_EQ(verdict_sentence(*folder.results).find("estimated"), std::string::npos);
    (*folder.results)["estimate"]["guaranteed"] = false;
    EXPECT_NE(verdict_sentence(*folder.results).find("estimated"), std::string::npos);
  }

  TEST(Verdict, gives_no_share_of_an_energy_norm_that_is_zero)
  {
    ResultsFolder folder = results();
    folder.results->erase("expect");
    (*folder.results)["solution"]["norm_energy"] = 6e-15;
    (*folder.results)["estimate"] = {{"total", 7e-15}, {"relative", nullptr}, {"nothing_deforms", true}, {"guaranteed", true}};
    EXPECT_EQ(verdict_sentence(*folder.results), "solved; nothing deforms");
    std::string number;
    for (const VerdictItem &item : verdict_of(*folder.results))
    {
      EXPECT_EQ(item.number.find("of the energy norm"), std::string::npos) << item.number;
      if (item.what == "Error in the energy norm")
        number = item.number;
    }
    EXPECT_EQ(number, "at most 7.0e-15, guaranteed");
  }

  std::string between(const std::string &text, const std::string &from, const std::string &to)
  {
    const std::size_t begin = text.find(from) + from.size();
    return text.substr(begin, text.find(to, begin) - begin);
  }

  TEST(Html, EscapesWhatWouldBeMarkup)
  {
    EXPECT_EQ(escaped("a<b & \"c\">'"), "a&lt;b &amp; &quot;c&quot;&gt;&#39;");
    EXPECT_EQ(escaped(std::string("\x1b") + "[2J"), "\\x1b[2J");
  }

  TEST(Html, EncodesBytesByBase64)
  {
    const auto of = [](const std::string &text) { return base64(text.data(), text.size()); };
    EXPECT_EQ(of(""), ""); // RFC 4648, 10
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  }

  TEST(Report, HasNoMarkupFromOutside)
  {
    const std::string html = report_html({results()});
    EXPECT_EQ(html.find("<img src=x"), std::string::npos);
    EXPECT_EQ(html.find("onerror=alert(1)>"), std::string::npos);
    EXPECT_NE(html.find("&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;"), std::string::npos);
    // The elements that end a script are those of the page itself.
    std::size_t n = 0;
    for (std::size_t at = html.find("</script"); at != std::string::npos; at = html.find("</script", at + 1))
      ++n;
    EXPECT_EQ(n, 2);
  }

  TEST(Report, RunsItsOwnScriptAlone)
  {
    const std::string html = report_html({results()}), policy = between(html, "Content-Security-Policy\" content=\"", "\">");
    EXPECT_EQ(policy.find("default-src 'none'"), 0);
    const std::string hex = sha256(std::string(report_script()));
    std::string       bytes;
    for (std::size_t k = 0; k < hex.size(); k += 2)
      bytes += char(std::stoi(hex.substr(k, 2), nullptr, 16));
    EXPECT_NE(policy.find("script-src 'sha256-" + base64(bytes.data(), bytes.size()) + "'"), std::string::npos);
    EXPECT_EQ(policy.find("unsafe-eval"), std::string::npos);
    EXPECT_EQ(html.find(" src=\"http"), std::string::npos);
    EXPECT_EQ(html.find("@import"), std::string::npos);
  }

  TEST(Report, HoldsItsDataAsJson)
  {
    const std::string html = report_html({results()});
    const Json        data = Json::parse(between(html, "id=\"data\">", "</script>"));
    EXPECT_EQ(data["kind"], "run");
    EXPECT_EQ(data["runs"][0]["title"], hostile);
    EXPECT_TRUE(data["runs"][0]["scene"].is_null());
  }

  TEST(Report, OfSeveralFoldersSetsThemSideBySide)
  {
    ResultsFolder other = results();
    other.name = "other";
    (*other.results)["constraint"][0]["total_contact_force"] = 7.75;
    const std::string html = report_html({results(), other});
    EXPECT_NE(html.find("<section id=\"comparison\">"), std::string::npos);
    EXPECT_NE(html.find("4.25"), std::string::npos);
    EXPECT_NE(html.find("7.75"), std::string::npos);
    EXPECT_NE(html.find("<section id=\"verdict-1\">"), std::string::npos);
    EXPECT_NE(html.find("<section id=\"verdict-2\">"), std::string::npos);
  }

  TEST(Verdict, SaysWhatHoldsAndWhatToDo)
  {
    const auto items = verdict_of(*results().results);
    const auto find = [&](const std::string &start)
    {
      for (const auto &item : items)
        if (item.what.starts_with(start))
          return item;
      return VerdictItem{};
    };
    EXPECT_EQ(find("Solver").kind, VerdictItem::Kind::good);
    EXPECT_EQ(find("Error of the mesh").kind, VerdictItem::Kind::doubtful); // 20 %
    EXPECT_NE(find("Error of the mesh").next.find("mesh.refine"), std::string::npos);
    EXPECT_EQ(find("Error of penalty").number, "at most 1e-06 of the energy norm");
    EXPECT_EQ(find("Expected: a").kind, VerdictItem::Kind::bad);
    EXPECT_EQ(find("Warning").kind, VerdictItem::Kind::doubtful);
    EXPECT_EQ(verdict_sentence(*results().results),
              "solved, but 1 of 1 expectations fail; mesh error about 20 % (estimated), penalty and solver at most 1e-06 (guaranteed)");
    Json failed = *results().results;
    failed["status"] = "not_converged";
    EXPECT_EQ(verdict_of(failed)[0].kind, VerdictItem::Kind::bad);
  }

  TEST(SvgPlot, HasRoundTicks)
  {
    EXPECT_EQ(round_ticks(0, 1, 5), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
    EXPECT_EQ(round_ticks(-3, 3, 6), (std::vector<double>{-3, -2, -1, 0, 1, 2, 3}));
  }

  TEST(SvgPlot, SkipsWhatCannotBeShown)
  {
    Plot              plot{.title = "",
                           .x_label = "x",
                           .y_label = "y",
                           .x_log = true,
                           .y_log = true,
                           .series = {{.name = "a", .x = {1, 10, 100}, .y = {1, 0, 1e-3}}},
                           .slopes = {}};
    const std::string svg = to_svg(plot);
    std::size_t       n = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1))
      ++n;
    EXPECT_EQ(n, 2);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    plot.series[0].y = {std::nan(""), -1, 0};
    EXPECT_EQ(to_svg(plot), "");
  }
} // namespace

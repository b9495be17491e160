#include "unilateral/case/expectations.h"

#include "unilateral/case/case_results.h"
#include "unilateral/case/toml_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    bool is_index(const std::string &word)
    {
      return !word.empty() && word.size() < 10 && std::all_of(word.begin(), word.end(), [](const char c) { return c >= '0' && c <= '9'; });
    }

    /// The node at @p path; nullptr and the reason in @p problem when there is none. @p no_such_entry: is the reason a list too short?
    const Json *find(const Json &json, const std::string &path, std::string &problem, bool *no_such_entry = nullptr)
    {
      const Json *node = &json;
      std::string so_far;
      for (const std::string &word : split_path(path))
      {
        const std::string parent = so_far.empty() ? "the results" : "'" + so_far + "'";
        if (node->is_object())
        {
          if (!node->contains(word))
          {
            std::vector<std::string> known;
            for (const auto &item : node->items())
              known.push_back(item.key());
            problem = fmt::format("no quantity '{}' in {}{}", word, parent, suggestion(word, known));
            return nullptr;
          }
          node = &(*node)[word];
        }
        else if (node->is_array())
        {
          if (!is_index(word) || std::stoul(word) >= node->size())
          {
            problem = node->empty() ? fmt::format("{} is empty", parent)
                                    : fmt::format("{} has the entries 0 to {}, not '{}'", parent, node->size() - 1, word);
            if (no_such_entry)
              *no_such_entry = is_index(word);
            return nullptr;
          }
          node = &(*node)[std::stoul(word)];
        }
        else
        {
          problem = fmt::format("{} is a value and has no '{}'", parent, word);
          return nullptr;
        }
        so_far += (so_far.empty() ? "" : ".") + word;
      }
      return node;
    }

    std::string key_list(const Json &node)
    {
      std::vector<std::string> keys;
      for (const auto &item : node.items())
        keys.push_back(item.key());
      return fmt::format("{}", fmt::join(keys, ", "));
    }

    bool is_table(const Json &node)
    {
      return node.is_object() || node.is_array();
    }

    /// The number at @p path, or NaN and the reason in @p problem.
    double look_up(const Json &json, const std::string &path, std::string &problem)
    {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      const Json      *node = find(json, path, problem);
      if (node == nullptr)
        return none;
      if (node->is_boolean())
        return node->get<bool>() ? 1 : 0;
      if (node->is_number())
        return node->get<double>();
      problem = fmt::format("'{}' is not a {}number", path, node->is_null() ? "finite " : "");
      return none;
    }
  } // namespace

  std::string to_string(const ExpectationResult &expectation)
  {
    const Expectation &asked = expectation.asked;
    if (!expectation.problem.empty())
      return fmt::format("{}: {}", asked.quantity, expectation.problem);
    std::vector<std::string> parts;
    if (asked.value)
    {
      const double tolerance = asked.atol + asked.rtol * std::abs(*asked.value);
      parts.push_back(tolerance > 0 ? fmt::format("{:.10g} +- {:.3g}", *asked.value, tolerance) : fmt::format("{:.17g}", *asked.value));
    }
    if (asked.min)
      parts.push_back(fmt::format(">= {:.10g}", *asked.min));
    if (asked.max)
      parts.push_back(fmt::format("<= {:.10g}", *asked.max));
    return fmt::format("{} = {:.10g}, expected {}", asked.quantity, expectation.value, fmt::join(parts, " and "));
  }

  std::vector<Diagnostic> failed_expectations(const RunResult &result)
  {
    std::vector<Diagnostic> failures;
    for (const ExpectationResult &expectation : result.expect)
      if (!expectation.passed)
        failures.push_back({expectation.asked.where, Severity::error, to_string(expectation), MessageName("expectation-failed")});
    return failures;
  }

  namespace
  {
    /// An error unless @p quantity is the path of a number in results like @p blank. With errors in the case (not @p complete) entries of
    /// lists and [exact] may be missing because they could not be read: nothing is said of these.
    void check_quantity(
      const std::string &quantity, const Json &blank, const bool complete, const SourceLocation &where, Diagnostics &diagnostics)
    {
      std::string path = quantity, problem;
      if (const std::vector<std::string> words = split_path(path); path.starts_with("solver.history.") && is_index(words[2]))
        path.replace(path.find(words[2]), words[2].size(), "0");
      bool              no_such_entry = false;
      const Json *const node = find(blank, path, problem, &no_such_entry);
      if (node == nullptr)
      {
        const std::string block = split_path(path).front();
        const bool        may_be_unread = !complete && (block == "errors" || no_such_entry);
        if (block == "errors" && !blank.contains("errors") && complete)
          problem = "there are no 'errors' without an [exact] solution; give u or pressure there";
        if (!may_be_unread)
          diagnostics.error(where, problem, MessageName("unknown-quantity"));
      }
      else if (is_table(*node) || node->is_string() || node->is_null())
        diagnostics.error(where,
                          fmt::format("'{}' is {}, not a number{}", quantity,
                                      is_table(*node)     ? "a block"
                                      : node->is_string() ? "a text"
                                                          : "not computed by a run",
                                      is_table(*node) && node->is_object() ? fmt::format("; it holds {}", key_list(*node)) : ""),
                          MessageName("unknown-quantity"));
    }
  } // namespace

  void check_quantities(const Case &request, const std::vector<std::string> &quantities, Diagnostics &diagnostics)
  {
    const Json blank = blank_json(request);
    for (const std::string &quantity : quantities)
      check_quantity(quantity, blank, true, {"--quantity " + quantity, 0, 0}, diagnostics);
  }

  void check_expectations(const Case &request, Diagnostics &diagnostics)
  {
    const bool complete = !diagnostics.has_errors();
    const Json blank = blank_json(request);
    for (const Expectation &expectation : request.expect)
    {
      // Relative to the value: one that is nearly no demand at all is a slip of the pen.
      if (expectation.value && expectation.rtol >= 1000)
        diagnostics.error(
          expectation.where,
          fmt::format("rtol = {:g} lets nearly every number pass: it is relative to 'value', and 0.01 is one per cent", expectation.rtol),
          MessageName("out-of-range"));
      else if (expectation.value && expectation.rtol >= 1)
        diagnostics.warning(expectation.where,
                            fmt::format("rtol = {:g} lets 0 pass: it is relative to 'value', and 0.01 is one per cent", expectation.rtol),
                            MessageName("weak-tolerance"));
      if (!expectation.quantity.empty()) // else it is missing or empty, which has been said
        check_quantity(expectation.quantity, blank, complete, expectation.where, diagnostics);
    }
  }

  bool evaluate_expectations(RunResult &result, const Case &request)
  {
    return evaluate_expectations(result, request, Json::array());
  }

  bool evaluate_expectations(RunResult &result, const Case &request, const Json &steps)
  {
    const Json json = to_json(result, request, steps);
    result.expect.clear();
    bool all_passed = true;
    for (const Expectation &expectation : request.expect)
    {
      ExpectationResult outcome;
      outcome.asked = expectation;
      outcome.value = look_up(json, expectation.quantity, outcome.problem);
      outcome.passed = std::isfinite(outcome.value);
      if (expectation.value)
        outcome.passed = outcome.passed &&
                         std::abs(outcome.value - *expectation.value) <= expectation.atol + expectation.rtol * std::abs(*expectation.value);
      if (expectation.min)
        outcome.passed = outcome.passed && outcome.value >= *expectation.min;
      if (expectation.max)
        outcome.passed = outcome.passed && outcome.value <= *expectation.max;
      all_passed = all_passed && outcome.passed;
      result.expect.push_back(std::move(outcome));
    }
    return all_passed;
  }
} // namespace unilateral

#include "unilateral/base/diagnostics.h"

#include "unilateral/base/visible_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

namespace unilateral
{
  std::string to_string(const Diagnostic &diagnostic)
  {
    std::string text;
    if (!diagnostic.where.file.empty())
    {
      text = visible(diagnostic.where.file);
      if (diagnostic.where.line > 0)
        text += fmt::format(":{}", diagnostic.where.line);
      if (diagnostic.where.line > 0 && diagnostic.where.column > 0)
        text += fmt::format(":{}", diagnostic.where.column);
      text += ": ";
    }
    switch (diagnostic.severity)
    {
    case Severity::error:
      text += "error: ";
      break;
    case Severity::warning:
      text += "warning: ";
      break;
    case Severity::note:
      text += "note: ";
      break;
    }
    text += visible(diagnostic.message);
    return diagnostic.name.text.empty() ? text : fmt::format("{} [{}]", text, diagnostic.name.text);
  }

  void Diagnostics::error(const SourceLocation &where, std::string message, MessageName name)
  {
    entries.push_back({where, Severity::error, std::move(message), std::move(name)});
  }

  void Diagnostics::warning(const SourceLocation &where, std::string message, MessageName name)
  {
    entries.push_back({where, Severity::warning, std::move(message), std::move(name)});
  }

  void Diagnostics::note(const SourceLocation &where, std::string message, MessageName name)
  {
    entries.push_back({where, Severity::note, std::move(message), std::move(name)});
  }

  void Diagnostics::add_errors(const std::vector<Diagnostic> &found)
  {
    for (const Diagnostic &diagnostic : found)
      error(diagnostic.where, diagnostic.message, diagnostic.name);
  }

  bool Diagnostics::has_errors() const
  {
    return std::any_of(entries.begin(), entries.end(), [](const Diagnostic &d) { return d.severity == Severity::error; });
  }

  void Diagnostics::throw_if_errors() const
  {
    if (has_errors())
      throw InputError(sorted_by_place(entries));
  }

  std::vector<Diagnostic> sorted_by_place(std::vector<Diagnostic> diagnostics)
  {
    std::stable_sort(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic &a, const Diagnostic &b)
                     {
                       const auto line = [](const Diagnostic &d)
                       { return d.where.line > 0 ? d.where.line : std::numeric_limits<unsigned>::max(); };
                       return std::pair(line(a), a.where.column) < std::pair(line(b), b.where.column);
                     });
    return diagnostics;
  }

  InputError::InputError(std::vector<Diagnostic> messages) : diagnostics(std::move(messages))
  {
    for (const Diagnostic &diagnostic : diagnostics)
    {
      if (!text.empty())
        text += '\n';
      text += to_string(diagnostic);
    }
  }

  InputError::InputError(const SourceLocation &where, std::string message, MessageName name)
    : InputError(std::vector<Diagnostic>{{where, Severity::error, std::move(message), std::move(name)}})
  {
  }

  namespace
  {
    /// Damerau-Levenshtein distance (insertions, deletions, substitutions, swaps of neighbours), blind to case, in tenths: a letter too
    /// many or too few (10) is likelier than a wrong one (11).
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      const auto same = [](const char x, const char y)
      { return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y)); };
      std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
      for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = 10 * j;
      for (std::size_t i = 1; i <= a.size(); ++i)
      {
        row[0] = 10 * i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
          row[j] = std::min({last[j] + 10, row[j - 1] + 10, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 11)});
          if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
            row[j] = std::min(row[j], before_last[j - 2] + 10);
        }
        before_last.swap(last);
        last.swap(row);
      }
      return last[b.size()];
    }
  } // namespace

  std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates)
  {
    // Nobody misspells a name of hundreds of letters, and the distance is quadratic.
    if (word.empty() || word.size() > 100)
      return "";
    std::string best;
    std::size_t best_distance = 0;
    for (const std::string &candidate : candidates)
    {
      const std::size_t distance = edit_distance(word, candidate);
      const std::size_t shorter = std::min(word.size(), candidate.size());
      // One slip, and one more for every four letters; in a word of one letter none, else every letter would be near every other.
      const std::size_t allowed = shorter < 2 ? 0 : 1 + shorter / 4;
      if (distance <= 11 * allowed && distance < 10 * shorter && (best.empty() || distance < best_distance))
      {
        best = candidate;
        best_distance = distance;
      }
    }
    // Else one that begins with the word: elastic, elasticity.
    for (const std::string &candidate : candidates)
      if (best.empty() && word.size() >= 4 && candidate.starts_with(word))
        best = candidate;
    return best;
  }

  std::string suggestion(const std::string &word, const std::vector<std::string> &candidates)
  {
    if (candidates.empty())
      return "";
    const std::string nearest = did_you_mean(word, candidates);
    if (!nearest.empty())
      return fmt::format("; did you mean '{}'?", nearest);
    return fmt::format("; known: {}", fmt::join(candidates, ", "));
  }

  std::string suggestion_with_list(const std::string &word, const std::vector<std::string> &candidates, const std::string &title)
  {
    std::string       heading = title;
    const std::string nearest = did_you_mean(word, candidates);
    if (!nearest.empty())
      heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(heading.front())));
    return fmt::format("; {}{}: {}", nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest), heading,
                       fmt::join(candidates, ", "));
  }
} // namespace unilateral

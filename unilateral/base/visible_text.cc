#include "unilateral/base/visible_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    struct Character
    {
      char32_t    code = 0;
      std::size_t n_bytes = 0; ///< 0: no UTF-8
    };

    Character character_at(const std::string &text, const std::size_t place)
    {
      const auto byte = [&](const std::size_t i) { return static_cast<unsigned char>(text[i]); };
      const auto first = byte(place);
      if (first < 0x80)
        return {first, 1};
      const std::size_t n = first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 && first < 0xf0 ? 3 : first >= 0xc2 && first < 0xe0 ? 2 : 0;
      if (n == 0 || n > text.size() - place)
        return {};
      char32_t code = first & (0xffu >> (n + 1));
      for (std::size_t i = 1; i < n; ++i)
      {
        if ((byte(place + i) & 0xc0) != 0x80)
          return {};
        code = code << 6 | (byte(place + i) & 0x3fu);
      }
      // Longer than need be, halves of a pair, beyond the last.
      constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
      if (code < least[n] || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff)
        return {};
      return {code, n};
    }

    bool obeyed(const char32_t code)
    {
      constexpr std::pair<char32_t, char32_t> ranges[] = {{0, 0x1f},        {0x7f, 0x9f},     {0x200e, 0x200f}, {0x2028, 0x202e},
                                                          {0x2066, 0x2069}, {0xfeff, 0xfeff}, {0x61c, 0x61c}};
      return std::any_of(std::begin(ranges), std::end(ranges),
                         [&](const auto &range) { return code >= range.first && code <= range.second; });
    }

    std::string made_visible(const std::string &text, const bool keep_line_ends)
    {
      std::string result;
      result.reserve(text.size());
      for (std::size_t place = 0; place < text.size();)
      {
        const Character character = character_at(text, place);
        if (character.n_bytes == 0)
          result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[place]));
        else if (!obeyed(character.code) || (keep_line_ends && character.code == '\n'))
          result.append(text, place, character.n_bytes);
        else if (character.code == '\n')
          result += "\\n";
        else if (character.code < 0x80)
          result += fmt::format("\\x{:02x}", unsigned(character.code));
        else
          result += fmt::format("\\u{:04x}", unsigned(character.code));
        place += std::max<std::size_t>(character.n_bytes, 1);
      }
      return result;
    }
  } // namespace

  std::string visible(const std::string &text)
  {
    return made_visible(text, false);
  }

  std::string visible_lines(const std::string &text)
  {
    return made_visible(text, true);
  }
} // namespace unilateral

// Numbers and lines of a .msh file, of which nothing is trusted.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace unilateral::msh
{
  /// The file is not what is read here.
  struct NotRead
  {
  };

  inline void require(const bool right)
  {
    if (!right)
      throw NotRead();
  }

  /// Numbers in a text, one after the other.
  class Numbers
  {
  public:
    explicit Numbers(const std::string_view text) : at(text.data()), end(text.data() + text.size()) {}

    template <typename T>
    T next()
    {
      skip_spaces();
      T value{};
      const auto [rest, error] = std::from_chars(at, end, value);
      require(error == std::errc() && (rest == end || is_space(*rest)));
      at = rest;
      return value;
    }

    bool at_end()
    {
      skip_spaces();
      return at == end;
    }

  private:
    static bool is_space(const char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
    void        skip_spaces()
    {
      while (at != end && is_space(*at))
        ++at;
    }

    const char *at, *const end;
  };

  /// A file from its beginning to its end, through a buffer.
  class Scanner
  {
  public:
    explicit Scanner(const std::string &file) : descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) { require(descriptor >= 0); }
    ~Scanner() { ::close(descriptor); }
    Scanner(const Scanner &) = delete;
    Scanner &operator=(const Scanner &) = delete;

    /// The byte that comes next.
    std::uint64_t place() const { return before + at; }

    /// The next line, without its end; it lives until the next one is read.
    std::string_view line()
    {
      long_line.clear();
      for (;;)
      {
        require(at < buffer.size() || fill());
        const char *const begin = buffer.data() + at, *const stop = find_line_end();
        if (stop)
        {
          at += stop - begin + 1;
          if (long_line.empty())
            return without_return({begin, std::size_t(stop - begin)});
          long_line.append(begin, stop);
          return without_return(long_line);
        }
        require(long_line.size() < longest_line);
        long_line.append(begin, buffer.size() - at);
        at = buffer.size();
      }
    }

    void skip_lines(std::uint64_t n)
    {
      while (n > 0)
      {
        require(at < buffer.size() || fill());
        const char *const stop = find_line_end();
        at = stop ? stop + 1 - buffer.data() : buffer.size();
        n -= stop != nullptr;
      }
    }

    template <typename T>
    T binary()
    {
      T     value{};
      char *to = reinterpret_cast<char *>(&value);
      for (std::size_t left = sizeof(T); left > 0;)
      {
        require(at < buffer.size() || fill());
        const std::size_t n = std::min(left, buffer.size() - at);
        std::memcpy(to, buffer.data() + at, n);
        to += n;
        at += n;
        left -= n;
      }
      return value;
    }

    /// Without reading them, where they are many.
    void skip_bytes(const std::uint64_t n)
    {
      if (n <= buffer.size() - at)
      {
        at += n;
        return;
      }
      const std::uint64_t to = place() + n;
      const off_t         size = lseek(descriptor, 0, SEEK_END);
      require(to >= n && size >= 0 && to <= std::uint64_t(size));
      before = to;
      buffer.clear();
      at = 0;
    }

  private:
    static constexpr std::size_t size_of_buffer = 1 << 20, longest_line = 1 << 24;

    static std::string_view without_return(std::string_view line)
    {
      if (!line.empty() && line.back() == '\r')
        line.remove_suffix(1);
      return line;
    }

    const char *find_line_end() const { return static_cast<const char *>(std::memchr(buffer.data() + at, '\n', buffer.size() - at)); }

    bool fill()
    {
      before += buffer.size();
      at = 0;
      buffer.resize(size_of_buffer);
      const ssize_t n = pread(descriptor, buffer.data(), buffer.size(), off_t(before));
      buffer.resize(n > 0 ? n : 0);
      return n > 0;
    }

    int               descriptor;
    std::uint64_t     before = 0; ///< bytes of the file before those of the buffer
    std::vector<char> buffer;
    std::size_t       at = 0;
    std::string       long_line;
  };
} // namespace unilateral::msh

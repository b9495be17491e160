// Records as bytes, for messages between processes of one program.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace unilateral
{
  /// Appends what it is called with. A function template that takes an archive and a record, and calls the archive with each member,
  /// serves ByteWriter and ByteReader.
  class ByteWriter
  {
  public:
    template <typename T>
    void operator()(const T &value)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      const char *const begin = reinterpret_cast<const char *>(&value);
      bytes.insert(bytes.end(), begin, begin + sizeof(T));
    }
    template <typename T>
    void operator()(const std::vector<T> &values)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      (*this)(values.size());
      const char *const begin = reinterpret_cast<const char *>(values.data());
      bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(T));
    }
    void operator()(const std::string &text) { (*this)(std::vector<char>(text.begin(), text.end())); }
    void operator()(const std::vector<std::string> &texts)
    {
      (*this)(texts.size());
      for (const std::string &text : texts)
        (*this)(text);
    }

    std::vector<char> bytes;
  };

  /// Takes the same in the same order. Throws std::out_of_range where the bytes end before.
  class ByteReader
  {
  public:
    explicit ByteReader(const std::vector<char> &bytes) : bytes(bytes) {}

    bool at_end() const { return place == bytes.size(); }

    template <typename T>
    void operator()(T &value)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      if (bytes.size() - place < sizeof(T))
        throw std::out_of_range("a message is too short");
      std::memcpy(&value, bytes.data() + place, sizeof(T));
      place += sizeof(T);
    }
    template <typename T>
    void operator()(std::vector<T> &values)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      std::size_t n = 0;
      (*this)(n);
      if ((bytes.size() - place) / sizeof(T) < n)
        throw std::out_of_range("a message is too short");
      values.resize(n);
      if (n > 0)
        std::memcpy(values.data(), bytes.data() + place, n * sizeof(T));
      place += n * sizeof(T);
    }
    void operator()(std::string &text)
    {
      std::vector<char> characters;
      (*this)(characters);
      text.assign(characters.begin(), characters.end());
    }
    void operator()(std::vector<std::string> &texts)
    {
      std::size_t n = 0;
      (*this)(n);
      texts.clear();
      for (; n > 0; --n)
        (*this)(texts.emplace_back());
    }

  private:
    const std::vector<char> &bytes;
    std::size_t              place = 0;
  };
} // namespace unilateral

#include "unilateral/output/result_files.h"

#include <fmt/format.h>

#include <ext/stdio_filebuf.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace unilateral
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr const char *staging_start = ".unilateral.part-";

    [[noreturn]] void fail(const std::string &path, const int reason)
    {
      throw std::runtime_error(
        fmt::format("cannot write '{}': {}", path, reason == 0 ? "its content could not be produced" : std::strerror(reason)));
    }

    /// A file that was not there before, open for writing, and its name, which nobody can foresee.
    int new_file_beside(const fs::path &target, std::string &name)
    {
      std::random_device random;
      for (unsigned attempt = 0; attempt < 100; ++attempt)
      {
        name = (target.parent_path() / fmt::format(".{}.{}.{:08x}{:08x}.part", target.filename().string(), getpid(), random(), random()))
                 .string();
        const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0 || errno != EEXIST)
          return file;
      }
      return -1;
    }

    /// Was @p name made by new_file_beside(), or by a former release (".NAME.PID.part"), in a process that is no more?
    bool is_left_over(const std::string &name)
    {
      constexpr std::string_view ending = ".part";
      if (!name.starts_with(".") || !name.ends_with(ending))
        return false;
      std::string_view rest = std::string_view(name).substr(0, name.size() - ending.size());
      for (unsigned word = 0; word < 2; ++word)
      {
        const std::size_t      dot = rest.rfind('.');
        const std::string_view last = rest.substr(dot + 1);
        pid_t                  process = 0;
        const auto [end, failure] = std::from_chars(last.data(), last.data() + last.size(), process);
        if (last.size() < 16 && dot > 0 && failure == std::errc() && end == last.data() + last.size())
          return process > 0 && kill(process, 0) != 0 && errno == ESRCH;
        if (last.size() != 16 || dot == 0 || last.find_first_not_of("0123456789abcdef") != std::string_view::npos)
          return false;
        rest = rest.substr(0, dot);
      }
      return false;
    }

    /// The folder, locked for this process; -1 when another has it or it is none.
    int locked(const std::string &folder, const int how)
    {
      const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      if (handle >= 0 && flock(handle, how) != 0)
      {
        close(handle);
        return -1;
      }
      return handle;
    }

    void remove_left_overs(const std::string &directory)
    {
      std::error_code       failure;
      std::vector<fs::path> gone;
      for (auto entry = fs::directory_iterator(directory, failure); !failure && entry != fs::directory_iterator(); entry.increment(failure))
      {
        const std::string name = entry->path().filename().string();
        if (is_left_over(name) && !entry->is_directory(failure))
          gone.push_back(entry->path());
        else if (name.starts_with(staging_start))
          if (const int handle = locked(entry->path().string(), LOCK_EX | LOCK_NB); handle >= 0)
          {
            gone.push_back(entry->path());
            close(handle);
          }
      }
      for (const fs::path &path : gone)
        fs::remove_all(path, failure);
    }
  } // namespace

  std::string csv_text(const std::string &text)
  {
    if (text.find_first_of(",\"\n\r") == std::string::npos)
      return text;
    std::string quoted = "\"";
    for (const char c : text)
      quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
  }

  void write_file_atomically(const std::string &path, const std::string &content)
  {
    write_file_atomically(path, [&](std::ostream &out) { out.write(content.data(), static_cast<std::streamsize>(content.size())); });
  }

  void write_file_atomically(const std::string &path, const std::function<void(std::ostream &)> &writer)
  {
    std::string temporary;
    const int   file = new_file_beside(path, temporary);
    if (file < 0)
      fail(path, errno);
    int reason = 0;
    try
    {
      __gnu_cxx::stdio_filebuf<char> buffer(file, std::ios::out | std::ios::binary, 1 << 16);
      std::ostream                   out(&buffer);
      errno = 0;
      writer(out);
      if (!out.flush())
        reason = errno == 0 ? -1 : errno;
      // A full disk or a network drive may report only here that the bytes did not arrive.
      else if (fsync(file) != 0 && errno != EINVAL && errno != EROFS)
        reason = errno;
      errno = 0;
      if (buffer.close() == nullptr && reason == 0)
        reason = errno == 0 ? -1 : errno;
    }
    catch (...)
    {
      unlink(temporary.c_str());
      throw;
    }
    if (reason == 0 && std::rename(temporary.c_str(), path.c_str()) != 0)
      reason = errno;
    if (reason != 0)
    {
      unlink(temporary.c_str());
      fail(path, std::max(reason, 0));
    }
  }

  ResultFiles::ResultFiles(const std::string &directory, const Processes &processes) : directory(directory), processes(processes)
  {
    if (processes.rank() == 0)
    {
      fs::create_directories(directory);
      remove_left_overs(directory);
      std::string name = directory + "/" + staging_start + "XXXXXX";
      if (mkdtemp(name.data()) == nullptr)
        fail(directory, errno);
      staging = name;
      lock = locked(staging, LOCK_SH | LOCK_NB);
    }
    const std::vector<char> name = processes.gather(std::vector<char>(staging.begin(), staging.end()));
    staging.assign(name.begin(), name.end());
  }

  ResultFiles::~ResultFiles()
  {
    remove_own();
  }

  void ResultFiles::remove_own() noexcept
  {
    if (processes.rank() > 0 || staging.empty())
      return;
    std::error_code failure;
    fs::remove_all(staging, failure);
    if (lock >= 0)
      close(lock);
    staging.clear();
  }

  void ResultFiles::publish(const std::string &last, const std::function<bool(const std::string &name)> &superseded)
  {
    processes.any(false); // until the files of all are there
    if (processes.rank() > 0)
      return;
    // Two runs that end at the same time do not mix their files.
    const int alone = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (alone >= 0)
      flock(alone, LOCK_EX);
    std::vector<std::string> names, old;
    for (const auto &entry : fs::directory_iterator(staging))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end(),
              [&](const std::string &a, const std::string &b)
              { return std::pair(a == last, std::string_view(a)) < std::pair(b == last, std::string_view(b)); });
    const auto place_of = [&](const std::string &name) { return directory + "/" + name; };
    for (const std::string &name : names)
      if (fs::symlink_status(place_of(name)).type() == fs::file_type::directory)
        fail(place_of(name), EISDIR);
    for (const auto &entry : fs::directory_iterator(directory))
      if (const std::string name = entry.path().filename().string(); superseded && superseded(name))
        old.push_back(name);

    unlink(place_of(last).c_str());
    for (const auto &list : {names, old})
      for (const std::string &name : list)
        unlink(place_of(name).c_str());
    for (const std::string &name : names)
      if (std::rename(path_of(name).c_str(), place_of(name).c_str()) != 0)
        fail(place_of(name), errno);
    if (alone >= 0)
    {
      fsync(alone);
      close(alone);
    }
    remove_own();
  }
} // namespace unilateral

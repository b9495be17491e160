#include "unilateral/mesh/gmsh_file.h"

#include "unilateral/base/confined_process.h"
#include "unilateral/base/file_access.h"
#include "unilateral/mesh/cells_read_ahead.h"
#include "unilateral/mesh/gmsh_reader.h"
#include "unilateral/mesh/mesh_message.h"
#include "unilateral/mesh/msh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace unilateral
{
  namespace
  {
    namespace fs = std::filesystem;

    /// What @p spec.file is by its ending and its beginning; InputError when it is none of these or not there.
    MeshFormat format_of(const MeshDescription &spec)
    {
      std::error_code error;
      const auto      status = fs::status(spec.file, error);
      if (!fs::exists(status))
        throw InputError(spec.where, fmt::format("mesh file '{}' does not exist", spec.file), MessageName("file-not-found"));
      if (!fs::is_regular_file(status))
        throw InputError(spec.where, fmt::format("'{}' is no ordinary file; give the path of a .msh, .geo or .step file", spec.file),
                         MessageName("file-not-found"));
      std::string ending = fs::path(spec.file).extension().string();
      std::transform(ending.begin(), ending.end(), ending.begin(), [](const unsigned char c) { return std::tolower(c); });

      std::ifstream file(spec.file, std::ios::binary);
      if (!file)
        throw InputError(spec.where, fmt::format("mesh file '{}' cannot be opened: {}", spec.file, std::strerror(errno)),
                         MessageName("file-not-found"));
      std::string head(256, '\0');
      file.read(head.data(), static_cast<std::streamsize>(head.size()));
      head.resize(static_cast<std::size_t>(file.gcount()));
      if (head.empty())
        throw InputError(spec.where, fmt::format("'{}' is empty", spec.file), MessageName("mesh-damaged"));

      if (ending == ".geo")
        return MeshFormat::geo;
      if (ending == ".step" || ending == ".stp")
      {
        if (head.find("ISO-10303-21") == std::string::npos)
          throw InputError(spec.where, fmt::format("'{}' is not a STEP file: it does not begin with ISO-10303-21", spec.file),
                           MessageName("mesh-damaged"));
        return MeshFormat::step;
      }
      if (ending != ".msh")
        throw InputError(spec.where,
                         fmt::format("'{}' is of no known kind; mesh files end in .msh (Gmsh), .geo (Gmsh) or .step", spec.file),
                         MessageName("mesh-does-not-fit"));
      // Gmsh takes for a script whatever does not begin like a mesh.
      if (!head.starts_with("$MeshFormat") && !head.starts_with("$Comments"))
        throw InputError(spec.where,
                         fmt::format("'{}' is not a Gmsh mesh: it does not begin with $MeshFormat; save it from Gmsh as "
                                     "version 4 or 2, or name it .geo if it is a script",
                                     spec.file),
                         MessageName("mesh-damaged"));
      if (const auto at = head.find("$MeshFormat"); at != std::string::npos)
      {
        const double version = std::strtod(head.c_str() + at + std::strlen("$MeshFormat"), nullptr);
        if (!(version >= 2 && version < 3) && !(version >= 4 && version < 5))
          throw InputError(spec.where, fmt::format("'{}' has Gmsh's mesh format {}; save it as version 4.1 or 2.2", spec.file, version),
                           MessageName("mesh-damaged"));
      }
      return MeshFormat::msh;
    }

    /// What a script may read: what lies in its folder. Not the files of options that Gmsh would read by itself, X.opt beside X.
    std::vector<std::string> readable_for_script(const std::string &file)
    {
      const fs::path        folder = fs::path(file).parent_path();
      std::set<std::string> names;
      std::error_code       error;
      for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
        names.insert(entry->path().filename().string());
      std::vector<std::string> readable;
      for (const std::string &name : names)
        if (!name.ends_with(".opt") || names.count(name.substr(0, name.size() - 4)) == 0)
          readable.push_back((folder / name).string());
      return readable;
    }

    SandboxRules rules_for(const MeshDescription &spec, const MeshFormat format, const bool meshing)
    {
      std::error_code error;
      SandboxRules    rules;
      if (format == MeshFormat::geo)
        rules.readable = readable_for_script(spec.file);
      rules.readable.push_back(fs::canonical(spec.file, error).string());
      // Gmsh reads some MB a second of a mesh, OpenCASCADE less than one of a drawing, and two minutes make some million tetrahedra; a slow
      // machine takes several times as long.
      const double megabytes = double(fs::file_size(spec.file, error)) / 1e6;
      rules.cpu_seconds = format == MeshFormat::msh ? 20 + 2 * megabytes : (meshing ? 120 : 30) + 10 * megabytes;
      const auto physical = std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE));
      rules.memory = std::max(physical / 2, std::uint64_t(1) << 30);
      return rules;
    }

    /// Why the process has no answer, and what to do.
    std::string reason_of(const ConfinedResult &result, const MeshDescription &spec, const MeshFormat format, const SandboxRules &rules)
    {
      using End = ConfinedResult::End;
      const bool        script = format == MeshFormat::geo;
      const std::string remedy = format == MeshFormat::msh
                                   ? "the file may be damaged: save it again, and see whether Gmsh opens it"
                                   : "see whether Gmsh opens and meshes it; the mesh that Gmsh saves, a .msh file, can be used here, too";
      switch (result.end)
      {
      case End::finished:
        break;
      case End::exited:
        return script ? fmt::format("the script '{}' ends Gmsh before there is a mesh; remove the command Exit", spec.file)
                      : fmt::format("Gmsh gives up on '{}' without a reason; {}", spec.file, remedy);
      case End::command:
        return fmt::format("'{}' tries to start a command of the system, which a mesh file may not do here; remove SystemCall and the like",
                           spec.file);
      case End::writing:
        return fmt::format("'{}' tries to write a file, which a mesh file may not do here; remove Save, Print and Printf to files",
                           spec.file);
      case End::out_of_time:
        return fmt::format("Gmsh does not get done with '{}' in {:.0f} seconds; {}", spec.file, rules.cpu_seconds, remedy);
      case End::out_of_memory:
        return fmt::format("Gmsh needs more memory for '{}' than there is ({:.2g} GB); {}{}", spec.file, double(rules.memory) / 1e9,
                           format == MeshFormat::msh ? "" : "a larger mesh.size makes fewer cells; ", remedy);
      case End::crashed:
        return fmt::format("Gmsh crashes on '{}'{}; {}", spec.file, result.signal > 0 ? fmt::format(" ({})", strsignal(result.signal)) : "",
                           remedy);
      }
      return "";
    }

    // The first byte of an answer.
    constexpr char mesh = '+', error = '-', no_sandbox = '!';

    /// What @p work returns, or why it fails, for result_of() in another process.
    template <typename Work>
    std::string answer_of(const Work &work)
    {
      try
      {
        return mesh + work();
      }
      catch (const InputError &e)
      {
        return error + e.diagnostics.front().name.text + ' ' + e.diagnostics.front().message;
      }
    }

    std::string result_of(std::string answer, const MeshDescription &spec)
    {
      const char tag = answer.empty() ? error : answer.front();
      answer.erase(0, 1);
      if (tag == mesh)
        return answer;
      // NAME MESSAGE, where Gmsh has not overwritten it.
      const std::size_t end = answer.find(' ');
      const bool        named = end != std::string::npos && answer.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == end;
      if (named)
        throw InputError(spec.where, answer.substr(end + 1), MessageName(answer.substr(0, end)));
      throw InputError(spec.where, answer, MessageName("mesh-damaged"));
    }

    /// What @p work returns in a process that is confined to reading spec.file. InputError when it fails, says so or tries something else.
    template <typename Work>
    std::string by_another_process(const MeshDescription &spec, const MeshFormat format, const bool meshing, const Work &work)
    {
      const SandboxRules rules = rules_for(spec, format, meshing);
      const auto         answer = [&](const SandboxState &state) -> std::string
      {
        std::error_code failure;
        // A script, or a file of options that Gmsh obeys like one, needs the whole sandbox.
        const bool obeys =
          format == MeshFormat::geo || (format == MeshFormat::msh && !state.paths && fs::exists(spec.file + ".opt", failure));
        if (obeys && !state.complete() && !file_access().allow_scripts)
          return {no_sandbox};
        return answer_of(work);
      };
      ConfinedResult result;
      try
      {
        result = run_confined(start_gmsh, answer, rules, file_access().stop_requested);
      }
      catch (const std::runtime_error &e)
      {
        throw InputError(spec.where, fmt::format("mesh file '{}' cannot be read: {}", spec.file, e.what()), MessageName("mesh-damaged"));
      }
      if (result.end != ConfinedResult::End::finished)
        throw InputError(spec.where, reason_of(result, spec, format, rules),
                         format == MeshFormat::geo ? MessageName("script-refused") : MessageName("mesh-damaged"));
      if (result.answer.starts_with(no_sandbox))
        throw InputError(spec.where,
                         fmt::format("'{}' is a script for Gmsh, or has options beside it ('{}.opt'), and this system offers no sandbox to "
                                     "run it in (seccomp and Landlock, Linux 5.13 or later); if you trust it, add --allow-scripts, or "
                                     "save its mesh from Gmsh as .msh",
                                     spec.file, fs::path(spec.file).filename().string()),
                         MessageName("script-refused"));
      return result_of(std::move(result.answer), spec);
    }

    /// @p read of @p bytes, which an honest process has made.
    template <typename Read>
    auto understood(const MeshDescription &spec, const std::string &bytes, const Read &read)
    {
      try
      {
        return read(bytes);
      }
      catch (const std::runtime_error &e)
      {
        throw InputError(spec.where, fmt::format("'{}' is damaged, and Gmsh with it: {}", spec.file, e.what()),
                         MessageName("mesh-damaged"));
      }
    }
  } // namespace

  namespace
  {
    /// In bytes: what several processes may read in pieces, so that nobody reads all of it for the names alone.
    constexpr std::uintmax_t size_worth_pieces = 60000;
  } // namespace

  MeshOutline gmsh_outline(const MeshDescription &spec)
  {
    const MeshFormat                format = format_of(spec);
    std::shared_ptr<CellsReadAhead> read_ahead;
    const auto                     &by_first = file_access().by_first_process;
    const auto                      read = [&]
    {
      if (format == MeshFormat::msh && by_first && fs::file_size(spec.file) >= size_worth_pieces)
        if (const auto outline = outline_of_msh(spec.file))
          return to_bytes(*outline);
      if (!file_access().read_ahead || format != MeshFormat::msh)
        return by_another_process(spec, format, false, [&] { return to_bytes(outline_by_gmsh(spec, format)); });
      auto [outline, cells] = understood(spec,
                                         by_another_process(spec, format, false,
                                                            [&]
                                                            {
                                                              const auto [outline, cells] = outline_and_cells_by_gmsh(spec);
                                                              return to_bytes(outline, cells);
                                                            }),
                                         outline_and_cells_of_bytes);
      if (cells)
        read_ahead = std::make_shared<CellsReadAhead>(CellsReadAhead{std::move(cells)});
      return to_bytes(outline);
    };
    MeshOutline outline =
      understood(spec, by_first ? result_of(by_first([&] { return answer_of(read); }), spec) : read(), outline_of_bytes);
    outline.read_ahead = std::move(read_ahead);
    return outline;
  }

  CellList read_gmsh_file(const MeshDescription &spec, const bool simplex, const unsigned order)
  {
    if (spec.read_ahead && spec.read_ahead->cells)
    {
      CellList list = *std::exchange(spec.read_ahead->cells, std::nullopt);
      check_kind_of_cells(list.kind, simplex, spec.where);
      return list;
    }
    const MeshFormat format = format_of(spec);
    CellList         list = understood(
              spec, by_another_process(spec, format, true, [&] { return to_bytes(cells_by_gmsh(spec, format, simplex, order)); }), cells_of_bytes);
    if (list.kind != CellKind::segment && is_simplex(list.kind) != simplex)
      throw InputError(spec.where, fmt::format("'{}' is damaged, and Gmsh with it: it has {}", spec.file, plural_name(list.kind)),
                       MessageName("mesh-damaged"));
    return list;
  }
} // namespace unilateral

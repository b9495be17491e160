#include "cli/init.h"

#include "cli/embedded_files.h"

#include "unilateral/base/diagnostics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace unilateral
{
  namespace
  {
    struct TemplateName
    {
      const char *name, *file, *description;
    };
    constexpr TemplateName template_names[] = {
      {"membrane", "cli/init/membrane.toml", "a membrane above a floor with a step"},
      {"elasticity", "cli/init/elasticity.toml", "an elastic block pressed onto a cylinder, plane strain"},
      {"beam", "cli/init/beam.toml", "a beam above a floor"},
      {"plate", "cli/init/plate.toml", "a supported plate above a floor"},
      {"projection", "cli/init/projection.toml", "data made to respect a bound"},
      {"ball", "examples/membrane-over-ball.toml", "a membrane stretched over a ball, with its exact solution"},
      {"string", "examples/string-under-ceiling.toml", "the smallest problem: a string pressed against a ceiling"},
      {"hertz", "examples/hertz-line.toml", "Hertz's line contact, with its exact displacements and pressure"},
      {"sphere", "examples/hertz-sphere.toml", "Hertz's sphere, axisymmetric"},
      {"footing", "examples/rigid-footing.toml", "a rigid footing on soil"},
      {"torsion", "examples/torsion-of-a-bar.toml", "elastic-plastic torsion of a bar"},
      {"bearing", "examples/journal-bearing.toml", "cavitation in a journal bearing"},
      {"option", "examples/american-put.toml", "an American put option"},
    };
    constexpr const char *kinds_with_mesh[] = {"membrane", "elasticity", "beam", "plate", "projection"};

    void check_takes_mesh(const std::string &kind)
    {
      if (std::find(std::begin(kinds_with_mesh), std::end(kinds_with_mesh), kind) == std::end(kinds_with_mesh))
        throw InputError({}, fmt::format("'{}' has a mesh of its own; --mesh goes with {}", kind, fmt::join(kinds_with_mesh, ", ")),
                         MessageName("contradiction"));
    }

    /// Fails where the file exists, without a moment between looking and writing.
    void write_new_file(const std::string &file, const std::string &text)
    {
      std::FILE *const out = std::fopen(file.c_str(), "wx");
      if (out == nullptr && errno == EEXIST)
        throw InputError({file, 0, 0}, "the file exists, and init overwrites nothing; give another name: unilateral init KIND FILE",
                         MessageName("file-exists"));
      if (out == nullptr)
        throw InputError({file, 0, 0}, fmt::format("the file cannot be written: {}", std::strerror(errno)), MessageName("cannot-write"));
      const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
      if (std::fclose(out) != 0 || !written)
      {
        const std::string reason = std::strerror(errno);
        std::remove(file.c_str());
        throw InputError({file, 0, 0}, fmt::format("the file cannot be written: {}", reason), MessageName("cannot-write"));
      }
    }

    std::string template_list()
    {
      std::string text = "Cases that 'unilateral init NAME [FILE]' writes:\n\n";
      for (const CaseTemplate &known : case_templates())
        text += fmt::format("  {:<14}{}\n", known.name, known.description);
      return text + fmt::format("\nWith --mesh FILE, {} are about the mesh of a file.\n", fmt::join(kinds_with_mesh, ", "));
    }
  } // namespace

  const std::vector<CaseTemplate> &case_templates()
  {
    static const std::vector<CaseTemplate> templates = []
    {
      std::vector<CaseTemplate> all;
      for (const TemplateName &entry : template_names)
        all.push_back({entry.name, entry.description, embedded_file(entry.file)});
      return all;
    }();
    return templates;
  }

  std::string init(const std::string &name, const std::string &file, const std::string &mesh_file, const CaseWithMesh case_with_mesh)
  {
    if (name.empty())
      return template_list();
    const auto &known = case_templates();
    const auto  entry = std::find_if(known.begin(), known.end(), [&](const CaseTemplate &candidate) { return candidate.name == name; });
    if (entry == known.end())
    {
      std::vector<std::string> names;
      for (const CaseTemplate &candidate : known)
        names.push_back(candidate.name);
      throw InputError({}, fmt::format("there is no case '{}' to start from{}", name, suggestion_with_list(name, names, "known")),
                       MessageName("unknown-choice"));
    }
    const std::string path = file.empty() ? name + ".toml" : file;
    std::string       text = entry->text;
    if (!mesh_file.empty())
    {
      check_takes_mesh(name);
      const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path();
      text = case_with_mesh(name, mesh_file, std::filesystem::absolute(mesh_file).lexically_normal().lexically_proximate(folder).string());
    }
    if (path == "-")
      return text;
    write_new_file(path, text);
    return fmt::format("{0} is written; solve it with: unilateral run {0}\n", path);
  }
} // namespace unilateral

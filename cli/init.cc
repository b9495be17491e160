#include "cli/init.h"

#include "cli/embedded_files.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/case/toml_document.h"
#include "unilateral/mesh/make_mesh.h"

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

    struct FoundMesh
    {
      unsigned                 dimension = 0;
      bool                     simplex = false;
      std::vector<std::string> parts, regions;
    };

    template <int dim>
    FoundMesh read_mesh_of_dimension(const MeshDescription &spec)
    {
      const auto outcome = [](const Mesh<dim> &mesh) {
        return FoundMesh{dim, mesh.simplex && dim > 1, mesh.part_names, mesh.region_names};
      };
      // The cells are of one kind or the other; a script or drawing is cut into simplices.
      try
      {
        return outcome(make_mesh<dim>(spec, true));
      }
      catch (const InputError &)
      {
        return outcome(make_mesh<dim>(spec, false));
      }
    }

    FoundMesh read_mesh_file(const std::string &file)
    {
      MeshDescription spec;
      spec.source = MeshDescription::Source::file;
      spec.file = std::filesystem::absolute(file).lexically_normal().string();
      spec.where = spec.number_where = {file, 0, 0};
      switch (mesh_outline(spec).dimension)
      {
      case 1:
        return read_mesh_of_dimension<1>(spec);
      case 2:
        return read_mesh_of_dimension<2>(spec);
      default:
        return read_mesh_of_dimension<3>(spec);
      }
    }

    bool bare(const std::string &key)
    {
      return !key.empty() && key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
    }

    std::string toml_key(const std::string &name)
    {
      return bare(name) ? name : toml_quoted(name);
    }

    std::string model_lines(const std::string &kind, const FoundMesh &mesh)
    {
      if (kind == "elasticity")
      {
        std::string load = "0";
        for (unsigned d = 1; d < mesh.dimension; ++d)
          load = d + 1 < mesh.dimension ? "0, " + load : load + ", -1";
        return fmt::format(
          "element = \"{}\"\nyoung   = 210000                   # choose\npoisson = 0.3                      # choose\nload    = "
          "[{}]                  # choose: force per volume\n",
          mesh.simplex ? "P2" : "Q1", mesh.dimension == 1 ? "-1" : load);
      }
      if (kind == "plate")
        return fmt::format(
          "element  = \"{}\"\nrigidity = 1                       # choose: D, or young, poisson and thickness\nload     = -1    "
          "                  # choose; negative is downward\n",
          mesh.simplex ? "c0ip2-triangles" : "c0ip2");
      if (kind == "beam")
        return "rigidity = 1                       # choose: EI\nload     = -1                      # choose; negative is downward\n";
      if (kind == "projection")
        return fmt::format("{}load = \"sin(x)\"                    # choose; or {{ raster = \"data.tif\" }}\n",
                           mesh.simplex ? "element = \"P1\"\n" : "");
      return fmt::format("element = \"{}\"\nload    = -1                       # choose; negative is downward\n",
                         mesh.simplex ? "P1" : "Q1");
    }

    /// A line for each part; of a body the last one may touch, the others are clamped.
    std::string boundary_lines(const std::string &kind, const FoundMesh &mesh)
    {
      if (kind == "projection")
        return "";
      std::string text = "\n[boundary]                         # choose; parts that no line names are free\n";
      for (const std::string &part : mesh.parts)
      {
        const std::string condition = kind == "membrane"          ? "0"
                                      : kind != "elasticity"      ? "\"simply supported\""
                                      : part == mesh.parts.back() ? "\"free\""
                                                                  : "\"clamped\"";
        text += fmt::format("{} = {}\n", toml_key(part), condition);
      }
      return text;
    }

    std::string case_with_mesh(const std::string &kind, const FoundMesh &mesh, const std::string &path)
    {
      std::string text =
        fmt::format("# {} on the mesh {}. What is marked with 'choose' is a guess.\n"
                    "# Parts of the boundary: {}\n# Regions: {}\n\n[mesh]\nfile = {}\n# refine = 1\n\n[model]\nkind = \"{}\"\n{}",
                    kind == "elasticity" ? "An elastic body" : "A " + kind, path, fmt::join(mesh.parts, ", "),
                    fmt::join(mesh.regions, ", "), toml_quoted(path), kind, model_lines(kind, mesh));
      if (mesh.regions.size() > 1 && kind == "elasticity")
        for (const std::string &region : mesh.regions)
          text += fmt::format("\n# [[material]]\n# region = {}\n# young  = 210000\n", toml_quoted(region));
      text += boundary_lines(kind, mesh);
      if (kind != "elasticity")
        return text + "\n[constraint]\nlower = -0.1                       # choose: u >= lower; upper likewise\n";
      text += fmt::format("\n[constraint]\non  = {}   # choose: the part that may touch\ngap = 0                            # choose: a "
                          "field, or {{ plane = {{ point = [..], normal = [..] }} }}, {{ sphere = .. }}, {{ stl = \"file\" }}\n",
                          toml_quoted(mesh.parts.back()));
      if (mesh.parts.size() == 1)
        text += "# The mesh has one part only, which cannot be held and touch at once: name another one in Gmsh (a physical group).\n";
      return text;
    }

    void check_takes_mesh(const std::string &kind)
    {
      if (std::find(std::begin(kinds_with_mesh), std::end(kinds_with_mesh), kind) == std::end(kinds_with_mesh))
        throw InputError({}, fmt::format("'{}' has a mesh of its own; --mesh goes with {}", kind, fmt::join(kinds_with_mesh, ", ")));
    }

    void check_dimension(const std::string &kind, const FoundMesh &mesh, const std::string &file)
    {
      if ((kind == "beam" && mesh.dimension != 1) || (kind == "plate" && mesh.dimension != 2))
        throw InputError({file, 0, 0}, fmt::format("a {} needs a {}-D mesh, this one is {}-D; take 'elasticity' or 'membrane'", kind,
                                                   kind == "beam" ? 1 : 2, mesh.dimension));
    }

    /// Fails where the file exists, without a moment between looking and writing.
    void write_new_file(const std::string &file, const std::string &text)
    {
      std::FILE *const out = std::fopen(file.c_str(), "wx");
      if (out == nullptr && errno == EEXIST)
        throw InputError({file, 0, 0}, "the file exists, and init overwrites nothing; give another name: unilateral init KIND FILE");
      if (out == nullptr)
        throw InputError({file, 0, 0}, fmt::format("the file cannot be written: {}", std::strerror(errno)));
      const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
      if (std::fclose(out) != 0 || !written)
      {
        const std::string reason = std::strerror(errno);
        std::remove(file.c_str());
        throw InputError({file, 0, 0}, fmt::format("the file cannot be written: {}", reason));
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

  std::string init(const std::string &name, const std::string &file, const std::string &mesh_file)
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
      throw InputError({}, fmt::format("there is no case '{}' to start from{}", name, suggestion_with_list(name, names, "known")));
    }
    const std::string path = file.empty() ? name + ".toml" : file;
    std::string       text = entry->text;
    if (!mesh_file.empty())
    {
      check_takes_mesh(name);
      const FoundMesh mesh = read_mesh_file(mesh_file);
      check_dimension(name, mesh, mesh_file);
      const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path();
      text = case_with_mesh(name, mesh, std::filesystem::absolute(mesh_file).lexically_normal().lexically_proximate(folder).string());
    }
    write_new_file(path, text);
    return fmt::format("{0} is written; solve it with: unilateral run {0}\n", path);
  }
} // namespace unilateral

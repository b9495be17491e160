#include "cli/case_with_mesh.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/case/toml_document.h"
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/make_outline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace unilateral
{
  namespace
  {
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
        const char *const load = mesh.dimension == 1 ? "-1" : mesh.dimension == 2 ? "0, -1" : "0, 0, -1";
        return fmt::format(
          "element = \"{}\"\nyoung   = 210000                   # choose\npoisson = 0.3                      # choose\nload    = "
          "[{}]                  # choose: force per volume\n",
          mesh.simplex ? "P2" : "Q1", load);
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

    std::string lines_about(const std::string &kind, const FoundMesh &mesh, const std::string &path)
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

    void check_dimension(const std::string &kind, const FoundMesh &mesh, const std::string &file)
    {
      if ((kind == "beam" && mesh.dimension != 1) || (kind == "plate" && mesh.dimension != 2))
        throw InputError({file, 0, 0},
                         fmt::format("a {} needs a {}-D mesh, this one is {}-D; take 'elasticity' or 'membrane'", kind,
                                     kind == "beam" ? 1 : 2, mesh.dimension),
                         MessageName("kind-does-not-fit"));
    }
  } // namespace

  std::string case_with_mesh(const std::string &kind, const std::string &mesh_file, const std::string &path_in_case)
  {
    const FoundMesh mesh = read_mesh_file(mesh_file);
    check_dimension(kind, mesh, mesh_file);
    return lines_about(kind, mesh, path_in_case);
  }
} // namespace unilateral

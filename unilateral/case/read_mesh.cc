#include "unilateral/case/read_mesh.h"

#include "unilateral/case/read_field.h"
#include "unilateral/mesh/make_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace unilateral
{
  namespace
  {
    constexpr unsigned max_refine = 20;
    constexpr unsigned max_cells_a_direction = 100'000;
    constexpr double   max_cells = 1e9;

    class MeshReader
    {
    public:
      MeshReader(const TomlValue                       &content,
                 const std::string                     &folder,
                 const std::shared_ptr<const CellList> &given_mesh,
                 MeshSpec                              &mesh,
                 Diagnostics                           &diagnostics)
        : table(content, "[mesh]", diagnostics), folder(folder), given_mesh(given_mesh), mesh(mesh), diagnostics(diagnostics)
      {
      }

      MeshOutline read()
      {
        std::vector<std::string> present;
        const TomlValue         *box = source("box", present), *ball = source("ball", present), *shell = source("shell", present),
                        *file = source("file", present);
        if (given_mesh)
          source("given", present);
        else
          table.refuse("given", "it is the mesh of the program that has stated the case, and no file holds it");
        unsigned dim = 0;
        if (present.size() > 1)
          diagnostics.error(table.where_key(present[1]),
                            fmt::format("[mesh] has two sources, '{}' and '{}'; keep one", present[0], present[1]),
                            MessageName("contradiction"));
        else if (present.size() == 1)
        {
          mesh.where = table.where_key(present[0]);
          dim = box ? read_box(*box) : ball ? read_ball(*ball) : shell ? read_shell(*shell) : file ? read_file(*file) : read_given();
        }
        mesh.refine = table.whole_number("refine", 0, max_refine).value_or(0);
        read_local_refinements();
        read_adaptive_refinement();

        const TomlValue *cells = table.find("cells");
        if (cells && !present.empty() && !box)
          diagnostics.error(table.where_key("cells"),
                            fmt::format("'cells' divides a box; a mesh of {} is made finer by refine", present[0]),
                            MessageName("contradiction"));
        else if (box)
          read_cells(cells, dim);
        const TomlValue *size = table.find("size");
        if (size && !present.empty() && !file)
          diagnostics.error(table.where_key("size"), "'size' is for a file that is meshed on the way, .geo or .step",
                            MessageName("contradiction"));
        else if (size && ends_in(mesh.file, ".msh"))
          diagnostics.error(table.where_key("size"),
                            "'size' is for .geo and .step files, a .msh file has its cells already; leave it out, and "
                            "take refine for smaller cells",
                            MessageName("contradiction"));
        else if (const auto number = table.number("size"))
        {
          if (*number > 0)
            mesh.size = *number;
          else
            diagnostics.error(size->where, fmt::format("'size' must be positive, it is {}", *number), MessageName("out-of-range"));
        }
        mesh.number_where = mesh.refine > 0 ? table.find("refine")->where : cells ? cells->where : mesh.where;
        if (present.size() == 1 && dim > 0)
          check_number_of_cells(dim);
        const auto meant = [&](const char *const key) { return table.has_or_misspells(key); };
        if (!meant("box") && !meant("ball") && !meant("shell") && !meant("file") && !meant("given"))
          diagnostics.error(table.where, "[mesh] has no source; give one of box, ball, shell, file", MessageName("missing-key"));
        table.finish();
        return outline(dim);
      }

    private:
      static bool ends_in(const std::string &file, const std::string &ending)
      {
        std::string extension = std::filesystem::path(file).extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(), [](const unsigned char c) { return std::tolower(c); });
        return extension == ending;
      }

      /// Names need a shape or a file that could be read.
      MeshOutline outline(const unsigned dim) const
      {
        if (dim == 0)
          return {};
        return mesh.source == MeshSpec::Source::file ? file_outline : mesh_outline(mesh);
      }

      const TomlValue *source(const std::string &key, std::vector<std::string> &present)
      {
        const TomlValue *value = table.find(key);
        if (value)
          present.push_back(key);
        return value;
      }

      unsigned read_box(const TomlValue &box)
      {
        const auto complain = [&](const std::string &what)
        {
          diagnostics.error(box.where, fmt::format("'box' {}; write two corners, [[x0, y0], [x1, y1]]", what), MessageName("wrong-type"));
          return 0u;
        };
        if (box.kind != TomlValue::Kind::array)
          return complain("must be a list, not " + box.kind_name());
        if (box.elements.size() != 2)
          return complain(fmt::format("has {} entries", box.elements.size()));
        const auto lower = read_numbers(box.elements[0], "box", diagnostics), upper = read_numbers(box.elements[1], "box", diagnostics);
        if (!lower || !upper)
          return 0;
        if (lower->size() != upper->size())
          return complain(fmt::format("has a corner of {} and one of {} coordinates", lower->size(), upper->size()));
        if (lower->empty() || lower->size() > 3)
          return complain(fmt::format("has corners of {} coordinates, 1 to 3 are possible", lower->size()));
        for (std::size_t d = 0; d < lower->size(); ++d)
          if ((*lower)[d] >= (*upper)[d])
            return complain(fmt::format("has its corners in the wrong order: {} >= {} in {}", (*lower)[d], (*upper)[d], "xyz"[d]));
        mesh.source = MeshSpec::Source::box;
        mesh.box_lower = *lower;
        mesh.box_upper = *upper;
        return static_cast<unsigned>(lower->size());
      }

      void read_cells(const TomlValue *cells, const unsigned dim)
      {
        mesh.cells.assign(dim, 1);
        if (!cells)
          return;
        const auto count = [&](const TomlValue &value)
        {
          if (value.kind != TomlValue::Kind::integer)
            diagnostics.error(value.where, fmt::format("'cells' must be a whole number or a list of them, not {}", value.kind_name()),
                              MessageName("wrong-type"));
          else if (value.integer < 1 || value.integer > std::int64_t(max_cells_a_direction))
            diagnostics.error(value.where, fmt::format("'cells' must lie between 1 and {}, it is {}", max_cells_a_direction, value.integer),
                              MessageName("out-of-range"));
          else
            return static_cast<unsigned>(value.integer);
          return 1u;
        };
        if (cells->kind != TomlValue::Kind::array)
          mesh.cells.assign(dim, count(*cells));
        else if (dim > 0 && cells->elements.size() != dim)
          diagnostics.error(
            cells->where,
            fmt::format("'cells' has {} numbers in {}-D, {} here; one number serves all directions", dim, dim, cells->elements.size()),
            MessageName("wrong-length"));
        else
          for (std::size_t d = 0; d < cells->elements.size(); ++d)
          {
            const unsigned n = count(cells->elements[d]);
            if (d < dim)
              mesh.cells[d] = n;
          }
      }

      /// A positive number of ball or shell.
      double length(TableReader &shape, const std::string &key, const double otherwise)
      {
        const auto number = shape.number(key);
        if (number && *number <= 0)
          diagnostics.error(shape.find(key)->where, fmt::format("'{}' must be positive, it is {}", key, *number),
                            MessageName("out-of-range"));
        return number && *number > 0 ? *number : otherwise;
      }

      unsigned read_center(TableReader &shape, const unsigned least)
      {
        if (!shape.find("center"))
        {
          diagnostics.error(shape.where, fmt::format("'center' is missing in {}", shape.section), MessageName("missing-key"));
          return 0;
        }
        const auto center = shape.numbers("center");
        if (!center)
          return 0;
        if (center->size() < least || center->size() > 3)
        {
          diagnostics.error(shape.find("center")->where,
                            fmt::format("'center' must have {} to 3 coordinates, it has {}", least, center->size()),
                            MessageName("wrong-length"));
          return 0;
        }
        mesh.center = *center;
        return static_cast<unsigned>(center->size());
      }

      unsigned read_ball(const TomlValue &ball)
      {
        mesh.source = MeshSpec::Source::ball;
        if (ball.kind != TomlValue::Kind::table)
        {
          diagnostics.error(ball.where, fmt::format("'ball' must be {{ center = [0, 0], radius = 1 }}, not {}", ball.kind_name()),
                            MessageName("wrong-type"));
          return 0;
        }
        TableReader    shape(ball, "ball", diagnostics);
        const unsigned dim = read_center(shape, 1);
        mesh.radius = length(shape, "radius", 1);
        shape.finish();
        return dim;
      }

      unsigned read_shell(const TomlValue &shell)
      {
        mesh.source = MeshSpec::Source::shell;
        if (shell.kind != TomlValue::Kind::table)
        {
          diagnostics.error(shell.where,
                            fmt::format("'shell' must be {{ center = [0, 0], inner = 1, outer = 2 }}, not {}", shell.kind_name()),
                            MessageName("wrong-type"));
          return 0;
        }
        TableReader       shape(shell, "shell", diagnostics);
        const unsigned    dim = read_center(shape, 2);
        const std::size_t n_before = diagnostics.all().size();
        mesh.inner = length(shape, "inner", 0.5);
        mesh.outer = length(shape, "outer", 1);
        if (mesh.inner >= mesh.outer && diagnostics.all().size() == n_before)
          diagnostics.error(shape.find("inner") ? shape.find("inner")->where : shape.find("outer")->where,
                            fmt::format("'inner' = {} must be less than 'outer' = {}", mesh.inner, mesh.outer),
                            MessageName("out-of-range"));
        shape.finish();
        return dim;
      }

      unsigned read_file(const TomlValue &value)
      {
        mesh.source = MeshSpec::Source::file;
        const auto name = table.string("file");
        if (!name)
          return 0;
        // Messages about the file belong where its name stands.
        mesh.where = value.where;
        mesh.file = absolute_path(*name, folder);
        const std::vector<std::string> endings = {".msh", ".geo", ".step", ".stp"};
        if (std::none_of(endings.begin(), endings.end(), [&](const std::string &ending) { return ends_in(*name, ending); }))
        {
          diagnostics.error(value.where, fmt::format("mesh file '{}' must end in .msh, .geo, .step or .stp", *name),
                            MessageName("wrong-type"));
          return 0;
        }
        try
        {
          file_outline = mesh_outline(mesh);
          mesh.read_ahead = file_outline.read_ahead;
          return file_outline.dimension;
        }
        catch (const InputError &e)
        {
          diagnostics.add_errors(e.diagnostics);
          return 0;
        }
      }

      /// insert_given_functions() has said what is wrong with the number.
      unsigned read_given()
      {
        if (!given_mesh)
          return 0;
        mesh.source = MeshSpec::Source::cells;
        mesh.cell_list = given_mesh;
        return mesh_outline(mesh).dimension;
      }

      void read_local_refinements()
      {
        const TomlValue *const list = table.find("local");
        if (!list)
          return;
        for (const TomlValue *const entry : read_tables(*list, "[[mesh.local]]", diagnostics))
        {
          TableReader     local(*entry, "[[mesh.local]]", diagnostics);
          MeshSpec::Local refinement;
          refinement.times = local.whole_number("times", 1, max_refine).value_or(1);
          const TomlValue *const where = local.find("where");
          if (const auto function = where ? read_field(*where, "where", folder, diagnostics) : std::nullopt)
          {
            refinement.where = *function;
            mesh.local.push_back(refinement);
          }
          else if (!where && !local.has_or_misspells("where"))
            diagnostics.error(local.where, "[[mesh.local]] does not say where; give an expression, e.g. where = \"x^2 + y^2 < 1\"",
                              MessageName("missing-key"));
          local.finish();
        }
      }

      void read_adaptive_refinement()
      {
        const TomlValue *const value = table.find("adapt");
        if (!value)
          return;
        if (value->kind != TomlValue::Kind::table)
        {
          diagnostics.error(value->where, fmt::format("'adapt' must be {{ tolerance = 0.01 }}, not {}", value->kind_name()),
                            MessageName("wrong-type"));
          return;
        }
        TableReader        adapt(*value, "adapt", diagnostics);
        AdaptiveRefinement refinement;
        refinement.where = table.where_key("adapt");
        if (const auto tolerance = adapt.number("tolerance"))
        {
          refinement.tolerance = *tolerance;
          if (!(*tolerance > 0))
            diagnostics.error(adapt.find("tolerance")->where, fmt::format("'tolerance' must be positive, it is {}", *tolerance),
                              MessageName("out-of-range"));
        }
        else if (!adapt.has_or_misspells("tolerance"))
          diagnostics.error(value->where, "'adapt' does not say how small the error is to be; give a tolerance, e.g. { tolerance = 0.01 }",
                            MessageName("missing-key"));
        refinement.max_unknowns = adapt.whole_number("max_unknowns", 1, 1'000'000'000).value_or(1'000'000);
        if (const auto text = adapt.string("goal"))
        {
          if (const auto goal = refinement_goal(*text))
            refinement.goal = *goal;
          else
            diagnostics.error(adapt.find("goal")->where,
                              fmt::format("unknown goal '{}'; it is \"energy\", \"contact_force\", u at a probe, for example "
                                          "\"solution.probes.0.value\", or a reaction, \"balance.reactions.0.force.1\"",
                                          *text),
                              MessageName("unknown-choice"));
        }
        adapt.finish();
        mesh.adapt = refinement;
      }

      void check_number_of_cells(const unsigned dim)
      {
        double n_cells = std::pow(2., dim * mesh.refine);
        for (const unsigned n : mesh.cells)
          n_cells *= n;
        if (n_cells > max_cells)
          diagnostics.error(
            mesh.number_where,
            fmt::format("the mesh would have {:.2g} cells or more, {:.0e} are possible; lower refine or cells", n_cells, max_cells),
            MessageName("mesh-too-large"));
      }

      TableReader        table;
      const std::string &folder;

      const std::shared_ptr<const CellList> &given_mesh;

      MeshSpec    &mesh;
      MeshOutline  file_outline;
      Diagnostics &diagnostics;
    };
  } // namespace

  MeshOutline read_mesh(const TomlValue                       &content,
                        const std::string                     &folder,
                        const std::shared_ptr<const CellList> &given,
                        MeshSpec                              &mesh,
                        Diagnostics                           &diagnostics)
  {
    return MeshReader(content, folder, given, mesh, diagnostics).read();
  }
} // namespace unilateral

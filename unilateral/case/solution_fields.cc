#include "unilateral/case/solution_fields.h"

#include "unilateral/output/vtu_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// How VTK counts the corners of a cell whose corners are counted here with x running fastest.
    struct CellKind
    {
      std::uint8_t          vtk_type;
      unsigned              dim;
      bool                  simplex;
      std::vector<unsigned> corners;
    };

    const CellKind *kind_of(const std::uint8_t vtk_type)
    {
      static const std::array<CellKind, 5> kinds = {{{3, 1, false, {0, 1}},
                                                     {5, 2, true, {0, 1, 2}},
                                                     {9, 2, false, {0, 1, 3, 2}},
                                                     {10, 3, true, {0, 1, 2, 3}},
                                                     {12, 3, false, {0, 1, 3, 2, 4, 5, 7, 6}}}};
      const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const CellKind &k) { return k.vtk_type == vtk_type; });
      return kind == kinds.end() ? nullptr : &*kind;
    }

    [[noreturn]] void damaged(const std::string &file, const std::string &what)
    {
      throw InputError({file, 0, 0}, fmt::format("{}; write the results anew with 'unilateral run'", what), MessageName("file-damaged"));
    }

    /// The arrays of a file by the names that fields use: of vectors the components.
    std::map<std::string, std::vector<double>> functions_in(const VtuGrid &grid, const unsigned dim)
    {
      std::map<std::string, std::vector<double>> functions;
      for (const VtuArray &array : grid.point_arrays)
        if (const auto *const values = std::get_if<std::vector<double>>(&array.values))
        {
          if (array.n_components == 1)
            functions[array.name] = *values;
          for (unsigned c = 0; c < std::min(dim, array.n_components) && array.n_components > 1; ++c)
          {
            auto &component = functions[array.name + "xyz"[c]];
            for (std::size_t i = c; i < values->size(); i += array.n_components)
              component.push_back((*values)[i]);
          }
        }
      if (const auto pressure = functions.find("contact_pressure"); pressure != functions.end())
        functions["pressure"] = pressure->second;
      return functions;
    }

    std::shared_ptr<const CellFunctions> functions_of(const VtuGrid &grid, const std::string &file)
    {
      const CellKind *const kind = grid.cell_types.empty() ? nullptr : kind_of(grid.cell_types[0]);
      if (!kind)
        damaged(file, "the file has no cells");
      CellNodes nodes;
      nodes.dim = kind->dim;
      nodes.simplex = kind->simplex;
      nodes.points = grid.points;
      for (auto &point : nodes.points)
        for (unsigned d = nodes.dim; d < 3; ++d)
          point[d] = 0;
      for (std::size_t cell = 0; cell < grid.cell_types.size(); ++cell)
      {
        const std::size_t begin = cell == 0 ? 0 : grid.offsets[cell - 1];
        if (grid.cell_types[cell] != kind->vtk_type || grid.offsets[cell] - begin != kind->corners.size())
          damaged(file, "its cells are not all of one kind");
        for (const unsigned corner : kind->corners)
          nodes.map_nodes.push_back(grid.connectivity[begin + corner]);
      }
      nodes.value_nodes = nodes.map_nodes;
      const unsigned dim = nodes.dim;
      return std::make_shared<const CellFunctions>(std::move(nodes), functions_in(grid, dim));
    }

    std::shared_ptr<const CellFunctions> functions_of_run(const FieldSpec &spec)
    {
      namespace fs = std::filesystem;
      std::error_code failure;
      const fs::path  folder = spec.file;
      for (const char *const name : {"solution.vtu", "solution.pvtu"})
        if (fs::is_regular_file(folder / name, failure))
          return functions_of(read_vtu((folder / name).string()), (folder / name).string());
      throw InputError(spec.where,
                       fs::is_directory(folder, failure)
                         ? fmt::format("there is no solution.vtu in '{}'; run that case first, with output.vtu = true", spec.file)
                         : fmt::format("there is no folder '{}'; give the folder that 'unilateral run' has written", spec.file),
                       MessageName("file-not-found"));
    }

    FieldFunction function_in(const FieldSpec &spec, const CellFunctions &functions, const unsigned dim, const std::string &origin)
    {
      if (functions.dim() != dim)
        throw InputError(spec.where, fmt::format("the solution is one on a {}-D mesh, this mesh is {}-D", functions.dim(), dim),
                         MessageName("kind-does-not-fit"));
      // A displacement in 1-D is its own component.
      const std::string name = spec.quantity == "ux" && dim == 1 ? "u" : spec.quantity;
      auto              source = functions.function(name, spec.scale, spec.offset, origin);
      if (!source)
        throw InputError(spec.where, fmt::format("the solution has no '{}'; it has {}", spec.quantity, fmt::join(functions.names(), ", ")),
                         MessageName("unknown-quantity"));
      return {std::move(source), spec.where};
    }

    /// Names in an expression that are parameters; a few more do no harm.
    std::set<std::string> parameters_in(const std::string &text, const std::vector<Parameter> &parameters)
    {
      const auto            part_of_name = [](const char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
      std::set<std::string> found;
      for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1)
      {
        end = begin;
        while (end < text.size() && part_of_name(text[end]))
          ++end;
        const std::string name = text.substr(begin, end - begin);
        if (!name.empty() &&
            std::any_of(parameters.begin(), parameters.end(), [&](const Parameter &parameter) { return parameter.name == name; }))
          found.insert(name);
      }
      return found;
    }

    void add_parameters(const FieldSpec &spec, const std::vector<Parameter> &parameters, std::set<std::string> &found)
    {
      if (spec.kind == FieldSpec::Kind::previous && spec.initial)
        add_parameters(*spec.initial, parameters, found);
      if (spec.kind != FieldSpec::Kind::expression)
        return;
      for (const std::string &name : parameters_in(spec.text, parameters))
        if (found.insert(name).second)
          for (const Parameter &parameter : parameters)
            if (parameter.name == name)
              add_parameters(parameter.value, parameters, found);
    }

    std::string text_of(const FieldSpec &spec)
    {
      switch (spec.kind)
      {
      case FieldSpec::Kind::constant:
        return fmt::format("{}", spec.value);
      case FieldSpec::Kind::expression:
        return spec.text;
      default:
        break;
      }
      std::string text = fmt::format("{} {} {} {} {}", int(spec.kind), spec.file, spec.quantity, spec.scale, spec.offset);
      if (spec.extent)
        for (const auto &corner : *spec.extent)
          text += fmt::format(" {} {}", corner[0], corner[1]);
      return spec.nodata ? text + fmt::format(" nodata {}", *spec.nodata) : text;
    }
  } // namespace

  std::set<std::string> parameters_behind(const FieldSpec &spec, const std::vector<Parameter> &parameters)
  {
    std::set<std::string> found;
    add_parameters(spec, parameters, found);
    return found;
  }

  std::string identity_of(const FieldSpec &spec, const std::vector<Parameter> &parameters)
  {
    std::string                 identity = fmt::format("{}\n{}\n{}:{}", int(spec.kind), text_of(spec), spec.where.line, spec.where.column);
    const std::set<std::string> names = parameters_behind(spec, parameters);
    for (const Parameter &parameter : parameters)
      if (names.count(parameter.name) > 0)
        identity += fmt::format("\n{} = {}", parameter.name, text_of(parameter.value));
    return identity;
  }

  bool depends_on_previous(const FieldSpec &spec, const std::vector<Parameter> &parameters)
  {
    const auto                  is_previous = [](const FieldSpec &field) { return field.kind == FieldSpec::Kind::previous; };
    const std::set<std::string> names = parameters_behind(spec, parameters);
    return is_previous(spec) ||
           std::any_of(parameters.begin(), parameters.end(),
                       [&](const Parameter &parameter) { return is_previous(parameter.value) && names.count(parameter.name) > 0; });
  }

  FieldFunction solution_field(const FieldSpec &spec, const unsigned dim, StepFields &fields)
  {
    if (spec.kind == FieldSpec::Kind::run)
    {
      auto &functions = fields.runs[spec.file];
      if (!functions)
        functions = functions_of_run(spec);
      return function_in(spec, *functions, dim, "the solution of the run");
    }
    if (!fields.has_steps)
      throw InputError(spec.where, "there is no step before without [[step]] or [steps]", MessageName("missing-key"));
    return function_in(spec, *fields.previous, dim, "the solution of the step before");
  }
} // namespace unilateral

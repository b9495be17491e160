// What the user asked for: plain structs with defaults. case_file.h reads and writes them.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A scalar function of position as the user wrote it; field_function.h evaluates it.
  struct FieldSpec
  {
    enum class Kind
    {
      constant,   ///< `value`
      expression, ///< `text`, muParser syntax in x y z and the [parameters]
      raster,     ///< GDAL raster `file`, bilinear between pixel centres (2-D, 3-D: function of x, y)
      profile     ///< CSV `file` of two columns x, value; linear between rows (1-D: function of x)
    };
    Kind        kind = Kind::constant;
    double      value = 0;
    std::string text;

    std::string                                         file;      ///< path, relative to the case file until it is read, then absolute
    double                                              scale = 1; ///< function = scale * sample + offset
    double                                              offset = 0;
    std::optional<std::array<std::array<double, 2>, 2>> extent; ///< [[x0,y0],[x1,y1]]: place the raster here; default: its own geotransform
    std::optional<double> nodata; ///< value of the function where the raster has no data; default: an error there

    SourceLocation where; ///< of the value in the case file (for an expression: of its first character inside the quotes)
    /// Line and column of each byte of `text` where escapes make them differ from those counted from `where`; else empty.
    std::vector<std::pair<unsigned, unsigned>> places;

    static FieldSpec constant(double value);
    static FieldSpec expression(std::string text);
  };

  /// The surface of a rigid obstacle; rigid_surface.h measures distances to it.
  struct SurfaceSpec
  {
    enum class Kind
    {
      plane,    ///< through `point`, `direction` its normal, which points out of the obstacle
      sphere,   ///< centre `point`, `radius`; a circle in 2-D
      cylinder, ///< axis through `point` along `direction`, `radius`; 3-D
      stl       ///< triangles from `file`, scaled, then shifted; their normals point out of the obstacle; 3-D
    };
    Kind                kind = Kind::plane;
    std::vector<double> point, direction; ///< `dim` numbers each
    double              radius = 1;
    bool                inside = false; ///< sphere, cylinder: the obstacle is the outside, the body lies in a hollow
    std::string         file;           ///< path, relative to the case file until it is read, then absolute
    double              scale = 1;
    std::vector<double> shift; ///< none, or 3 numbers
    SourceLocation      where;
  };

  /// [parameters]: a number, or an expression in x y z and other parameters.
  struct Parameter
  {
    std::string    name;
    FieldSpec      value;
    SourceLocation where; ///< of the name
  };

  /// [mesh]: exactly one source.
  struct MeshSpec
  {
    enum class Source
    {
      none,
      box,
      ball,
      shell,
      file
    };
    Source                source = Source::none;
    std::vector<double>   box_lower, box_upper;   ///< corners, `dim` numbers each
    std::vector<unsigned> cells;                  ///< box: per direction (one number in the file means all directions)
    std::vector<double>   center;                 ///< ball, shell
    double                radius = 1;             ///< ball
    double                inner = 0.5, outer = 1; ///< shell
    std::string           file;                   ///< absolute path: .msh (2.2, 4.1), .geo, .step
    double                size = 0;               ///< target cell size for .geo and .step; 0: what the file says or Gmsh chooses
    unsigned              refine = 0;             ///< uniform refinements after the coarse mesh

    /// Then cells are halved in each direction that have their centre or a corner where a function is not zero; and that so many times.
    struct Local
    {
      FieldSpec where;
      unsigned  times = 1;
    };
    std::vector<Local> local;

    unsigned n_refinements() const; ///< of both kinds
    /// What refinement number @p level, from 0, does: nullptr: it is uniform, as are those beyond the last.
    const FieldSpec *place_of_refinement(unsigned level) const;

    SourceLocation where;        ///< of the source key
    SourceLocation number_where; ///< of what makes the cells so many: refine, else cells, else the source
  };

  /// Q1..Q8, P1..P3, discontinuous, hermite, c0ip2..c0ip4 (c0ip2-triangles, c0ip3-triangles).
  struct ElementSpec
  {
    enum class Family
    {
      Q,             ///< tensor-product Lagrange on segments, quadrilaterals, hexahedra
      P,             ///< Lagrange on segments, triangles, tetrahedra
      discontinuous, ///< on each segment, quadrilateral, hexahedron the polynomials given by their values at the points of a tensor rule
      hermite,
      c0ip
    };
    Family   family = Family::Q;
    unsigned degree = 1;
    bool     triangles = false; ///< c0ip on triangles

    bool        simplex() const { return family == Family::P || triangles; }
    std::string name() const;
  };

  /// The element called @p name ("Q2", "P1", "hermite", "c0ip3"), or nothing.
  std::optional<ElementSpec> parse_element(const std::string &name);

  /// What a region is made of. Membrane: (k grad u, grad v) + (b . grad u, v) + (c u, v) = (f, v); absent ones fall back to [model], then
  /// to the defaults 1, 0, 0, 0. Elasticity: Young's modulus and Poisson's ratio, which have no default, and the body force. Beams and
  /// plates: `stiffness` is the rigidity EI or D, which young, poisson and thickness may give instead, `reaction` a Winkler foundation.
  struct Coefficients
  {
    /// 1 entry: scalar k; 3 (2-D) or 6 (3-D) entries: symmetric tensor xx, xy, yy resp. xx, xy, xz, yy, yz, zz.
    std::optional<std::vector<FieldSpec>> stiffness;
    std::optional<std::vector<FieldSpec>> velocity; ///< `dim` entries
    std::optional<FieldSpec>              reaction;
    std::optional<FieldSpec>              young, poisson, thickness;
    std::optional<std::vector<FieldSpec>> load; ///< an entry per component of u
  };

  /// [[material]]: coefficients that hold in one region of the mesh.
  struct MaterialSpec
  {
    std::string    region;
    Coefficients   coefficients;
    SourceLocation where; ///< of the region's name
  };

  /// [model]
  struct ModelSpec
  {
    enum class Kind
    {
      membrane,
      elasticity,
      plate,
      beam,
      projection
    };
    /// Of a 2-D elastic body.
    enum class Assumption
    {
      plane_strain,
      plane_stress,
      axisymmetric ///< x is the distance from the axis, y runs along it
    };
    /// How the volumetric part of the elastic energy is integrated.
    enum class Integration
    {
      automatic, ///< reduced on quadrilaterals and hexahedra of nearly incompressible regions, else full
      full,
      reduced ///< with one Gauss point a direction less: no volumetric locking
    };
    Kind           kind = Kind::membrane;
    Assumption     assumption = Assumption::plane_strain;
    Integration    integration = Integration::automatic;
    ElementSpec    element;
    Coefficients   coefficients;
    SourceLocation where; ///< of `kind`
    SourceLocation element_where;
  };

  /// One line of [boundary].
  struct BoundarySpec
  {
    std::string              part;  ///< a name of the mesh, or "all": every part not named
    std::optional<FieldSpec> value; ///< Dirichlet: u = value
    std::optional<FieldSpec> flux;  ///< Neumann: k du/dn = flux - spring * u
    std::optional<FieldSpec> spring;

    // Elasticity. The stress vector is traction - pressure n - springs u.
    std::vector<std::optional<FieldSpec>> components;       ///< of u that are prescribed: none, or an entry per component
    bool                                  symmetry = false; ///< u.n = 0, no friction
    std::vector<FieldSpec>                traction;         ///< none, or an entry per component
    std::optional<FieldSpec>              pressure;
    std::vector<FieldSpec>                springs; ///< none, one for all directions, or an entry per component

    // Beams and plates, n the outer normal. The bending moment is M_nn = moment - slope_spring du/dn, the force flux - spring u.
    std::optional<FieldSpec> slope; ///< du/dn = slope; symmetry means 0
    std::optional<FieldSpec> moment;
    std::optional<FieldSpec> slope_spring;
    SourceLocation           where; ///< of the key
  };

  /// [[support]]: what holds a beam at a node inside.
  struct SupportSpec
  {
    std::vector<double>      at; ///< 1 number
    std::optional<FieldSpec> value, slope, spring;
    SourceLocation           where;
  };

  /// [[point_load]] on a beam or plate.
  struct PointLoadSpec
  {
    std::vector<double> at;         ///< `dim` numbers
    double              force = 0;  ///< in the direction of u
    double              moment = 0; ///< beams: conjugate to u'
    SourceLocation      where;
  };

  /// [constraint] / [[constraint]]: lower <= u <= upper in the domain, or on a boundary part; elasticity: u.n <= gap on a boundary part.
  struct ConstraintSpec
  {
    std::optional<FieldSpec>   lower, upper;
    std::optional<FieldSpec>   gap;             ///< elasticity: as a function of position,
    std::optional<SurfaceSpec> surface;         ///< or measured to a surface
    std::vector<double>        direction;       ///< elasticity: takes the place of n; none, or `dim` numbers
    std::string                on;              ///< boundary part; empty: the domain
    std::string                quadrature = ""; ///< I_G; empty: the element's default rule
    SourceLocation             where, on_where, quadrature_where;
  };

  /// [method]
  struct MethodSpec
  {
    enum class Formulation
    {
      penalty,
      mixed
    };
    Formulation           formulation = Formulation::penalty;
    std::optional<double> epsilon;              ///< absent: "auto"
    std::optional<double> penalty_tolerance;    ///< largest certified error of the penalty, relative to the energy norm of the solution
    double                tolerance = 1e-8;     ///< relative, on equilibrium and complementarity
    std::string           solver = "auto";      ///< auto | direct | amg | multigrid
    unsigned              max_iterations = 200; ///< Newton steps a level before the run is called not converged
    SourceLocation        solver_where;
  };

  /// [exact]
  struct ExactSpec
  {
    std::vector<FieldSpec>   u; ///< none, or an entry per component
    std::optional<FieldSpec> pressure;
  };

  /// [output]
  struct OutputSpec
  {
    std::vector<std::vector<double>> probes;
    std::vector<SourceLocation>      probes_where;
  };

  /// [[expect]]: an acceptance criterion; passes when |value - expected| <= atol + rtol |expected|, and min/max hold.
  struct Expectation
  {
    std::string           quantity; ///< path into results.json, e.g. constraint.0.total_contact_force
    std::optional<double> value;
    double                rtol = 0, atol = 0;
    std::optional<double> min, max;
    SourceLocation        where;
  };

  struct Case
  {
    std::string path; ///< absolute path of the file
    std::string name; ///< file name without .toml
    std::string title;
    std::string sha256; ///< of the file's bytes

    std::vector<Parameter>      parameters;
    MeshSpec                    mesh;
    ModelSpec                   model;
    std::vector<MaterialSpec>   materials;
    std::vector<BoundarySpec>   boundary;
    std::vector<SupportSpec>    supports;
    std::vector<PointLoadSpec>  point_loads;
    std::vector<ConstraintSpec> constraints;
    MethodSpec                  method;
    ExactSpec                   exact;
    OutputSpec                  output;
    std::vector<Expectation>    expect;

    unsigned dimension = 0; ///< of the mesh
    /// The names that the mesh can have, as far as they are known before it is built; empty when it cannot be read.
    std::vector<std::string> part_names, region_names;

    bool constrains_boundary() const; ///< a [[constraint]] acts on a part of the boundary
    bool elastic() const { return model.kind == ModelSpec::Kind::elasticity; }
    bool bending() const { return model.kind == ModelSpec::Kind::beam || model.kind == ModelSpec::Kind::plate; } ///< m = 2
  };
} // namespace unilateral

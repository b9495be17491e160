#include "unilateral/case/case_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    namespace specification
    {
      using Forms = std::vector<ValueForm>;
      using Kinds = std::vector<std::string>;
      using Type = ValueForm::Type;

      const Kinds every_kind, membrane = {"membrane"}, elasticity = {"elasticity"}, beam = {"beam"}, plate = {"plate"},
                              projection = {"projection"}, bent = {"beam", "plate"}, scalar = {"membrane", "beam", "plate", "projection"};

      ValueForm of_type(const Type type)
      {
        ValueForm form;
        form.type = type;
        return form;
      }

      const ValueForm number = of_type(Type::number), text = of_type(Type::text), boolean = of_type(Type::boolean),
                      field = of_type(Type::field), anything = of_type(Type::anything);

      ValueForm range(const std::optional<double> least, const std::optional<double> most, const bool open)
      {
        ValueForm form = number;
        form.least = least;
        form.most = most;
        form.open_below = form.open_above = open;
        return form;
      }

      ValueForm whole(const double least, const double most)
      {
        ValueForm form = range(least, most, false);
        form.type = Type::whole_number;
        return form;
      }

      ValueForm one_of(const std::vector<std::string> &words)
      {
        ValueForm form = text;
        form.words = words;
        return form;
      }

      ValueForm none_of(const std::vector<std::string> &words)
      {
        ValueForm form = text;
        form.not_words = words;
        return form;
      }

      ValueForm matching(const std::string &pattern)
      {
        ValueForm form = text;
        form.pattern = pattern;
        return form;
      }

      ValueForm list_of(const Forms &elements, const std::vector<unsigned> &lengths = {})
      {
        ValueForm form = of_type(Type::list);
        form.elements = elements;
        form.lengths = lengths;
        return form;
      }

      ValueForm table_called(const std::string &name, const Type type = Type::table)
      {
        ValueForm form = of_type(type);
        form.table = name;
        return form;
      }

      const ValueForm positive = range(0, {}, true), not_negative = range(0, {}, false), inside_one = range(0, 1, true),
                      coordinates = list_of({number}, {1, 2, 3}), vector = list_of({field}, {1, 2, 3}),
                      rule =
                        matching("^(nodal|midpoint|trapezoid|simpson|edges|\\s*gauss\\s*\\(\\s*0*([1-9]|1[0-9]|20)\\s*\\)\\s*|\\s*lobatto"
                                 "\\s*\\(\\s*0*([2-9]|1[0-9]|20)\\s*\\)\\s*)$");

      std::vector<std::string> lagrange()
      {
        std::vector<std::string> names;
        for (const char family : {'Q', 'P'})
          for (int degree = 1; degree <= 8; ++degree)
            names.push_back(fmt::format("{}{}", family, degree));
        return names;
      }

      std::vector<std::string> with(std::vector<std::string> names, const std::string &name)
      {
        names.push_back(name);
        return names;
      }

      KeyDescription key(const std::string &name,
                         const Kinds       &kinds,
                         const Forms       &forms,
                         const std::string &by_default,
                         const std::string &description,
                         const std::string &example)
      {
        return {name, kinds, forms, by_default, false, description, example};
      }

      KeyDescription
      required(const std::string &name, const Kinds &kinds, const Forms &forms, const std::string &description, const std::string &example)
      {
        return {name, kinds, forms, "", true, description, example};
      }

      TableDescription top_level()
      {
        const auto section = [](const std::string &name, const Kinds &kinds, const std::string &description, const std::string &example)
        { return key(name, kinds, {table_called(name)}, "", description, example); };
        const auto sections = [](const std::string &name, const Kinds &kinds, const std::string &description, const std::string &example)
        { return key(name, kinds, {table_called(name, Type::table_or_tables)}, "", description, example); };
        TableDescription top{
          "case",
          "top level",
          "A problem with unilateral constraints: mesh, form, boundary values, bounds and method.",
          {key("title", every_kind, {text}, "\"\"", "The title, for people.", "\"A membrane\""),
           section("parameters", every_kind, "Named numbers and expressions for every expression of the case.", "{ a = 1 }"),
           sections("step", every_kind, "A step of a load history; each starts from the solution of the one before.",
                    "{ set = { \"model.load\" = 1 } }"),
           section("steps", every_kind, "The same in short: a list of values for each key that steps set.", "{ count = 2 }"),
           section("mesh", every_kind, "The mesh: exactly one of box, ball, shell, file.", "{ box = [[0], [1]] }"),
           section("model", every_kind, "The kind of problem, its element and its coefficients.", "{ kind = \"membrane\" }"),
           sections("part", every_kind, "A part of the boundary by where it is.", "{ name = \"foot\", where = \"x < 0.5\" }"),
           section("boundary", every_kind, "A condition for each part of the boundary.", "{ all = \"free\" }"),
           sections("periodic", {"membrane", "elasticity"}, "Two parts of the boundary of which one repeats the other.",
                    "{ parts = [\"left\", \"right\"] }"),
           sections("material", every_kind, "Coefficients for one region of a mesh file.", "{ region = \"domain\" }"),
           sections("support", beam, "A support of a beam at a node of the coarse mesh.", "{ at = 0, value = 0 }"),
           sections("point_load", bent, "A force or moment at a point.", "{ at = [0.5, 0.5], force = -1 }"),
           sections("constraint", every_kind, "Bounds that the solution may touch but not cross.", "{ lower = 0 }"),
           section("method", every_kind, "Penalty or mixed method, and the solver.", "{ epsilon = \"auto\" }"),
           section("exact", every_kind, "The exact solution, which adds errors to the results.", "{ u = \"x\" }"),
           section("output", every_kind, "What else to report.", "{ probes = [] }"),
           sections("functional", every_kind, "An integral of an expression of the solution, in results.json.",
                    "{ name = \"volume\", integrand = \"u\" }"),
           sections("expect", every_kind, "An acceptance criterion; when one fails, the exit code is 4.",
                    "{ quantity = \"solution.energy\", min = 0 }")},
          {{KeyRule::Type::not_together, {"step", "steps"}, {}}}};
        for (KeyDescription &section : top.keys)
          section.required = section.name == "mesh" || section.name == "model";
        return top;
      }

      TableDescription parameters()
      {
        return {"parameters",
                "[parameters]",
                "Named numbers and expressions; they may use the coordinates and each other, in any order, without circles. At most 1000.",
                {key(KeyDescription::any_name, every_kind, {field}, "",
                     "A number, an expression in quotes, or a field from a raster, a profile or a solution.", "\"sqrt(x^2 + 1)\"")},
                {}};
      }

      std::vector<TableDescription> steps()
      {
        const std::string    any = KeyDescription::any_name;
        const KeyDescription set = key("set", every_kind, {table_called("settings")}, "", "Other keys of the case and their values.",
                                       "{ \"model.load\" = 1 }"),
                             sets = key("set", every_kind, {table_called("lists of settings")}, "",
                                        "Other keys of the case and lists of their values.", "{ \"model.load\" = [1, 2] }");
        const ValueForm range = matching("^[^:]+:[^:]+:[0-9]+$"), list = list_of({anything});
        return {{"step",
                 "[[step]]",
                 "Values that parameters and other keys have from this step on.",
                 {key(any, every_kind, {field}, "", "A parameter of the case.", "0.02"), set},
                 {}},
                {"settings",
                 "set",
                 "Keys as --set has them, \"boundary.top\" for example; the mesh, the element and the output are those of all steps.",
                 {key(any, every_kind, {anything}, "", "Whatever the key takes.", "1")},
                 {}},
                {"steps",
                 "[steps]",
                 "A load history in short.",
                 {key(any, every_kind, {list, range}, "", "The values of a parameter, a list or \"FROM:TO:N\".", "\"0.01:0.1:10\""), sets,
                  key("count", every_kind, {whole(1, 10'000)}, "", "The number of steps, where there is no list that says it.", "20")},
                 {}},
                {"lists of settings",
                 "set",
                 "Keys as --set has them, each with a value for every step.",
                 {key(any, every_kind, {list, range}, "", "The values of the key, a list or \"FROM:TO:N\".", "[1, 2]")},
                 {}}};
      }

      TableDescription mesh()
      {
        const ValueForm cells = whole(1, 100'000);
        return {"mesh",
                "[mesh]",
                "Exactly one of box, ball, shell, file.",
                {key("box", every_kind, {list_of({coordinates}, {2})}, "",
                     "Two corners, the smaller coordinates first; 1-D: [[0], [1]]. Parts: left right (x), bottom top (y), front back (z).",
                     "[[0, 0], [1, 1]]"),
                 key("ball", every_kind, {table_called("ball")}, "", "A segment, disc or ball. Part: surface.",
                     "{ center = [0, 0], radius = 1 }"),
                 key("shell", every_kind, {table_called("shell")}, "", "A ring or a hollow ball. Parts: inner, outer.",
                     "{ center = [0, 0], inner = 0.5, outer = 1 }"),
                 key("file", every_kind, {matching("\\.([mM][sS][hH]|[gG][eE][oO]|[sS][tT][eE][pP]|[sS][tT][pP])$")}, "",
                     "A mesh of Gmsh (.msh, formats 2.2 and 4.1); .geo, .step and .stp are meshed on the way.", "\"part.msh\""),
                 key("cells", every_kind, {cells, list_of({cells}, {1, 2, 3})}, "1",
                     "Of a box: cells of the coarse mesh, one number or one a direction.", "[8, 4]"),
                 key("size", every_kind, {positive}, "", "Of .geo and .step: target size of the cells.", "0.1"),
                 key("refine", every_kind, {whole(0, 20)}, "0",
                     "Uniform refinements after the coarse mesh; each level is solved and starts the next one.", "3"),
                 key("adapt", every_kind, {table_called("adapt")}, "",
                     "After these: refinement by the estimated error, until it is small enough.", "{ tolerance = 0.01 }"),
                 key("local", every_kind, {table_called("mesh.local", Type::table_or_tables)}, "",
                     "Refinements in places, after refine and in their order.", "{ where = \"x < 0.5\" }")},
                {{KeyRule::Type::exactly_one, {"box", "ball", "shell", "file"}, {}},
                 {KeyRule::Type::needs, {"cells", "box"}, {}},
                 {KeyRule::Type::needs, {"size", "file"}, {}}}};
      }

      std::vector<TableDescription> shapes()
      {
        const KeyDescription center = required("center", every_kind, {coordinates}, "The centre.", "[0, 0]"),
                             radius = key("radius", every_kind, {positive}, "1", "The radius.", "1"),
                             inside =
                               key("inside", every_kind, {boolean}, "false", "true: the body lies in a hollow of this shape.", "true"),
                             normal = required("normal", every_kind, {coordinates}, "It points out of the obstacle.", "[0, 1]");
        return {
          {"mesh.local",
           "[[mesh.local]]",
           "Cells in a part of the domain are halved in each direction.",
           {required("where", every_kind, {field}, "Cells that have their centre or a corner where this is not zero.",
                     "\"hypot(x, y) < 0.1\""),
            key("times", every_kind, {whole(1, 20)}, "1", "How often; each time is a level.", "2")},
           {}},
          {"adapt",
           "adapt",
           "Cells with the largest parts of the error are refined, again and again.",
           {required("tolerance", every_kind, {positive}, "Of the error in the energy norm, relative to that of u.", "0.01"),
            key("max_unknowns", every_kind, {whole(1, 1'000'000'000)}, "1000000", "There is no refinement beyond this.", "200000"),
            key(
              "goal", every_kind, {text}, "\"energy\"",
              "What the tolerance is of: energy, contact_force, u at a probe, solution.probes.0.value (.1 for its second component), or a "
              "reaction of a body, balance.reactions.0.force.1.",
              "\"contact_force\"")},
           {}},
          {"part",
           "[[part]]",
           "A part of the boundary by where it is; a later one takes faces from those before it.",
           {required("name", every_kind, {none_of({"", "all", "domain"})}, "Its name; one that the mesh has already gets more faces.",
                     "\"foot\""),
            required("where", every_kind, {field}, "Faces of the coarse mesh that have their centre where this is not zero.",
                     "\"y == 0 && x < 0.2\"")},
           {}},
          {"ball", "ball", "A segment, disc or ball.", {center, radius}, {}},
          {"shell",
           "shell",
           "A ring or a hollow ball.",
           {required("center", every_kind, {list_of({number}, {2, 3})}, "The centre.", "[0, 0]"),
            key("inner", every_kind, {positive}, "0.5", "The inner radius.", "0.5"),
            key("outer", every_kind, {positive}, "1", "The outer radius.", "1")},
           {}},
          {"raster",
           "raster",
           "A field from a raster file.",
           {required("raster", every_kind, {matching(".")}, "A raster file, a function of x and y, bilinear between pixel centres.",
                     "\"relief.tif\""),
            key("scale", every_kind, {number}, "1", "The field is scale * sample + offset.", "-1"),
            key("offset", every_kind, {number}, "0", "Added to the samples.", "0.5"),
            key("extent", every_kind, {list_of({list_of({number}, {2})}, {2})}, "", "Where the raster lies; default: as the file says.",
                "[[0, 0], [1, 1]]"),
            key("nodata", every_kind, {number}, "", "Value where the raster has no data, not scaled; default: an error there.", "0")},
           {}},
          {"profile",
           "profile",
           "A field from a table with two columns.",
           {required("profile", every_kind, {matching(".")}, "Two columns x and value, x increasing, linear between the rows.",
                     "\"bed.csv\""),
            key("scale", every_kind, {number}, "1", "The field is scale * sample + offset.", "-1"),
            key("offset", every_kind, {number}, "0", "Added to the samples.", "0.5")},
           {}},
          {"run",
           "run",
           "A field from the solution of another run.",
           {required("run", every_kind, {matching(".")}, "The folder of its results, with solution.vtu.", "\"membrane.out\""),
            key("quantity", every_kind, {matching(".")}, "\"u\"", "u, of a body ux, uy, uz; pressure, or another function of solution.vtu.",
                "\"pressure\""),
            key("scale", every_kind, {number}, "1", "The field is scale * quantity + offset.", "-1"),
            key("offset", every_kind, {number}, "0", "Added to the quantity.", "0.5")},
           {}},
          {"previous",
           "previous",
           "A field from the solution of the step before.",
           {required("previous", every_kind, {one_of({"u", "ux", "uy", "uz"})}, "u, of a body one of its components.", "\"u\""),
            key("initial", every_kind, {field}, "0", "In its place in the first step.", "\"x*(1-x)\""),
            key("scale", every_kind, {number}, "1", "The field is scale * quantity + offset.", "10"),
            key("offset", every_kind, {number}, "0", "Added to the quantity.", "0.5")},
           {}},
          {"surface",
           "gap",
           "A rigid surface to which the gap of an elastic body is measured.",
           {key("plane", every_kind, {table_called("plane")}, "", "A plane.", "{ point = [0, 0], normal = [0, 1] }"),
            key("sphere", every_kind, {table_called("sphere")}, "", "A sphere, in 2-D a circle.", "{ center = [0, -1], radius = 1 }"),
            key("cylinder", every_kind, {table_called("cylinder")}, "", "A cylinder (3-D).",
                "{ point = [0, 0, 0], axis = [0, 1, 0], radius = 1 }"),
            key("stl", every_kind, {matching(".")}, "", "Triangles from an STL file (3-D), their normals out of the obstacle.",
                "\"tool.stl\""),
            key("scale", every_kind, {positive}, "1", "Of an STL file: its coordinates are multiplied with it.", "0.001"),
            key("shift", every_kind, {list_of({number}, {3})}, "[0, 0, 0]", "Of an STL file: added after scaling.", "[0, 0, 1]")},
           {{KeyRule::Type::exactly_one, {"plane", "sphere", "cylinder", "stl"}, {}},
            {KeyRule::Type::needs, {"scale", "stl"}, {}},
            {KeyRule::Type::needs, {"shift", "stl"}, {}}}},
          {"plane", "plane", "A plane.", {required("point", every_kind, {coordinates}, "Any point of the plane.", "[0, 0]"), normal}, {}},
          {"sphere", "sphere", "A sphere, in 2-D a circle.", {center, radius, inside}, {}},
          {"cylinder",
           "cylinder",
           "A cylinder (3-D).",
           {required("point", every_kind, {list_of({number}, {3})}, "Any point of the axis.", "[0, 0, 0]"),
            required("axis", every_kind, {list_of({number}, {3})}, "The direction of the axis.", "[0, 0, 1]"), radius, inside},
           {}}};
      }

      /// The coefficients that [model] and [[material]] share.
      std::vector<KeyDescription> coefficients()
      {
        const ValueForm tensor = list_of({field}, {1, 3, 6});
        return {
          key("stiffness", membrane, {field, tensor}, "1",
              "k > 0: a field, or a symmetric tensor as a list, 2-D [xx, xy, yy], 3-D [xx, xy, xz, yy, yz, zz].", "[2, 0, 1]"),
          key("stiffness", projection, {field}, "1", "alpha > 0.", "2"),
          key("velocity", membrane, {field, vector}, "",
              "b: as many fields as dimensions; makes the form non-symmetric, so that there is no certificate.", "[1, 0]"),
          key("reaction", {"membrane", "beam", "plate"}, {field}, "0", "c, an elastic foundation.", "1"),
          key("load", scalar, {field}, "0", "f; negative is downward.", "-1"),
          key("load", elasticity, {field, vector}, "0", "Body force, a vector.", "[0, -9.81e-6]"),
          key("young", elasticity, {field}, "", "Young's modulus E > 0; required here or in every [[material]].", "210000"),
          key("young", plate, {field}, "", "Young's modulus E > 0, with thickness in place of rigidity.", "210000"),
          key("poisson", elasticity, {field}, "", "Poisson's ratio, between -1 and 1/2; required here or in every [[material]].", "0.3"),
          key("poisson", plate, {field}, "0.3", "Poisson's ratio, between -1 and 1/2.", "0.3"),
          key("rigidity", bent, {field}, "1", "EI of a beam, D of a plate; > 0.", "2"),
          key("thickness", plate, {field}, "", "With young in place of rigidity: D = E t^3 / (12 (1 - nu^2)).", "0.01")};
      }

      TableDescription model()
      {
        TableDescription model{
          "model",
          "[model]",
          "The kind of problem, its element and its coefficients.",
          {required("kind", every_kind, {one_of(kinds_of_problems())}, "Which problem is solved.", "\"membrane\""),
           key("element", {"membrane", "elasticity"}, {one_of(lagrange())}, "\"Q1\"",
               "Lagrange element: Q on segments, quadrilaterals and hexahedra, P on triangles and tetrahedra (P4 to P8: 1-D only).",
               "\"Q2\""),
           key("element", beam, {one_of({"hermite"})}, "\"hermite\"", "Cubics in C1.", "\"hermite\""),
           key("element", plate, {one_of({"hermite", "c0ip2", "c0ip3", "c0ip4", "c0ip2-triangles", "c0ip3-triangles"})}, "\"hermite\"",
               "hermite: bicubics in C1, for rectangles along the axes; c0ip: interior penalty, for any quadrilaterals or triangles.",
               "\"c0ip2\""),
           key("element", projection, {one_of(with(lagrange(), "discontinuous"))}, "\"discontinuous\"",
               "discontinuous: on each cell the polynomials given by their values at the points of the rule.", "\"discontinuous\"")},
          {{KeyRule::Type::not_together, {"rigidity", "young"}, plate},
           {KeyRule::Type::not_together, {"rigidity", "thickness"}, plate},
           {KeyRule::Type::needs, {"young", "thickness"}, plate},
           {KeyRule::Type::needs, {"thickness", "young"}, plate}}};
        const std::vector<KeyDescription> shared = coefficients();
        model.keys.insert(model.keys.end(), shared.begin(), shared.end());
        model.keys.push_back(key("assumption", elasticity, {one_of({"plane strain", "plane stress", "axisymmetric"})}, "\"plane strain\"",
                                 "2-D only. Plane: forces per unit thickness. Axisymmetric: x >= 0 is the distance from the axis.",
                                 "\"plane stress\""));
        model.keys.push_back(key("integration", elasticity, {one_of({"auto", "full", "reduced"})}, "\"auto\"",
                                 "reduced: the volumetric part with one Gauss point a direction less; auto: where nu > 0.45.",
                                 "\"reduced\""));
        return model;
      }

      TableDescription material()
      {
        TableDescription                  material{"material",
                                  "[[material]]",
                                  "Coefficients for one region of a mesh file; those left out are taken from [model].",
                                  {required("region", every_kind, {text}, "Name of the region.", "\"domain\"")},
                                  {}};
        const std::vector<KeyDescription> shared = coefficients();
        for (KeyDescription coefficient : shared)
        {
          coefficient.by_default = "";
          material.keys.push_back(coefficient);
        }
        material.rules = {{KeyRule::Type::not_together, {"rigidity", "young"}, plate},
                          {KeyRule::Type::not_together, {"rigidity", "thickness"}, plate},
                          {KeyRule::Type::needs, {"young", "thickness"}, plate},
                          {KeyRule::Type::needs, {"thickness", "young"}, plate}};
        return material;
      }

      std::vector<TableDescription> boundary()
      {
        const std::string any = KeyDescription::any_name;
        const auto        component = [](const std::string &name)
        { return key(name, every_kind, {field}, "", "The displacement along " + name + "; components that are left out are free.", "0"); };
        return {
          {"boundary",
           "[boundary]",
           "A condition for each part of the boundary; `all` stands for the parts that have no line of their own. Parts without one are "
           "free.",
           {key(any, membrane,
                {number, none_of({"clamped", "simply supported", "symmetry"}), table_called("raster"), table_called("profile"),
                 table_called("run"), table_called("previous"), table_called("membrane condition")},
                "\"free\"", "u = value, \"free\", or flux and spring: k du/dn = flux - spring u.", "{ flux = 1, spring = 2 }"),
            key(any, elasticity, {one_of({"clamped", "symmetry", "free"}), number, vector, table_called("elastic condition")}, "\"free\"",
                "The displacement, \"clamped\", \"symmetry\" (u.n = 0), \"free\", or components, loads and springs.",
                "{ x = 0, pressure = 3 }"),
            key(any, bent, {number, text, table_called("bending condition")}, "\"free\"",
                "\"clamped\", \"simply supported\", \"symmetry\", \"free\", u, or value, slope, loads and springs.", "\"clamped\""),
            key(any, projection, {one_of({"free"})}, "\"free\"", "A projection has no boundary conditions.", "\"free\"")},
           {}},
          {"membrane condition",
           "[boundary]",
           "k du/dn = flux - spring u, or u = value.",
           {key("value", every_kind, {field}, "", "u = value.", "1"), key("flux", every_kind, {field}, "0", "The flux into the body.", "1"),
            key("spring", every_kind, {field}, "0", "A spring, >= 0.", "2")},
           {{KeyRule::Type::at_least_one, {"value", "flux", "spring"}, {}},
            {KeyRule::Type::not_together, {"value", "flux"}, {}},
            {KeyRule::Type::not_together, {"value", "spring"}, {}}}},
          {"elastic condition",
           "[boundary]",
           "sigma n = traction - pressure n - spring u, and components of the displacement.",
           {component("x"), component("y"), component("z"),
            key("traction", every_kind, {field, vector}, "0", "Force per area, a vector.", "[0, -1]"),
            key("force", every_kind, {field, vector}, "0", "The total force on the part, spread evenly over it, a vector.", "[0, -100]"),
            key("moment", every_kind, {field, vector}, "0",
                "The total moment of the load about `about`: a number in 2-D, [Mx, My, Mz] in 3-D.", "5"),
            key("about", every_kind, {coordinates}, "", "A point for force, moment and motion; default: the centroid of the part.",
                "[0.5, 1]"),
            key("pressure", every_kind, {field}, "0", "Positive presses on the body.", "3"),
            key("spring", every_kind, {field, vector}, "0", "An elastic foundation, >= 0, in all directions or by component.", "[1, 2]"),
            key("rigid", every_kind, {boolean, one_of({"translation"})}, "false",
                "true: bonded to a rigid platen whose motion is unknown but for x, y, z, rotation; \"translation\": it does not turn.",
                "true"),
            key("rotation", every_kind, {field, vector, table_called("rotation")}, "",
                "Of a rigid part, in radians, as far as it is prescribed: an angle in 2-D, [x, y, z] or { z = 0.1 } in 3-D.", "0.01")},
           {{KeyRule::Type::at_least_one, {"x", "y", "z", "traction", "force", "moment", "pressure", "spring", "rigid"}, {}},
            {KeyRule::Type::not_together, {"traction", "force"}, {}},
            {KeyRule::Type::not_together, {"traction", "moment"}, {}},
            {KeyRule::Type::needs, {"rotation", "rigid"}, {}}}},
          {"rotation",
           "[boundary]",
           "Rotations of a rigid part about the axes that are prescribed, in radians.",
           {key("x", every_kind, {field}, "", "About x.", "0"), key("y", every_kind, {field}, "", "About y.", "0"),
            key("z", every_kind, {field}, "", "About z.", "0.1")},
           {{KeyRule::Type::at_least_one, {"x", "y", "z"}, {}}}},
          {"bending condition",
           "[boundary]",
           "u, its normal derivative, and forces, moments and springs where these are free.",
           {key("value", every_kind, {field}, "", "u = value.", "0"),
            key("slope", every_kind, {field}, "", "du/dn, on a beam u' along x at either end.", "0.1"),
            key("spring", every_kind, {field}, "0", "shear = force - spring u.", "2"),
            key("slope_spring", every_kind, {field}, "0", "M_nn = moment - slope_spring du/dn.", "2"),
            key("force", every_kind, {field}, "0", "On a free edge, in the direction of u.", "-1"),
            key("moment", every_kind, {field}, "0", "On an edge whose slope is free.", "1")},
           {{KeyRule::Type::at_least_one, {"value", "slope", "spring", "slope_spring", "force", "moment"}, {}},
            {KeyRule::Type::not_together, {"value", "spring"}, {}},
            {KeyRule::Type::not_together, {"value", "force"}, {}},
            {KeyRule::Type::not_together, {"slope", "slope_spring"}, {}},
            {KeyRule::Type::not_together, {"slope", "moment"}, {}}}}};
      }

      std::vector<TableDescription> loads_and_bounds()
      {
        const Forms place = {number, coordinates};
        return {
          {"periodic",
           "[[periodic]]",
           "Two parts of the boundary, the second a shift of the first: u(x + shift) = u(x) + jump.",
           {required("parts", every_kind, {list_of({matching(".")}, {2})}, "The names of the two parts.", "[\"left\", \"right\"]"),
            key("jump", membrane, {field}, "0", "A constant.", "1"),
            key("jump", elasticity, {field, vector}, "0", "A constant vector: mean strain times shift.", "[0.01, 0]")},
           {}},
          {"support",
           "[[support]]",
           "A support of a beam at a node of the coarse mesh: at least one of value, slope, spring.",
           {required("at", every_kind, place, "Where: [x], or a number.", "0"), key("value", every_kind, {field}, "", "u there.", "0"),
            key("slope", every_kind, {field}, "", "u' there.", "0"), key("spring", every_kind, {field}, "", "A spring there, >= 0.", "2")},
           {{KeyRule::Type::at_least_one, {"value", "slope", "spring"}, {}}}},
          {"point_load",
           "[[point_load]]",
           "A force or moment at a point of a beam or plate.",
           {required("at", every_kind, place, "Where: [x] or a number on a beam, [x, y] on a plate.", "[0.5, 0.5]"),
            key("force", every_kind, {number}, "0", "In the direction of u.", "-1"),
            key("moment", beam, {number}, "0", "Beams only.", "1")},
           {{KeyRule::Type::at_least_one, {"force", "moment"}, {}}}},
          {"constraint",
           "[constraint]",
           "Bounds that the solution may touch but not cross.",
           {key("lower", scalar, {field}, "", "u >= lower at the points of the rule; one of lower and upper is required.", "0"),
            key("upper", scalar, {field}, "", "u <= upper at the points of the rule.", "1"),
            key("on", membrane, {matching(".")}, "", "A part of the boundary: the bounds hold for u there; default: the domain.",
                "\"left\""),
            required("on", elasticity, {matching(".")}, "The part of the boundary that may touch.", "\"left\""),
            required("gap", elasticity, {field, table_called("surface")},
                     "u.n <= gap on the part, n its outward normal: a field, or a rigid surface.", "0"),
            key("direction", elasticity, {coordinates}, "", "A vector that takes the place of the normal.", "[0, -1]"),
            key("quadrature", every_kind, {rule}, "", "The rule whose points feel the constraint; the default depends on the element.",
                "\"nodal\"")},
           {{KeyRule::Type::at_least_one, {"lower", "upper"}, scalar}}}};
      }

      std::vector<TableDescription> solution()
      {
        return {
          {"method",
           "[method]",
           "Penalty or mixed method, and the solver.",
           {key("formulation", every_kind, {one_of({"penalty", "mixed"})}, "\"penalty\"", "mixed: the multiplier itself, epsilon = 0.",
                "\"mixed\""),
            key("epsilon", every_kind, {one_of({"auto"}), positive}, "\"auto\"",
                "Penalty parameter, pressure = penetration / epsilon; auto keeps its error below that of the mesh.", "1e-6"),
            key("penalty_tolerance", every_kind, {inside_one}, "",
                "Largest certified error of the penalty, relative to the energy norm; missed, the exit code is 4.", "1e-3"),
            key("tolerance", every_kind, {inside_one}, "1e-8", "Of the solver, relative, on equilibrium and complementarity.", "1e-9"),
            key("solver", every_kind, {one_of({"auto", "direct", "amg", "multigrid"})}, "\"auto\"", "Of the linear systems.", "\"direct\""),
            key("max_iterations", every_kind, {whole(1, 1'000'000)}, "200", "Newton steps a level; more is exit code 3.", "50")},
           {}},
          {"exact",
           "[exact]",
           "The exact solution, which adds errors to the results.",
           {key("u", scalar, {field}, "", "u.", "\"x\""), key("u", elasticity, {field, vector}, "", "The displacement.", "[\"x\", 0]"),
            key("pressure", every_kind, {field}, "", "The contact pressure, positive in contact.", "1")},
           {}},
          {"output",
           "[output]",
           "What else to report.",
           {key("vtu", every_kind, {boolean}, "true", "false: no solution.vtu and constraint-points.vtu.", "false"),
            key("csv", every_kind, {boolean}, "false", "true: constraint-points.csv, pressure and gap at the points of the rule.", "true"),
            key("report", every_kind, {boolean}, "true", "false: no report.html.", "false"),
            key("every", every_kind, {whole(0, 1'000'000)}, "1",
                "Of a load history: every n-th step and the last have a folder with their fields; 0: the last alone.", "10"),
            key("probes", every_kind, {list_of({number, coordinates})}, "[]",
                "Points in the mesh where u, and the stress of a body, are reported; in 1-D also numbers.", "[]")},
           {}},
          {"functional",
           "[[functional]]",
           "An integral of an expression of the solution.",
           {required("name", every_kind, {matching("^[A-Za-z0-9_-]+$")}, "Its name in results.json.", "\"volume\""),
            required("integrand", every_kind, {number, text}, "An expression in position, parameters and quantities of the solution.",
                     "\"u\""),
            key("on", every_kind, {text}, "\"domain\"", "The domain, or a part of the boundary.", "\"left\""),
            key("region", every_kind, {text}, "", "One region of the domain alone.", "\"domain\"")},
           {}},
          {"expect",
           "[[expect]]",
           "An acceptance criterion: at least one of value, min, max.",
           {required("quantity", every_kind, {matching(".")}, "Path into results.json.", "\"solution.energy\""),
            key("value", every_kind, {number}, "", "What it should be, within atol + rtol * abs(value).", "1"),
            key("rtol", every_kind, {range(0, {}, false)}, "0", "Relative tolerance of value, below 1000.", "1e-3"),
            key("atol", every_kind, {not_negative}, "0", "Absolute tolerance of value.", "1e-6"),
            key("min", every_kind, {number}, "", "Least value.", "0"), key("max", every_kind, {number}, "", "Largest value.", "1")},
           {{KeyRule::Type::at_least_one, {"value", "min", "max"}, {}},
            {KeyRule::Type::needs, {"rtol", "value"}, {}},
            {KeyRule::Type::needs, {"atol", "value"}, {}}}}};
      }

    } // namespace specification

    std::string range_text(const ValueForm &form)
    {
      const std::string what = form.type == ValueForm::Type::whole_number ? "whole number" : "number";
      if (form.least && form.most)
        return fmt::format("{} from {} to {}{}", what, *form.least, *form.most, form.open_below ? ", exclusive" : "");
      if (form.least)
        return fmt::format("{} {} {}", what, form.open_below ? ">" : ">=", *form.least);
      return what;
    }

    std::string form_text(const ValueForm &form)
    {
      switch (form.type)
      {
      case ValueForm::Type::number:
      case ValueForm::Type::whole_number:
        return range_text(form);
      case ValueForm::Type::text:
        return form.words.empty() ? "string" : fmt::format("\"{}\"", fmt::join(form.words, "\", \""));
      case ValueForm::Type::boolean:
        return "true or false";
      case ValueForm::Type::list:
        return form.elements.front().type == ValueForm::Type::field     ? "list of fields"
               : form.elements.back().type == ValueForm::Type::list     ? "list of lists"
               : form.elements.back().type == ValueForm::Type::anything ? "list of values"
                                                                        : "list of numbers";
      case ValueForm::Type::table:
      case ValueForm::Type::table_or_tables:
        return "table";
      case ValueForm::Type::anything:
        return "any value";
      case ValueForm::Type::field:
        break;
      }
      return "field";
    }
  } // namespace

  const std::vector<std::string> &kinds_of_problems()
  {
    static const std::vector<std::string> kinds = {"membrane", "elasticity", "beam", "plate", "projection"};
    return kinds;
  }

  const std::vector<TableDescription> &case_tables()
  {
    static const std::vector<TableDescription> tables = []
    {
      using namespace specification;
      std::vector<TableDescription> all = {top_level(), parameters(), mesh(), model(), material()};
      for (const auto &more : {steps(), boundary(), loads_and_bounds(), solution(), shapes()})
        all.insert(all.end(), more.begin(), more.end());
      return all;
    }();
    return tables;
  }

  const TableDescription &case_table(const std::string &name)
  {
    for (const TableDescription &table : case_tables())
      if (table.name == name)
        return table;
    throw std::logic_error("the case file has no table '" + name + "'");
  }

  bool holds_for(const std::vector<std::string> &kinds, const std::string &kind)
  {
    return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  }

  std::string to_string(const std::vector<ValueForm> &forms)
  {
    std::vector<std::string> texts;
    for (const ValueForm &form : forms)
      if (const std::string text = form_text(form); std::find(texts.begin(), texts.end(), text) == texts.end())
        texts.push_back(text);
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  std::vector<std::string> settable_keys()
  {
    std::vector<std::string>                                         names;
    const std::function<void(const TableDescription &, std::string)> walk = [&](const TableDescription &table, const std::string &prefix)
    {
      for (const KeyDescription &key : table.keys)
      {
        if (key.name == KeyDescription::any_name)
          continue;
        const std::string name = prefix + key.name;
        bool              leaf = false;
        for (const ValueForm &form : key.forms)
          if (form.type == ValueForm::Type::table || form.type == ValueForm::Type::table_or_tables)
            walk(case_table(form.table), name + (form.type == ValueForm::Type::table ? "." : ".0."));
          else
            leaf = true;
        if (leaf && std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      }
    };
    walk(case_tables().front(), "");
    return names;
  }
} // namespace unilateral

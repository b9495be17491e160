// The VTU files hold what they say, bit for bit; files are written whole or not at all.
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/output/solution_vtu.h"
#include "unilateral/output/vtu_file.h"

#include <deal.II/base/function_lib.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/numerics/vector_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace
{
  using namespace unilateral;
  using dealii::DoFHandler;
  using dealii::Point;

  std::string read(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// A folder that is gone after the test.
  struct Folder
  {
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string &name) const { return (path / name).string(); }

    std::filesystem::path path = std::filesystem::temp_directory_path() / ("unilateral_test_output_" + std::to_string(getpid()));
  };

  /// The numbers of the array called @p name, which stand behind the XML, each array after its length in bytes.
  template <typename T>
  std::vector<T> array(const std::string &vtu, const std::string &name)
  {
    const auto tag = vtu.find("Name=\"" + name + "\"");
    EXPECT_NE(tag, std::string::npos) << name;
    const auto line_begin = vtu.rfind('\n', tag) + 1;
    const auto line = vtu.substr(line_begin, vtu.find('\n', tag) - line_begin);
    const auto attribute = [&](const std::string &key)
    {
      const auto begin = line.find(key + "=\"") + key.size() + 2;
      return line.substr(begin, line.find('"', begin) - begin);
    };
    EXPECT_EQ(attribute("format"), "appended");
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const char       *bytes = vtu.data() + vtu.find(mark) + mark.size() + std::stoul(attribute("offset"));
    std::uint64_t     length = 0;
    std::memcpy(&length, bytes, sizeof length);
    EXPECT_LE(bytes + sizeof length + length, vtu.data() + vtu.rfind("\n</AppendedData>\n</VTKFile>\n"));
    const auto numbers = [&](auto zero)
    {
      std::vector<decltype(zero)> found(length / sizeof zero);
      std::copy_n(bytes + sizeof length, length, reinterpret_cast<char *>(found.data()));
      return std::vector<T>(found.begin(), found.end());
    };
    if (attribute("type") == "Float64")
      return numbers(double());
    return attribute("type") == "Int32" ? numbers(std::int32_t()) : numbers(std::uint8_t());
  }

  /// Volume of a piece from its VTK corners.
  double measure(const std::vector<double> &points, const std::vector<std::int64_t> &corners, const std::uint8_t type)
  {
    const auto p = [&](const unsigned i)
    { return Point<3>(points[3 * corners[i]], points[3 * corners[i] + 1], points[3 * corners[i] + 2]); };
    const auto tetrahedron = [&](unsigned a, unsigned b, unsigned c, unsigned d)
    { return dealii::cross_product_3d(p(b) - p(a), p(c) - p(a)) * (p(d) - p(a)) / 6; };
    const auto triangle = [&](unsigned a, unsigned b, unsigned c) { return dealii::cross_product_3d(p(b) - p(a), p(c) - p(a))[2] / 2; };
    switch (type)
    {
    case 3:
      return p(1)[0] - p(0)[0];
    case 5:
      return triangle(0, 1, 2);
    case 9:
      return triangle(0, 1, 2) + triangle(0, 2, 3);
    case 10:
      return tetrahedron(0, 1, 2, 3);
    case 12:
      return tetrahedron(0, 1, 3, 4) + tetrahedron(1, 2, 3, 6) + tetrahedron(1, 5, 6, 4) + tetrahedron(3, 6, 7, 4) +
             tetrahedron(1, 3, 4, 6);
    }
    return -1;
  }

  template <int dim>
  double polynomial(const Point<dim> &p)
  {
    double value = 1;
    for (unsigned int d = 0; d < dim; ++d)
      value += (d + 1) * p[d] + p[d] * p[0] / 3;
    return value;
  }

  /// Writes a function of V_h on the unit box and reads it back.
  template <int dim>
  void check_box(const bool simplex, const unsigned int degree)
  {
    SCOPED_TRACE("dim " + std::to_string(dim) + (simplex ? " P" : " Q") + std::to_string(degree));
    MeshSpec spec;
    spec.source = MeshSpec::Source::box;
    spec.box_lower.assign(dim, 0.);
    spec.box_upper.assign(dim, 1.);
    spec.cells = {2};
    auto mesh = make_mesh<dim>(spec, simplex);
    mesh.triangulation->refine_global(1);

    std::unique_ptr<dealii::FiniteElement<dim>> fe;
    std::unique_ptr<dealii::Mapping<dim>>       mapping;
    if (simplex && dim > 1)
    {
      fe = std::make_unique<dealii::FE_SimplexP<dim>>(degree);
      mapping = std::make_unique<dealii::MappingFE<dim>>(dealii::FE_SimplexP<dim>(1));
    }
    else
    {
      fe = std::make_unique<dealii::FE_Q<dim>>(degree);
      mapping = std::make_unique<dealii::MappingQ<dim>>(1);
    }
    DoFHandler<dim> dof_handler(*mesh.triangulation);
    dof_handler.distribute_dofs(*fe);
    Vector u(dof_handler.n_dofs()), twice(dof_handler.n_dofs());
    dealii::VectorTools::interpolate(*mapping, dof_handler, dealii::ScalarFunctionFromFunctionObject<dim>(polynomial<dim>), u);
    twice.equ(2, u);

    Folder folder;
    write_solution_vtu<dim>(folder / "solution.vtu", *mapping, dof_handler, u, degree, {{"obstacle <0>", &twice}});
    const std::string vtu = read(folder / "solution.vtu");
    const auto        points = array<double>(vtu, "Points");
    const auto        values = array<double>(vtu, "u"), doubled = array<double>(vtu, "obstacle &lt;0>");
    const auto        connectivity = array<std::int64_t>(vtu, "connectivity"), offsets = array<std::int64_t>(vtu, "offsets");
    const auto        types = array<std::uint8_t>(vtu, "types");
    const auto        level = array<std::int64_t>(vtu, "level"), region = array<std::int64_t>(vtu, "region");

    EXPECT_EQ(points.size(), 3 * dof_handler.n_dofs()) << "neighbours share their points";
    EXPECT_EQ(values.size(), dof_handler.n_dofs());
    EXPECT_EQ(types.size(), mesh.triangulation->n_active_cells() * std::pow(degree, dim));
    EXPECT_EQ(offsets.size(), types.size());
    EXPECT_EQ(offsets.back(), std::int64_t(connectivity.size()));
    EXPECT_EQ(level, std::vector<std::int64_t>(types.size(), 1));
    EXPECT_EQ(region, std::vector<std::int64_t>(types.size(), 0));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = points[3 * i + d];
      for (unsigned int d = dim; d < 3; ++d)
        EXPECT_EQ(points[3 * i + d], 0);
      EXPECT_NEAR(values[i], polynomial<dim>(p), degree > 1 ? 1e-13 : 1e-1);
      EXPECT_NEAR(doubled[i], 2 * values[i], 1e-14);
    }
    double       volume = 0;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < types.size(); begin = offsets[c++])
    {
      const double piece = measure(points, {connectivity.begin() + begin, connectivity.begin() + offsets[c]}, types[c]);
      EXPECT_GT(piece, 0) << "corner order of piece " << c;
      volume += piece;
    }
    EXPECT_NEAR(volume, 1, 1e-12);
  }

  TEST(Output, SolutionOnSegmentsQuadrilateralsHexahedra)
  {
    for (const unsigned int degree : {1, 2, 4})
    {
      check_box<1>(false, degree);
      check_box<2>(false, degree);
    }
    check_box<3>(false, 1);
    check_box<3>(false, 3);
  }

  TEST(Output, SolutionOnTrianglesTetrahedra)
  {
    for (const unsigned int degree : {1, 2})
    {
      check_box<1>(true, degree);
      check_box<2>(true, degree);
      check_box<3>(true, degree);
    }
  }

  TEST(Output, VectorsHaveThreeComponents)
  {
    MeshSpec spec;
    spec.source = MeshSpec::Source::box;
    spec.box_lower = {0, 0};
    spec.box_upper = {1, 1};
    auto                            mesh = make_mesh<2>(spec, false);
    const dealii::FESystem<2>       fe(dealii::FE_Q<2>(1), 2);
    DoFHandler<2>                   dof_handler(*mesh.triangulation);
    const dealii::MappingQ<2>       mapping(1);
    const std::vector<unsigned int> component = {0, 1};
    dof_handler.distribute_dofs(fe);
    Vector u(dof_handler.n_dofs());
    dealii::VectorTools::interpolate(mapping, dof_handler, dealii::Functions::IdentityFunction<2>(), u);
    Folder folder;
    write_solution_vtu<2>(folder / "solution.vtu", mapping, dof_handler, u, 1);
    const std::string vtu = read(folder / "solution.vtu");
    EXPECT_EQ(array<double>(vtu, "u"), array<double>(vtu, "Points"));
  }

  TEST(Output, PiecesAreDescribedByTheArraysTheyHave)
  {
    VtuGrid grid;
    grid.points = {{0., 0., 0.}, {1., 0., 0.}};
    grid.point_arrays.push_back({"u", std::vector<double>{1., 2., 3., 4., 5., 6.}, 3});
    grid.cell_arrays.push_back({"region & part", std::vector<std::int32_t>{1}});
    const std::string text = to_pvtu(grid, {"a.0.vtu", "a.1.vtu"}), piece = to_vtu(grid);
    const auto        count = [&](const std::string &what)
    {
      std::size_t n = 0;
      for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
      return n;
    };
    EXPECT_EQ(count("<Piece Source="), 2u);
    EXPECT_EQ(count("<Piece Source=\"a.1.vtu\"/>"), 1u);
    EXPECT_EQ(count("<PDataArray type=\"Float64\" Name=\"u\" NumberOfComponents=\"3\"/>"), 1u);
    EXPECT_EQ(count("<PDataArray type=\"Int32\" Name=\"region &amp; part\" NumberOfComponents=\"1\"/>"), 1u);
    EXPECT_EQ(count("<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>"), 1u);
    // The pieces say how their bytes lie, and so does the whole.
    const auto order = piece.substr(piece.find("byte_order"), piece.find("header_type") - piece.find("byte_order"));
    EXPECT_EQ(count(order), 1u);
  }

  TEST(Output, ConstraintPoints)
  {
    ConstraintSet<2> set;
    set.points = {{Point<2>(0, 0), 0.1, 1, 1}, {Point<2>(1. / 3, 0), 0.2, 1, 1}, {Point<2>(1, 2), 0.3, -1, -1}};
    for (std::size_t i = 0; i < 3; ++i)
      set.trace.push_back(TraceRow());
    set.blocks.resize(2);
    set.blocks[0].side = Side::upper;
    set.blocks[0].begin = 0;
    set.blocks[0].end = 2;
    set.blocks[1].side = Side::lower;
    set.blocks[1].begin = 2;
    set.blocks[1].end = 3;

    Folder folder;
    write_constraint_points_vtu<2>(folder / "points.vtu", set, {0.25, 1.5, -3}, {0, 1. / 7, 2});
    const std::string vtu = read(folder / "points.vtu");
    using Numbers = std::vector<double>;
    using Integers = std::vector<std::int64_t>;
    EXPECT_EQ(array<double>(vtu, "Points"), (Numbers{0, 0, 0, 1. / 3, 0, 0, 1, 2, 0}));
    EXPECT_EQ(array<double>(vtu, "pressure"), (Numbers{0, 1. / 7, 2}));
    EXPECT_EQ(array<double>(vtu, "gap"), (Numbers{0.75, -0.5, -2}));
    EXPECT_EQ(array<double>(vtu, "penetration"), (Numbers{0, 0.5, 2}));
    EXPECT_EQ(array<double>(vtu, "weight"), (Numbers{0.1, 0.2, 0.3}));
    EXPECT_EQ(array<std::int64_t>(vtu, "active"), (Integers{0, 1, 1}));
    EXPECT_EQ(array<std::int64_t>(vtu, "side"), (Integers{1, 1, 0}));
    EXPECT_EQ(array<std::int64_t>(vtu, "block"), (Integers{0, 0, 1}));
    EXPECT_EQ(array<std::int64_t>(vtu, "offsets"), (Integers{1, 2, 3}));

    write_constraint_points_vtu<2>(folder / "none.vtu", {}, {}, {});
    EXPECT_TRUE(array<double>(read(folder / "none.vtu"), "pressure").empty());
    EXPECT_THROW(write_constraint_points_vtu<2>(folder / "wrong.vtu", set, {0}, {0, 0, 0}), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(folder / "wrong.vtu"));
  }

  TEST(Output, FilesAreReplacedAsAWhole)
  {
    Folder folder;
    write_file_atomically(folder / "a.txt", "old");
    write_file_atomically(folder / "a.txt", std::string("new\0 and more", 13));
    EXPECT_EQ(read(folder / "a.txt"), std::string("new\0 and more", 13));
    write_file_atomically(folder / "b.txt", [](std::ostream &out) { out << 42; });
    EXPECT_EQ(read(folder / "b.txt"), "42");

    EXPECT_THROW(write_file_atomically(folder / "a.txt", [](std::ostream &out) { out.setstate(std::ios::failbit); }), std::runtime_error);
    EXPECT_EQ(read(folder / "a.txt"), std::string("new\0 and more", 13));
    std::filesystem::create_directory(folder / "c");
    EXPECT_THROW(write_file_atomically(folder / "c", "x"), std::runtime_error);

    const auto entries = std::distance(std::filesystem::directory_iterator(folder.path), {});
    EXPECT_EQ(entries, 3) << "nothing temporary is left";
  }

  TEST(Output, FailuresNameThePath)
  {
    const auto message = [](const std::string &path) -> std::string
    {
      try
      {
        write_file_atomically(path, "x");
      }
      catch (const std::runtime_error &error)
      {
        return error.what();
      }
      return "no error";
    };
    for (const std::string path : {"/nonexistent/folder/file.txt", "/dev/full/x"})
      EXPECT_NE(message(path).find(path), std::string::npos) << message(path);
  }
} // namespace

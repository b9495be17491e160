// Parts of the boundary by where they are.
#include "unilateral/mesh/make_mesh.h"
#include "unilateral/mesh/named_parts.h"

#include <gtest/gtest.h>

#include <map>

namespace
{
  using namespace unilateral;
  using dealii::Point;

  template <int dim>
  std::map<std::string, unsigned> faces_by_part(const Mesh<dim> &mesh)
  {
    std::map<std::string, unsigned> n_faces;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      for (const unsigned f : cell->face_indices())
        if (cell->at_boundary(f))
          ++n_faces[mesh.part_names.at(cell->face(f)->boundary_id())];
    return n_faces;
  }

  using Counts = std::map<std::string, unsigned>;

  TEST(NamedParts, take_the_faces_whose_centres_lie_there)
  {
    auto        mesh = make_mesh<2>(box({0, 0}, {1, 1}, {4, 4}), false);
    Diagnostics diagnostics;
    name_parts<2>(mesh, {{"foot", FieldFunction([](const Point<2> &p) { return double(p[1] < 1e-9 && p[0] < 0.5); })}}, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty());
    EXPECT_EQ(faces_by_part(mesh), (Counts{{"left", 4}, {"right", 4}, {"bottom", 2}, {"top", 4}, {"foot", 2}}));
  }

  TEST(NamedParts, are_inherited_by_refinement)
  {
    for (const bool simplex : {false, true})
    {
      auto        mesh = make_mesh<3>(box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), simplex);
      Diagnostics diagnostics;
      name_parts<3>(mesh,
                    {{"corner", FieldFunction([](const Point<3> &p) { return double(p[2] > 1 - 1e-9 && p[0] < 0.5 && p[1] < 0.5); })}},
                    diagnostics);
      const unsigned before = faces_by_part(mesh)["corner"];
      EXPECT_EQ(before, simplex ? 2u : 1u);
      mesh.triangulation->refine_global(1);
      EXPECT_EQ(faces_by_part(mesh)["corner"], 4 * before);
    }
  }

  TEST(NamedParts, take_from_those_before_and_add_to_those_there_are)
  {
    auto                mesh = make_mesh<2>(box({0, 0}, {1, 1}, {4, 4}), true);
    Diagnostics         diagnostics;
    const FieldFunction low([](const Point<2> &p) { return double(p[1] < 0.5); }),
      right([](const Point<2> &p) { return double(p[0] > 1 - 1e-9); });
    name_parts<2>(mesh, {{"low", low}, {"top", right}}, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty());
    EXPECT_EQ(mesh.part_names.size(), 5u) << "top is there already";
    EXPECT_EQ(faces_by_part(mesh), (Counts{{"left", 2}, {"top", 8}, {"low", 6}}));
  }

  TEST(NamedParts, of_an_interval_are_its_ends)
  {
    auto        mesh = make_mesh<1>(box({0}, {1}, {4}), false);
    Diagnostics diagnostics;
    name_parts<1>(mesh, {{"ends", FieldFunction(1.)}}, diagnostics);
    EXPECT_EQ(faces_by_part(mesh), (Counts{{"ends", 2}}));
  }

  TEST(NamedParts, without_a_face_are_an_error_and_that_end_inside_faces_a_warning)
  {
    auto        mesh = make_mesh<2>(box({0, 0}, {1, 1}, {3, 3}), false);
    Diagnostics diagnostics;
    name_parts<2>(
      mesh, {{"inside", FieldFunction([](const Point<2> &p) { return double(p[0] > 0.1 && p[0] < 0.9 && p[1] > 0.1 && p[1] < 0.9); })}},
      diagnostics);
    ASSERT_EQ(diagnostics.all().size(), 1u);
    EXPECT_EQ(diagnostics.all()[0].name.text, "part-without-faces");
    EXPECT_EQ(diagnostics.all()[0].severity, Severity::error);

    Diagnostics warnings;
    name_parts<2>(mesh, {{"half", FieldFunction([](const Point<2> &p) { return double(p[0] < 0.4); })}}, warnings);
    ASSERT_EQ(warnings.all().size(), 1u);
    EXPECT_EQ(warnings.all()[0].name.text, "part-cuts-faces");
    EXPECT_EQ(warnings.all()[0].severity, Severity::warning);
    EXPECT_NE(warnings.all()[0].message.find("inside 2 of the faces"), std::string::npos) << warnings.all()[0].message;
    EXPECT_EQ(faces_by_part(mesh)["half"], 3u + 1 + 1) << "the faces in the middle have their centre at 0.5";
  }
} // namespace

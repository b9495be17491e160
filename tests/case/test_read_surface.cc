// Surfaces of rigid obstacles in a case: how they are read and written, and the mistakes in them.
#include "unilateral/case/read_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

using namespace unilateral;

namespace
{
  struct Reading
  {
    std::optional<SurfaceDescription> spec;
    std::string                       messages;
  };

  /// Reads `gap = <text>` at line 2.
  Reading read(const std::string &text, const unsigned dim)
  {
    TomlValue   document = parse_toml("# a case\ngap = " + text + "\n", "case.toml");
    Diagnostics diagnostics;
    Reading     result;
    result.spec = read_surface(*document.find("gap"), "gap", dim, "/home/me", diagnostics);
    for (const Diagnostic &diagnostic : sorted_by_place(diagnostics.all()))
      result.messages += to_string(diagnostic) + "\n";
    return result;
  }

  bool looks_like_a_surface(const std::string &text)
  {
    TomlValue document = parse_toml("gap = " + text, "case.toml");
    return is_surface(*document.find("gap"));
  }
} // namespace

TEST(ReadSurface, KnowsItsOwn)
{
  for (const char *const text : {"{ plane = 1 }", "{ sphere = {} }", "{ cylinder = {}, x = 1 }", "{ stl = \"a\" }"})
    EXPECT_TRUE(looks_like_a_surface(text)) << text;
  for (const char *const text : {"1", "\"plane\"", "[1, 2]", "{}", "{ raster = \"a.tif\" }", "{ planet = 1 }"})
    EXPECT_FALSE(looks_like_a_surface(text)) << text;
}

TEST(ReadSurface, Plane)
{
  const auto [spec, messages] = read("{ plane = { point = [0, -1], normal = [0, 2.5] } }", 2);
  EXPECT_EQ(messages, "");
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->kind, SurfaceDescription::Kind::plane);
  EXPECT_EQ(spec->point, (std::vector<double>{0, -1}));
  EXPECT_EQ(spec->direction, (std::vector<double>{0, 2.5}));
  EXPECT_EQ(spec->where.line, 2u);
  EXPECT_EQ(spec->where.column, 17u);
}

TEST(ReadSurface, Sphere)
{
  const auto spec = read("{ sphere = { center = [0, 0, -1], radius = 2, inside = true } }", 3).spec;
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->kind, SurfaceDescription::Kind::sphere);
  EXPECT_EQ(spec->point, (std::vector<double>{0, 0, -1}));
  EXPECT_EQ(spec->radius, 2);
  EXPECT_TRUE(spec->inside);
  const auto plain = read("{ sphere = { center = [0, 0] } }", 2).spec;
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->radius, 1);
  EXPECT_FALSE(plain->inside);
}

TEST(ReadSurface, Cylinder)
{
  const auto spec = read("{ cylinder = { point = [0, 0, 1], axis = [0, 1, 0], radius = 0.5 } }", 3).spec;
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->kind, SurfaceDescription::Kind::cylinder);
  EXPECT_EQ(spec->point, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(spec->direction, (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(spec->radius, 0.5);
}

TEST(ReadSurface, Stl)
{
  const auto spec = read("{ stl = \"tools/../die.stl\", scale = 0.001, shift = [1, 2, 3] }", 3).spec;
  ASSERT_TRUE(spec);
  EXPECT_EQ(spec->kind, SurfaceDescription::Kind::stl);
  EXPECT_EQ(spec->file, "/home/me/die.stl");
  EXPECT_EQ(spec->scale, 0.001);
  EXPECT_EQ(spec->shift, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(spec->where.column, 15u);
  const auto plain = read("{ stl = \"/data/die.stl\" }", 3).spec;
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->file, "/data/die.stl");
  EXPECT_EQ(plain->scale, 1);
  EXPECT_TRUE(plain->shift.empty());
}

TEST(ReadSurface, DoesNotCountWhenTheDimensionIsUnknown)
{
  for (const char *const text : {"{ plane = { point = [0, 0], normal = [0, 0, 1] } }", "{ sphere = { center = [0] } }",
                                 "{ cylinder = { point = [0, 0, 0], axis = [0, 0, 1] } }", "{ stl = \"a.stl\" }"})
  {
    const auto [spec, messages] = read(text, 0);
    EXPECT_TRUE(spec) << text;
    EXPECT_EQ(messages, "");
  }
}

TEST(ReadSurface, MistakesHaveAPlaceAndARemedy)
{
  struct Mistake
  {
    const char *text;
    unsigned    dim;
    const char *message;
  };
  for (const auto &[text, dim, message] : {
         Mistake{"3", 2,
                 "2:7: error: 'gap' must be { plane = .. }, { sphere = .. }, { cylinder = .. } or { stl = \"file\" }, not a number"},
         Mistake{"{}", 2, "2:7: error: 'gap' must hold one of plane, sphere, cylinder, stl"},
         Mistake{"{ spere = { center = [0, 0] } }", 2, "2:9: error: unknown key 'spere' in 'gap'; did you mean 'sphere'?"},
         Mistake{"{ plane = { point = [0, 0], normal = [0, 1] }, sphere = { center = [0, 0] } }", 2,
                 "2:54: error: 'gap' can hold only one of plane, sphere, cylinder, stl"},
         Mistake{"{ plane = 3 }", 2, "2:17: error: 'plane' must be { point = [0, 0], normal = [0, 1] }, not a number"},
         Mistake{"{ plane = {} }", 2,
                 "2:17: error: 'point' is missing in 'plane'; any point of the plane [missing-key]\ncase.toml:2:17: error: 'normal' is "
                 "missing in 'plane'; "
                 "it points out of the obstacle"},
         Mistake{"{ plane = { point = [0, 0, 0], normal = [0, 1] } }", 2, "2:27: error: 'point' must have 2 numbers in 2-D, it has 3"},
         Mistake{"{ plane = { point = [0, 0], normal = [0, 1, 0] } }", 3, "2:27: error: 'point' must have 3 numbers in 3-D, it has 2"},
         Mistake{"{ plane = { point = [0, 0], normal = [0, 0] } }", 2,
                 "2:44: error: 'normal' must not be zero; it points out of the obstacle"},
         Mistake{"{ plane = { point = [0, \"x\"], normal = [0, 1] } }", 2, "2:31: error: 'point' must be a number, not a string"},
         Mistake{"{ plane = { point = [0, inf], normal = [0, 1] } }", 2, "2:31: error: 'point' must be a finite number"},
         Mistake{"{ plane = { point = [0, 0], norml = [0, 1] } }", 2,
                 "2:35: error: unknown key 'norml' in 'plane'; did you mean 'normal'?"},
         Mistake{"{ plane = { point = [0, 0], normal = [0, 1], inside = true } }", 2,
                 "2:52: error: 'inside' in 'plane': a plane has no inside; turn its normal round"},
         Mistake{"{ plane = { point = [0, 0], normal = [0, 1] }, scale = 2 }", 2, "2:54: error: 'scale' in 'gap': only STL files have it"},
         Mistake{"{ sphere = { center = [0, 0], radius = 0 } }", 2, "2:46: error: 'radius' must be positive, it is 0"},
         Mistake{"{ sphere = { center = [0, 0], radius = -1.5 } }", 2, "2:46: error: 'radius' must be positive, it is -1.5"},
         Mistake{"{ sphere = { center = [0, 0], inside = 1 } }", 2,
                 "2:46: error: 'inside' must be true (the body lies inside the surface) or false, not a number"},
         Mistake{"{ sphere = { centre = [0, 0] } }", 2, "2:20: error: unknown key 'centre' in 'sphere'; did you mean 'center'?"},
         Mistake{"{ sphere = { radius = 1 } }", 2,
                 "2:18: error: 'center' is missing in 'sphere'; for example center = [0, 0], in 3-D [0, 0, 0]"},
         Mistake{"{ sphere = { center = [0, 0] }, inside = true }", 2,
                 "2:39: error: 'inside' in 'gap': belongs into the braces of the shape, sphere = { inside = .. }"},
         Mistake{"{ cylinder = { point = [0, 0], axis = [0, 1], radius = 1 } }", 2,
                 "2:9: error: a cylinder has three dimensions; in 2-D its section is a circle, sphere = { center = [0, 0], radius = 1 }"},
         Mistake{"{ cylinder = { point = [0, 0, 0], axis = [0, 0, 0] } }", 3, "2:48: error: 'axis' must not be zero"},
         Mistake{"{ cylinder = { point = [0, 0, 0] } }", 3, "2:20: error: 'axis' is missing in 'cylinder'; the direction of the axis"},
         Mistake{"{ stl = \"a.stl\" }", 2, "2:9: error: an STL file has three dimensions; in 2-D use plane, or sphere for a circle"},
         Mistake{"{ stl = \"\" }", 3, "2:15: error: 'stl' must be the name of a file"},
         Mistake{"{ stl = 1 }", 3, "2:15: error: 'stl' must be a string, not a number"},
         Mistake{"{ stl = \"a.stl\", scale = 0 }", 3, "2:32: error: 'scale' must be positive, it is 0"},
         Mistake{"{ stl = \"a.stl\", shift = [0, 0] }", 3, "2:32: error: 'shift' must have 3 numbers in 3-D, it has 2"},
         Mistake{"{ stl = \"a.stl\", normal = [0, 0, 1] }", 3,
                 "2:24: error: 'normal' in 'gap': an STL file has its own points and normals"},
         Mistake{"{ stl = \"a.stl\", scal = 1 }", 3, "2:24: error: unknown key 'scal' in 'gap'; did you mean 'scale'?"},
       })
  {
    const Reading reading = read(text, dim);
    EXPECT_FALSE(reading.spec) << text;
    EXPECT_NE(reading.messages.find(std::string("case.toml:") + message), std::string::npos) << text << ": " << reading.messages;
    // One mistake, one message.
    const std::size_t n_expected = 1 + std::count(message, message + std::char_traits<char>::length(message), '\n');
    EXPECT_EQ(static_cast<std::size_t>(std::count(reading.messages.begin(), reading.messages.end(), '\n')), n_expected) << reading.messages;
  }
}

TEST(ReadSurface, IsWrittenAsItIsRead)
{
  const std::map<std::string, unsigned> texts = {
    {"{ plane = { point = [0, -1], normal = [0, 1] } }", 2},
    {"{ plane = { point = [0.1, -1e-30, 1e+300], normal = [0.3333333333333333, 0, 1] } }", 3},
    {"{ sphere = { center = [0, 0], radius = 2.5, inside = false } }", 2},
    {"{ cylinder = { point = [0, 0, 1], axis = [0, 1, 0], radius = 1, inside = true } }", 3},
    {"{ stl = \"/a \\\"b\\\"\\\\c\\u0007\\n.stl\", scale = 0.001, shift = [1, 2, 3] }", 3},
  };
  for (const auto &[text, dim] : texts)
  {
    const auto [spec, messages] = read(text, dim);
    ASSERT_TRUE(spec) << messages;
    EXPECT_EQ(surface_text(*spec), text);
  }
  EXPECT_EQ(surface_text(*read("{ stl = \"x.stl\" }", 3).spec), "{ stl = \"/home/me/x.stl\", scale = 1, shift = [0, 0, 0] }");
  EXPECT_EQ(surface_text(*read("{ sphere = { center = [0, 0] } }", 2).spec),
            "{ sphere = { center = [0, 0], radius = 1, inside = false } }");
}

TEST(TomlQuoted, SurvivesReading)
{
  std::string everything;
  for (int c = 1; c < 128; ++c)
    everything += static_cast<char>(c);
  everything += "\xc3\xa9";
  EXPECT_EQ(parse_toml("a = " + toml_quoted(everything), "case.toml").find("a")->string, everything);
}

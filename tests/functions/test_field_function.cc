// Functions of position: what they compute, and how they fail.

#include "unilateral/functions/compile_field.h"
#include "unilateral/functions/expression.h"

#include <gdal.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

using namespace unilateral;
using dealii::Point;

namespace
{
  double evaluate(const std::string &text, const double x = 0, const double y = 0, const double z = 0)
  {
    return compile_field(FieldSpec::expression(text), {}).value(Point<3>(x, y, z));
  }

  Parameter parameter(const std::string &name, const std::string &text)
  {
    return {name, FieldSpec::expression(text), {}};
  }

  std::string message_of(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const InputError &e)
    {
      return e.what();
    }
    return "";
  }

  class Files : public testing::Test
  {
  protected:
    Files() : folder(std::filesystem::temp_directory_path() / ("unilateral_field_function_" + std::to_string(::getpid())))
    {
      std::filesystem::create_directories(folder);
      GDALAllRegister();
    }
    ~Files() override { std::filesystem::remove_all(folder); }

    std::string file(const std::string &name) const { return (folder / name).string(); }

    /// Writes pixels, row by row from the top, in the format of the driver.
    std::string write_raster(const std::string                          &name,
                             const char                                 *driver,
                             const GDALDataType                          type,
                             const int                                   columns,
                             const int                                   rows,
                             const std::vector<double>                  &pixels,
                             const std::optional<std::array<double, 6>> &transform,
                             const std::optional<double>                &nodata = {}) const
    {
      const GDALDatasetH    memory = GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, type, nullptr);
      const GDALRasterBandH band = GDALGetRasterBand(memory, 1);
      if (transform)
        GDALSetGeoTransform(memory, const_cast<double *>(transform->data()));
      if (nodata)
        GDALSetRasterNoDataValue(band, *nodata);
      auto copy = pixels;
      EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, columns, rows, copy.data(), columns, rows, GDT_Float64, 0, 0), CE_None);
      const GDALDatasetH written = GDALCreateCopy(GDALGetDriverByName(driver), file(name).c_str(), memory, 0, nullptr, nullptr, nullptr);
      EXPECT_NE(written, nullptr);
      GDALClose(written);
      GDALClose(memory);
      return file(name);
    }

    static FieldSpec raster(const std::string &path)
    {
      FieldSpec spec;
      spec.kind = FieldSpec::Kind::raster;
      spec.file = path;
      return spec;
    }

    FieldFunction profile(const std::string &text) const
    {
      std::ofstream(file("profile.csv")) << text;
      FieldSpec spec;
      spec.kind = FieldSpec::Kind::profile;
      spec.file = file("profile.csv");
      return compile_field(spec, {});
    }

    const std::filesystem::path folder;
  };

  /// A linear function sampled at the pixel centres of a raster.
  std::vector<double>
  sample_linear(const int columns, const int rows, const std::array<double, 6> &t, const double a, const double b, const double c)
  {
    std::vector<double> pixels;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
      {
        const double x = t[0] + (column + 0.5) * t[1] + (row + 0.5) * t[2], y = t[3] + (column + 0.5) * t[4] + (row + 0.5) * t[5];
        pixels.push_back(a + b * x + c * y);
      }
    return pixels;
  }
} // namespace

TEST(Expressions, ComputeWhatTheySay)
{
  EXPECT_DOUBLE_EQ(evaluate("x + 2*y - z/4", 1, 2, 4), 4);
  EXPECT_DOUBLE_EQ(evaluate("-2^2"), -4);
  EXPECT_DOUBLE_EQ(evaluate("-x^2", 3), -9);
  EXPECT_DOUBLE_EQ(evaluate("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(evaluate("2^-x", 2), 0.25);
  EXPECT_DOUBLE_EQ(evaluate("2--x", 3), 5);
  EXPECT_DOUBLE_EQ(evaluate("2*-x", 3), -6);
  EXPECT_DOUBLE_EQ(evaluate("8/4/2"), 1);
  EXPECT_DOUBLE_EQ(evaluate("1e-2 + .5 + 2. + 1E1"), 12.51);
  EXPECT_DOUBLE_EQ(evaluate("sin(pi*x)", 0.5), 1);
  EXPECT_DOUBLE_EQ(evaluate("log(e) + ln(e) + log10(100) + log2(8)"), 7);
  EXPECT_DOUBLE_EQ(evaluate("if(x > 1/3 && x < 2/3, 5, 7)", 0.5), 5);
  EXPECT_DOUBLE_EQ(evaluate("if(x > 1/3 && x < 2/3, 5, 7)", 0.9), 7);
  EXPECT_DOUBLE_EQ(evaluate("x > 0 ? y > 0 ? 1 : 2 : 3", 1, -1), 2);
  EXPECT_DOUBLE_EQ(evaluate("min(x, y, z) + max(x) + sum(x, y, z) + avg(x, y, z)", 1, 2, 3), 1 + 1 + 6 + 2);
  EXPECT_DOUBLE_EQ(evaluate("atan2(y, x)", -1, 0), std::numbers::pi);
  EXPECT_DOUBLE_EQ(evaluate("hypot(x, y) + pow(x, 2) + abs(-y)", 3, 4), 5 + 9 + 4);
  EXPECT_DOUBLE_EQ(evaluate("mod(x, 1)", -0.25), 0.75);
  EXPECT_DOUBLE_EQ(evaluate("sign(x) + 10*sign(y) + 100*sign(z)", -2, 0, 5), 99);
  EXPECT_DOUBLE_EQ(evaluate("clamp(x, 0, 1) + clamp(y, 0, 1) + clamp(z, 0, 1)", -3, 0.25, 3), 1.25);
  EXPECT_DOUBLE_EQ(evaluate("floor(x) + ceil(x) + round(x)", 1.6), 1 + 2 + 2);
  EXPECT_DOUBLE_EQ(evaluate("(x == 1) + (x != 1) + (x <= 1) + (x >= 2) + (x || y)", 1), 3);
  EXPECT_DOUBLE_EQ(evaluate("\n x \t+\r\n 1", 1), 2);
}

// The branch that is not taken may be anything.
TEST(Expressions, UntakenBranchNeedNotBeFinite)
{
  EXPECT_DOUBLE_EQ(evaluate("if(x < 1, sqrt(1 - x^2), -10)", 2), -10);
  EXPECT_DOUBLE_EQ(evaluate("x < 1 ? sqrt(1 - x^2) : -10", 2), -10);
}

TEST(Expressions, EveryFunctionIsKnownToTheParser)
{
  for (const std::string &name : function_names())
  {
    std::string failures;
    bool        read = false;
    for (const char *const arguments : {"(0.5)", "(0.5, 0.5)", "(0.5, 0.5, 0.5)"})
      try
      {
        compile_field(FieldSpec::expression(name + arguments), {});
        read = true;
      }
      catch (const InputError &e)
      {
        failures += e.what();
      }
    // acosh(0.5) is not a number, and says so
    EXPECT_TRUE(read || failures.find("not finite") != std::string::npos) << name << failures;
  }
}

TEST(Expressions, ParametersMayUseEachOtherInAnyOrder)
{
  const std::vector<Parameter> parameters = {parameter("s", "r^2 + a"),
                                             parameter("r", "sqrt(x^2+y^2)"),
                                             parameter("a", "2*b"),
                                             {"b", FieldSpec::constant(3), {}},
                                             parameter("unused", "log(-1)*x")};
  const FieldFunction          f = compile_field(FieldSpec::expression("s + r + a*z"), parameters);
  EXPECT_FALSE(f.is_constant());
  EXPECT_DOUBLE_EQ(f.value(Point<3>(3, 4, 1)), 31 + 5 + 6);
  EXPECT_DOUBLE_EQ(f.value(Point<3>(0, 0, 0)), 6);
  const FieldFunction copy = f;
  EXPECT_DOUBLE_EQ(copy.value(Point<3>(3, 4, 1)), 42);
  EXPECT_DOUBLE_EQ(f.value(Point<3>(0, 1, 0)), 8);
}

// Each parameter is evaluated once a point: 60 doublings would otherwise take 2^60 steps.
TEST(Expressions, NestedParametersAreEvaluatedOnce)
{
  std::vector<Parameter> parameters = {parameter("p0", "x")};
  for (int i = 1; i <= 60; ++i)
    parameters.push_back(parameter("p" + std::to_string(i), "(p" + std::to_string(i - 1) + " + p" + std::to_string(i - 1) + ")/2"));
  EXPECT_DOUBLE_EQ(compile_field(FieldSpec::expression("p60"), parameters).value(Point<1>(0.75)), 0.75);
}

TEST(Expressions, WithoutCoordinatesAreConstants)
{
  EXPECT_TRUE(compile_field(FieldSpec::expression("2*A"), {parameter("A", "B"), parameter("B", "pi")}).is_constant());
  EXPECT_TRUE(compile_field(FieldSpec::expression("A - A"), {parameter("A", "1")}).is_zero());
  EXPECT_TRUE(FieldFunction().is_zero());
  EXPECT_FALSE(FieldFunction(2.).is_zero());
  EXPECT_FALSE(compile_field(FieldSpec::expression("0*x"), {}).is_zero());
}

TEST(Expressions, ValuesThatAreNotFiniteNameThePoint)
{
  FieldSpec spec = FieldSpec::expression("log(r)");
  spec.where = {"case.toml", 3, 7};
  const FieldFunction f = compile_field(spec, {parameter("r", "sqrt(x^2+y^2)")});
  EXPECT_NEAR(f.value(Point<2>(std::numbers::e, 0)), 1, 1e-15);
  EXPECT_EQ(message_of([&] { f.value(Point<2>(0, 0)); }),
            "case.toml:3:7: error: the value at (0, 0) is not finite, it is -inf: the expression 'log(r)' with r = 0 [no-value]");
}

TEST(Expressions, FaultsOfAParameterAreReportedAtTheParameter)
{
  Parameter wrong = parameter("r", "sqrtt(x)");
  wrong.value.where = {"case.toml", 2, 6};
  EXPECT_EQ(message_of([&] { compile_field(FieldSpec::expression("r"), {wrong}); }),
            "case.toml:2:6: error: unknown function 'sqrtt' in expression; did you mean 'sqrt'? [unknown-function]");
}

TEST(Gradient, IsTheDerivative)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const FieldFunction                    f = compile_field(FieldSpec::expression("x^2*y + sin(z) + 3*x"), {});
  for (int i = 0; i < 100; ++i)
  {
    const Point<3> p(uniform(random), uniform(random), uniform(random));
    const auto     gradient = f.gradient(p);
    EXPECT_NEAR(gradient[0], 2 * p[0] * p[1] + 3, 1e-8);
    EXPECT_NEAR(gradient[1], p[0] * p[0], 1e-8);
    EXPECT_NEAR(gradient[2], std::cos(p[2]), 1e-8);
  }
  EXPECT_EQ(FieldFunction(3.).gradient(Point<2>()).norm(), 0);
}

TEST(Gradient, IsOneSidedAtTheEdgeOfTheDomain)
{
  const FieldFunction f = compile_field(FieldSpec::expression("x*sqrt(1-x) + sqrt(x)^2"), {});
  EXPECT_NEAR(f.gradient(Point<1>(0))[0], 2, 1e-4);
  const FieldFunction nowhere = compile_field(FieldSpec::expression("log(-1-x^2)"), {});
  EXPECT_THROW(nowhere.gradient(Point<1>(0)), InputError);
}

// Bilinear interpolation is exact for linear data in every format and orientation, away from the outer half pixel.
TEST_F(Files, RastersAreExactForLinearData)
{
  struct Format
  {
    const char           *name, *driver;
    GDALDataType          type;
    std::array<double, 6> transform;
    double                a, b, c, tolerance;
  };
  const double              s = std::sin(0.3), k = std::cos(0.3);
  const std::vector<Format> formats = {
    {"north_up.tif", "GTiff", GDT_Float64, {-1, 0.25, 0, 2, 0, -0.25}, 1, 2, -3, 1e-13},
    {"south_up.tif", "GTiff", GDT_Float64, {-1, 0.25, 0, -1, 0, 0.25}, 1, 2, -3, 1e-13},
    {"turned.tif", "GTiff", GDT_Float64, {-1, 0.25 * k, 0.5 * s, 2, 0.25 * s, -0.5 * k}, 1, 2, -3, 1e-13},
    {"mirrored.tif", "GTiff", GDT_Float64, {5, -0.25, 0, 2, 0, -0.5}, 1, 2, -3, 1e-13},
    {"single.tif", "GTiff", GDT_Float32, {0, 0.5, 0, 4, 0, -0.5}, 1, 2, -3, 1e-5},
    {"geographic.tif", "GTiff", GDT_Float64, {500000, 10, 0, 5200000, 0, -10}, 1, 0.5, -0.25, 1e-8},
    {"grid.asc", "AAIGrid", GDT_Float32, {-1, 0.25, 0, 2, 0, -0.25}, 1, 2, -3, 1e-5},
    {"whole.tif", "GTiff", GDT_Int16, {0, 2, 0, 20, 0, -2}, 1, 2, -3, 1e-12},
  };
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(0.5, 1);
  const int                              columns = 9, rows = 7;
  for (const Format &format : formats)
  {
    const auto         &t = format.transform;
    const auto          pixels = sample_linear(columns, rows, t, format.a, format.b, format.c);
    const FieldFunction f = compile_field(raster(write_raster(format.name, format.driver, format.type, columns, rows, pixels, t)), {});
    for (int i = 0; i < 200; ++i)
    {
      const double column = 0.5 + (columns - 1) * (2 * uniform(random) - 1), row = 0.5 + (rows - 1) * (2 * uniform(random) - 1);
      const double x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] + row * t[5];
      EXPECT_NEAR(f.value(Point<2>(x, y)), format.a + format.b * x + format.c * y, format.tolerance) << format.name;
      EXPECT_EQ(f.value(Point<3>(x, y, 17)), f.value(Point<2>(x, y)));
    }
    EXPECT_NEAR(f.sample_spacing(), std::min(std::hypot(t[1], t[4]), std::hypot(t[2], t[5])), 1e-9);
    const double x = t[0] + 4 * t[1] + 3 * t[2], y = t[3] + 4 * t[4] + 3 * t[5];
    EXPECT_NEAR(f.gradient(Point<2>(x, y))[1], format.c, 1e-2) << format.name;
  }
}

TEST_F(Files, SixteenBitPngNeedsAnExtent)
{
  // Heights in millimetres, first row at the top.
  const std::string path = write_raster("relief.png", "PNG", GDT_UInt16, 3, 2, {1000, 2000, 3000, 0, 1000, 65535}, {});
  EXPECT_NE(message_of([&] { compile_field(raster(path), {}); }).find("give extent"), std::string::npos);

  FieldSpec spec = raster(path);
  spec.extent = {{{0, 0}, {3, 2}}};
  spec.scale = 0.001;
  spec.offset = 1;
  const FieldFunction f = compile_field(spec, {});
  EXPECT_NEAR(f.value(Point<2>(0.5, 1.5)), 2, 1e-12);
  EXPECT_NEAR(f.value(Point<2>(2.5, 0.5)), 66.535, 1e-12);
  EXPECT_NEAR(f.value(Point<2>(1, 1.5)), 2.5, 1e-12);
  EXPECT_NEAR(f.value(Point<2>(1, 1)), 1 + 0.001 * (1000 + 2000 + 0 + 1000) / 4, 1e-12);
}

TEST_F(Files, PointsOnNoGridMakeNoRaster)
{
  // 38 bytes: GDAL takes the points for four of a grid of 1 000 000 x 92.
  std::ofstream(file("scattered.xyz")) << "0 0 1\n1 0 2\n1E6 0 0 1\n1 1 31 4\n\n1 91 8";
  EXPECT_NE(message_of([&] { compile_field(raster(file("scattered.xyz")), {}); }).find("do not lie on a grid"), std::string::npos);
  // One with gaps is still one.
  std::ofstream(file("gaps.xyz")) << "0 0 1\n1 0 2\n2 0 3\n0 1 4\n2 1 6\n";
  EXPECT_DOUBLE_EQ(compile_field(raster(file("gaps.xyz")), {}).value(Point<3>(0, 1, 0)), 4);
}

TEST_F(Files, RastersAreConstantInTheOuterHalfPixelAndEndThere)
{
  FieldSpec spec = raster(write_raster("edge.tif", "GTiff", GDT_Float64, 2, 2, {1, 2, 3, 4}, std::array<double, 6>{0, 1, 0, 2, 0, -1}));
  spec.where = {"case.toml", 4, 20};
  const FieldFunction f = compile_field(spec, {});
  EXPECT_DOUBLE_EQ(f.value(Point<2>(0, 2)), 1);
  EXPECT_DOUBLE_EQ(f.value(Point<2>(2, 0)), 4);
  EXPECT_DOUBLE_EQ(f.value(Point<2>(1, 2)), 1.5);
  EXPECT_DOUBLE_EQ(f.value(Point<2>(2 + 1e-9, 1)), 3); // an edge missed by rounding
  EXPECT_EQ(message_of([&] { f.value(Point<2>(2.5, 1)); }),
            "case.toml:4:20: error: no value at (2.5, 1): outside the raster, which covers [[0, 0], [2, 2]] [no-value]");
  EXPECT_NEAR(f.gradient(Point<2>(2, 1))[1], -2, 1e-6);
}

TEST_F(Files, PixelsWithoutDataAreFilledOrRefused)
{
  for (const bool by_nan : {false, true})
  {
    const double        missing = by_nan ? std::numeric_limits<double>::quiet_NaN() : -9999;
    FieldSpec           spec = raster(write_raster(by_nan ? "nan.tif" : "nodata.tif", "GTiff", GDT_Float64, 3, 1, {1, 2, missing},
                                                   std::array<double, 6>{0, 1, 0, 1, 0, -1}, by_nan ? std::nullopt : std::optional<double>(-9999)));
    const FieldFunction strict = compile_field(spec, {});
    EXPECT_DOUBLE_EQ(strict.value(Point<2>(1.5, 0.5)), 2); // the neighbour has no weight
    EXPECT_NE(message_of([&] { strict.value(Point<2>(1.75, 0.5)); }).find("no value at (1.75, 0.5): the raster has no data there"),
              std::string::npos);
    spec.nodata = -5;
    spec.scale = 100;
    const FieldFunction filled = compile_field(spec, {});
    EXPECT_DOUBLE_EQ(filled.value(Point<2>(1.75, 0.5)), -5);
    EXPECT_DOUBLE_EQ(filled.value(Point<2>(1, 0.5)), 150);
  }
}

TEST_F(Files, GdalKeepsQuiet)
{
  std::ofstream(file("broken.tif"), std::ios::binary) << "II*\0 garbage that looks like a TIFF";
  testing::internal::CaptureStderr();
  EXPECT_THROW(compile_field(raster(file("broken.tif")), {}), InputError);
  EXPECT_THROW(compile_field(raster(file("nowhere.tif")), {}), InputError);
  EXPECT_THROW(compile_field(raster("/vsicurl/http://localhost/a.tif"), {}), InputError);
  // A TIFF file of 149 bytes that says it has 49 920 x 2 pixels with 32 257 interleaved bands, one strip of 3.2 GB.
  const std::string digits =
    "49492a000c000000010203040b00000103000100000002c300000101030001000000000200000201030001000000080000000301030001000000010000000601"
    "030001000000010000001101040001000000080000001501030001000000017e00001601030001000000020000001701040001000000040000000e830c003020"
    "310a31203020320a20312033537431337275000000";
  std::ofstream bands(file("bands.tif"), std::ios::binary);
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bands.put(char(std::stoi(digits.substr(i, 2), nullptr, 16)));
  bands.close();
  EXPECT_NE(message_of([&] { compile_field(raster(file("bands.tif")), {}); }).find("bands"), std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Files, ProfilesAreLinearBetweenRows)
{
  for (const char *const text :
       {"x, height\n0, 1\n1, 3\n3, -1\n", "0;1\n1;3\n3;-1", "\xef\xbb\xbf# metres\r\n\r\nstation\theight\r\n0\t1\r\n1\t+3\r\n3\t-1\r\n",
        "  0   1\n  1   3.0e0\n  3  -1\n"})
  {
    const FieldFunction f = profile(text);
    EXPECT_DOUBLE_EQ(f.value(Point<1>(0)), 1);
    EXPECT_DOUBLE_EQ(f.value(Point<1>(0.25)), 1.5);
    EXPECT_DOUBLE_EQ(f.value(Point<1>(1)), 3);
    EXPECT_DOUBLE_EQ(f.value(Point<1>(2)), 1);
    EXPECT_DOUBLE_EQ(f.value(Point<1>(3)), -1);
    EXPECT_DOUBLE_EQ(f.sample_spacing(), 1);
    EXPECT_NEAR(f.gradient(Point<1>(3))[0], -2, 1e-6);
    EXPECT_NE(message_of([&] { f.value(Point<1>(3.5)); }).find("no value at (3.5): outside the profile, which covers [0, 3]"),
              std::string::npos);
  }
}

TEST_F(Files, ProfilesMustBeTables)
{
  EXPECT_NE(message_of([&] { profile("x,y\nx,y\n0,1\n"); }).find("line 2: 'x' is not a number"), std::string::npos);
  EXPECT_NE(message_of([&] { profile("0,1,2\n1,2,3\n"); }).find("line 1: two columns expected"), std::string::npos);
  EXPECT_NE(message_of([&] { profile("0,1\n0,2\n"); }).find("line 2: x must increase"), std::string::npos);
  EXPECT_NE(message_of([&] { profile("0,1\n1,nan\n"); }).find("'nan' is not a number"), std::string::npos);
  EXPECT_NE(message_of([&] { profile(""); }).find("two rows"), std::string::npos);
}

// Plain matrices as rasters.
#include "unilateral/functions/matrix_file.h"
#include "unilateral/functions/raster.h"

#include "text_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace unilateral;

TEST(MatrixFile, is_read_with_any_separator)
{
  for (const char *const text : {"1,2,3\n4,5,6\n", "# heights\n1; 2 ;3\r\n\n4;5;+6\r\n", "1 2  3\n 4 5 6", "1\t2\t3\n4\t5\t6\n"})
  {
    const auto matrix = read_matrix(TextFile(".csv", text).name, 100);
    EXPECT_EQ(matrix.n_columns, 3u) << text;
    EXPECT_EQ(matrix.n_rows, 2u) << text;
    EXPECT_EQ(matrix.values, (std::vector<double>{1, 2, 3, 4, 5, 6})) << text;
  }
}

TEST(MatrixFile, has_gaps_between_commas)
{
  const auto matrix = read_matrix(TextFile(".csv", "1,,3\n4,nan,6\n").name, 100);
  EXPECT_TRUE(std::isnan(matrix.values[1]));
  EXPECT_TRUE(std::isnan(matrix.values[4]));
}

TEST(MatrixFile, refuses_what_is_no_matrix)
{
  for (const char *const text : {"", "# nothing\n", "1,2\n3\n", "1,two\n", "1,2,3,4,5,6\n"})
    EXPECT_THROW(read_matrix(TextFile(".csv", text).name, 5), std::runtime_error) << text;
  try
  {
    read_matrix(TextFile(".csv", "1,2\n3,x\n").name, 5);
    FAIL();
  }
  catch (const std::runtime_error &error)
  {
    EXPECT_NE(std::string(error.what()).find("line 2: 'x' is no number"), std::string::npos) << error.what();
  }
}

TEST(MatrixFile, is_a_raster_with_its_first_row_on_top)
{
  const TextFile file(".csv", "1,2\n3,4\n");
  const Raster   raster(file.name, Raster::Extent{{{0, 0}, {2, 2}}});
  EXPECT_EQ(raster.sample(0.5, 1.5), 1.);
  EXPECT_EQ(raster.sample(1.5, 1.5), 2.);
  EXPECT_EQ(raster.sample(0.5, 0.5), 3.);
  EXPECT_EQ(raster.sample(1, 1), 2.5);
}

#include "unilateral/base/byte_archive.h"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace unilateral;

TEST(ByteArchive, what_was_written_is_read)
{
  ByteWriter writer;
  writer(2.5);
  writer(std::string("nodal"));
  writer(std::vector<double>{1, 2, 3});
  writer(std::optional<double>());
  writer(std::optional<double>(7));
  writer(std::string());

  ByteReader            reader(writer.bytes);
  double                number = 0;
  std::string           text, empty = "x";
  std::vector<double>   list = {9};
  std::optional<double> absent = 1, present;
  reader(number);
  reader(text);
  reader(list);
  reader(absent);
  EXPECT_FALSE(reader.at_end());
  reader(present);
  reader(empty);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(number, 2.5);
  EXPECT_EQ(text, "nodal");
  EXPECT_EQ(list, (std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(absent);
  EXPECT_EQ(present, 7);
  EXPECT_EQ(empty, "");
  EXPECT_THROW(reader(number), std::out_of_range);
}

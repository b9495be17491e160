// The launcher reads cases without Gmsh and GDAL, whose libraries are as slow to load as deal.II's. What would call them says so instead.
#pragma once

#include <exception>

namespace unilateral
{
  /// Thrown in the place of a call: the command is for the program that has these libraries.
  class LibraryIsAbsent : public std::exception
  {
  public:
    const char *what() const noexcept override { return "this program has neither Gmsh nor GDAL"; }
  };
} // namespace unilateral

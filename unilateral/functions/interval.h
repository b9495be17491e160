// Sets of numbers between two bounds, and what arithmetic makes of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  /// All numbers from `least` to `most`; none where least > most. What operators return contains every result of numbers in their operands,
  /// but for rounding. What has no value somewhere, as a root of negative numbers, contains the values that there are, and says so.
  struct Interval
  {
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    double least = 0, most = 0;
    bool   undefined = false; ///< somewhere

    static Interval of(const double value) { return {value, value}; }
    static Interval all() { return {-infinity, infinity}; }
    static Interval none() { return {infinity, -infinity, true}; }

    bool empty() const { return !(least <= most); }
    bool contains(const double value) const { return least <= value && value <= most; }
    bool inside(const Interval &other) const { return empty() || (other.least <= least && most <= other.most); }
    bool is_number() const { return least == most; }

    Interval where_defined(const bool everywhere) const { return {least, most, undefined || !everywhere}; }

    /// Everything where a bound is not a number.
    Interval checked() const { return std::isnan(least) || std::isnan(most) ? Interval{-infinity, infinity, true} : *this; }
  };

  inline Interval hull(const Interval &a, const Interval &b)
  {
    return {std::min(a.least, b.least), std::max(a.most, b.most), a.undefined || b.undefined};
  }

  inline Interval intersection(const Interval &a, const Interval &b)
  {
    return {std::max(a.least, b.least), std::min(a.most, b.most), a.undefined || b.undefined};
  }

  inline Interval operator-(const Interval &a)
  {
    return {-a.most, -a.least, a.undefined};
  }

  inline Interval operator+(const Interval &a, const Interval &b)
  {
    return a.empty() || b.empty() ? Interval::none() : Interval{a.least + b.least, a.most + b.most, a.undefined || b.undefined}.checked();
  }

  inline Interval operator-(const Interval &a, const Interval &b)
  {
    return a + -b;
  }

  inline Interval operator*(const Interval &a, const Interval &b)
  {
    if (a.empty() || b.empty())
      return Interval::none();
    const auto product = [](const double x, const double y) { return x == 0 || y == 0 ? 0. : x * y; }; // 0 times a bound that is infinite
    const auto [least, most] =
      std::minmax({product(a.least, b.least), product(a.least, b.most), product(a.most, b.least), product(a.most, b.most)});
    return Interval{least, most, a.undefined || b.undefined}.checked();
  }

  inline Interval operator/(const Interval &a, const Interval &b)
  {
    if (a.empty() || b.empty() || (b.least == 0 && b.most == 0))
      return Interval::none();
    if (b.least < 0 && b.most > 0)
      return {-Interval::infinity, Interval::infinity, true};
    return a * Interval{b.most == 0 ? -Interval::infinity : 1 / b.most, b.least == 0 ? Interval::infinity : 1 / b.least,
                        b.undefined || b.contains(0)};
  }
} // namespace unilateral

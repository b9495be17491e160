// Triangles drawn into an image, without a screen: parallel projection, hidden surfaces by depth.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// Red, green, blue of a part of one, 0 dark, 1 bright; steps look alike, also in grey and to those who see few colours (viridis).
  std::array<std::uint8_t, 3> colour_of(double part);

  class Image
  {
  public:
    using Points = std::vector<std::array<float, 3>>;
    using Triangles = std::vector<std::array<std::uint32_t, 3>>;

    enum class View
    {
      top,    ///< along z, x to the right and y up
      oblique ///< from the front, the right and above
    };

    /// A surface one can see through, and which of its points are left out.
    struct Sheet
    {
      Points            points;
      std::vector<bool> hidden;
    };

    /// @p upward_axis: of the oblique view; 0, 1, 2 are x, y, z. With y up, x is to the right and z towards the eye.
    Image(unsigned width, unsigned height, View view, unsigned upward_axis = 2);

    /// Scale and place for these points to fill the image.
    void fit(const Points &points);

    /// The triangles in the colours of @p values at their points, linear between them, over [low, high]; grey where a value is not finite.
    /// @p zero_is_pale: and pale where it is 0, as without contact; up to a twelfth of @p high, and in triangles at the rim, colours go
    /// over into that.
    void
    draw(const Points &points, const Triangles &triangles, const std::vector<float> &values, double low, double high, bool zero_is_pale);

    /// The same triangles with other points, grey, over what lies behind them.
    void draw_translucent(const Sheet &sheet, const Triangles &triangles);

    using Colour = std::array<std::uint8_t, 3>;

    /// Straight lines, so many pixels wide, where no surface that was drawn before hides them.
    void draw_lines(const Points &points, const std::vector<std::array<std::uint32_t, 2>> &lines, double line_width, const Colour &colour);

    /// Discs of a diameter in pixels, hidden likewise.
    void draw_dots(const Points &points, double diameter, const Colour &colour);

    /// Transparent where nothing was drawn. Throws std::runtime_error.
    std::string png() const;

  private:
    std::array<double, 3> seen(const std::array<float, 3> &x) const;

    /// A disc about a place in pixels, at a depth.
    void dab(double x, double y, double z, double radius, const Colour &colour);

    template <typename Shade>
    void fill(const std::array<std::array<double, 3>, 3> &corners, const Shade &shade);

    unsigned                  width, height;
    View                      view;
    unsigned                  upward_axis;
    double                    scale = 1, shift_x = 0, shift_y = 0, depth_of_field = 1;
    std::vector<float>        depth; ///< larger: nearer
    std::vector<std::uint8_t> rgba;
  };
} // namespace unilateral

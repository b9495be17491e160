// A picture of a scene without a screen: the surface drawn into an image, axes and scale as SVG around it.
#pragma once

#include "unilateral/report/scene.h"

#include <string>

namespace unilateral
{
  struct PictureOptions
  {
    std::string field; ///< what colours show; "": the contact pressure, of bodies the von Mises stress
    unsigned    width = 900, height = 600;
    bool        standalone = true; ///< with a style sheet and a white ground, else in the colours of the page around it
  };

  /// An SVG of the scene: a membrane or plate as a surface with the height u (exaggerated where that is small), a body deformed, with the
  /// factor of the deformation; in 1-D a plot of u, its bounds and the pressure. "" for an empty scene.
  /// Throws InputError where there is no such field; the message lists those that there are.
  std::string picture_svg(const Scene &scene, const std::string &title, const PictureOptions &options = {});

  /// u against its bounds along default_section_line(), the pressure below; for bodies and in space the pressure at the points of I_G.
  /// "" where there is nothing to be shown.
  std::string section_svg(const Scene &scene, bool standalone = false);

  /// The factor by which displacements are shown: 1, or as much as makes the largest 8 % of the body's size where it is below 2 %.
  double deformation_factor(const Scene &scene);

  /// An image of the SVG, as PNG, by the program rsvg-convert. Throws std::runtime_error when that is missing or fails.
  std::string png_of_svg(const std::string &svg);
} // namespace unilateral

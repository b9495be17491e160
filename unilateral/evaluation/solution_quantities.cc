#include "unilateral/evaluation/solution_quantities.h"

namespace unilateral
{
  std::vector<SolutionQuantity> solution_quantities(const unsigned n_components, const unsigned order, const unsigned dim)
  {
    using Kind = SolutionQuantity::Kind;
    const auto                    axis = [](const unsigned d) { return std::string(1, "xyz"[d]); };
    const bool                    body = n_components > 1;
    std::vector<SolutionQuantity> all;
    for (unsigned c = 0; c < n_components; ++c)
    {
      const std::string u = body ? "u" + axis(c) : "u";
      all.push_back({u, Kind::value, c});
      for (unsigned d = 0; d < dim; ++d)
        all.push_back({"d" + u + "_d" + axis(d), Kind::gradient, c, d});
    }
    if (order == 2)
      for (unsigned d = 0; d < dim; ++d)
        for (unsigned e = d; e < dim; ++e)
          all.push_back({d == e ? "d2u_d" + axis(d) + "2" : "d2u_d" + axis(d) + "d" + axis(e), Kind::hessian, d, e});
    if (order == 1 && !body)
      for (unsigned d = 0; d < dim; ++d)
        all.push_back({"flux_" + axis(d), Kind::flux, d});
    if (body)
    {
      unsigned i = 0;
      for (const char *const component : {"xx", "yy", "zz", "xy", "xz", "yz"})
        if (i++ < (dim == 3 ? 6 : 4))
          all.push_back({std::string("stress_") + component, Kind::flux, i - 1});
      all.push_back({"von_mises", Kind::von_mises});
    }
    for (unsigned d = 0; d < dim; ++d)
      all.push_back({"n" + axis(d), Kind::normal, d});
    all.push_back({"pressure", Kind::pressure});
    all.push_back({"gap", Kind::gap});
    return all;
  }

  std::vector<std::string> names_of(const std::vector<SolutionQuantity> &quantities)
  {
    std::vector<std::string> names;
    for (const SolutionQuantity &quantity : quantities)
      names.push_back(quantity.name);
    return names;
  }
} // namespace unilateral

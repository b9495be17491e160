// A form of one's own: an orthotropic body, a sheet of wood whose fibres run along x, pressed by a rigid plate. The program's own forms are
// isotropic; this one is stated here, in one class, and everything else is the library's: contact, solvers, certificate.
#include <unilateral/base/mpi_session.h>
#include <unilateral/solve.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

using namespace unilateral;
using dealii::SymmetricTensor;
using dealii::types::boundary_id;
using dealii::types::material_id;

namespace
{
  /// a(u, v) = int C eps(u) : eps(v), plane stress: sigma_xx = C11 e_xx + C12 e_yy, sigma_yy = C12 e_xx + C22 e_yy, sigma_xy = 2 G e_xy.
  class OrthotropicSheet : public BilinearForm<2>
  {
  public:
    OrthotropicSheet(const double E_x, const double E_y, const double nu_xy, const double G)
    {
      const double scale = 1 / (1 - nu_xy * nu_xy * E_y / E_x);
      C[0][0][0][0] = E_x * scale;
      C[1][1][1][1] = E_y * scale;
      C[0][0][1][1] = C[1][1][0][0] = nu_xy * E_y * scale;
      C[0][1][0][1] = G;
    }

    unsigned n_components() const override { return 2; }
    unsigned order() const override { return 1; }
    bool     symmetric() const override { return true; }

    void add_cell_terms(const dealii::FEValues<2> &values, dealii::FullMatrix<double> &matrix, dealii::Vector<double> &) const override
    {
      const auto &u = values[displacement];
      for (const unsigned q : values.quadrature_point_indices())
        for (const unsigned j : values.dof_indices())
        {
          const SymmetricTensor<2, 2> stress = C * u.symmetric_gradient(j, q) * values.JxW(q);
          for (const unsigned i : values.dof_indices())
            matrix(i, j) += stress * u.symmetric_gradient(i, q);
        }
    }

    /// The H^1 product, in whose norm errors and the inf-sup constant are measured.
    void add_gram_terms(const dealii::FEValues<2> &values, dealii::FullMatrix<double> &matrix) const override
    {
      const auto &u = values[displacement];
      for (const unsigned q : values.quadrature_point_indices())
        for (const unsigned i : values.dof_indices())
          for (const unsigned j : values.dof_indices())
            matrix(i, j) += (u.value(i, q) * u.value(j, q) + dealii::scalar_product(u.gradient(i, q), u.gradient(j, q))) * values.JxW(q);
    }

    bool has_face_terms(boundary_id) const override { return false; }
    void add_face_terms(const dealii::FEFaceValues<2> &, boundary_id, dealii::FullMatrix<double> &, dealii::Vector<double> &) const override
    {
    }

    /// xx, yy, zz, xy of the stress, as the program's own bodies have them.
    unsigned n_flux_components() const override { return 4; }
    void     flux(const dealii::FEValues<2> &values, const dealii::Vector<double> &u, std::vector<Flux> &at) const override
    {
      at.assign(values.n_quadrature_points, Flux{});
      for (const unsigned q : values.quadrature_point_indices())
      {
        SymmetricTensor<2, 2> strain;
        for (const unsigned i : values.dof_indices())
          strain += u(i) * values[displacement].symmetric_gradient(i, q);
        const SymmetricTensor<2, 2> stress = C * strain;
        at[q] = {stress[0][0], stress[1][1], 0, stress[0][1]};
      }
    }

    double flux_energy(const Flux &flux, material_id, const dealii::Point<2> &) const override
    {
      SymmetricTensor<2, 2> stress;
      stress[0][0] = flux[0];
      stress[1][1] = flux[1];
      stress[0][1] = flux[3];
      return stress * (dealii::invert(C) * stress);
    }

    bool uniform_in(material_id) const override { return true; }

    std::vector<RigidBodyMode<2>> rigid_body_modes(const dealii::Point<2> &centre) const override
    {
      using dealii::Point, dealii::Tensor;
      return {{"translation along x",
               [](const Point<2> &) {
                 return Tensor<1, 2>({1, 0});
               }},
              {"translation along y",
               [](const Point<2> &) {
                 return Tensor<1, 2>({0, 1});
               }},
              {"rotation in the plane", [centre](const Point<2> &x) {
                 return Tensor<1, 2>({centre[1] - x[1], x[0] - centre[0]});
               }}};
    }

    std::pair<double, SourceLocation> load_samples() const override { return {0, {}}; }

  private:
    SymmetricTensor<4, 2>                    C;
    const dealii::FEValuesExtractors::Vector displacement{0};
  };
} // namespace

int main()
{
  const MpiSession mpi;
  const double     E_x = 11e9, E_y = 0.4e9, nu_xy = 0.4, G = 0.7e9, travel = 1e-4; // spruce, in Pa and m

  ProblemStatement problem;
  problem.mesh = refined(box({0, 0}, {0.1, 0.05}, {8, 4}), 3);
  problem.model.kind = Model::Kind::elasticity; // u is a vector
  problem.model.element = {ElementName::Family::Q, 2};
  problem.own_form.in_2d = [&](const auto &, const auto &) { return std::make_unique<OrthotropicSheet>(E_x, E_y, nu_xy, G); };
  problem.boundary = {{.part = "left", .symmetry = true}, {.part = "bottom", .symmetry = true}};
  problem.constraints = {{.gap = FieldFunction(-travel), .on = "top"}}; // the plate has come down by its travel

  Diagnostics       warnings;
  Progress          silent;
  const Solution<2> solution = solve<2>(problem, warnings, silent);

  // The sides are free: the stress is sigma_yy = -E_y travel/height and nothing else.
  const RunResult &result = solution.result;
  const double     exact = E_y * travel / 0.05;
  double           largest_error = 0;
  for (std::size_t i = 0; i < solution.constraint_set.size(); ++i)
    largest_error = std::max(largest_error, std::abs(solution.contact_pressure(i) / exact - 1));
  std::printf("%s: contact pressure %.6g Pa, relative error at most %.1e\n", result.converged ? "solved" : result.reason.c_str(),
              solution.contact_pressure(0), largest_error);
  return result.converged && largest_error < 1e-4 ? 0 : 1;
}

// A displacement that keeps the gaps everywhere, next to a discrete one that keeps them at points.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/base/processes.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/equilibration/straight_face.h"
#include "unilateral/equilibration/tabulated_element.h"

#include <deal.II/base/tensor.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// v in K, the set of the continuous problem: prescribed components have their values and v.n <= s on the flat faces of the contact part,
  /// not only at the points of I_G. A body that contact alone holds is moved as a whole by what it penetrates on average. u_h is then moved
  /// off the obstacle by a linear or multilinear function, in the plane by what vertices penetrate, in space by the most that a face does
  /// after its nodes have been put where the obstacle is. In the plane the rest, min(w.n + s - I s, s) - w.n in contact and min(w.n, s) -
  /// w.n elsewhere (w what has been moved, I the interpolation at nodes), and the difference between prescribed values and those of u_h, is
  /// continued from the sides into their cells.
  template <int dim>
  class FeasibleDisplacement
  {
  public:
    /// @p u with its prescribed values; @p pressures: functions of V_h, by condition, see nodal_pressure(). Collective: v is continuous
    /// across cuts between subdomains.
    FeasibleDisplacement(const Problem<dim> &problem, const Vector &u, const std::vector<Vector> &pressures);

    /// Why v would not be in K as far as that is known; empty: it is. The same on all processes.
    const std::string &obstacle() const { return reason; }

    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// v - u_h is no polynomial on the cell.
    bool is_lifted(const Cell &cell) const { return lifts.count(cell->active_cell_index()) > 0; }

    struct AtPoints
    {
      std::vector<dealii::Tensor<1, dim>> u, v;
      std::vector<dealii::Tensor<2, dim>> u_gradient, v_gradient; ///< [c][d]: derivative of component c
    };
    void evaluate(const Cell                                 &cell,
                  const TabulatedElement<dim>                &tabulated,
                  const typename StraightCell<dim>::AtPoints &at,
                  AtPoints                                   &state) const;

    /// n.p on the nodes of a cell, p a function of V_h.
    Eigen::VectorXd along(const Vector &p, const Cell &cell, const dealii::Tensor<1, dim> &n) const;

    const dealii::FiniteElement<dim> &scalar() const { return problem.space.fe->base_element(0); }

  private:
    struct ContactFace
    {
      Cell              cell;
      unsigned          face;
      std::size_t       condition;
      StraightFace<dim> geometry;
    };
    struct Move
    {
      dealii::Tensor<1, dim> normal;
      double                 amount;
    };
    /// By vertex: the directions in which it may not move, and how far it has to along each normal.
    struct AtVertex
    {
      std::vector<dealii::Tensor<1, dim>> held;
      std::vector<Move>                   moves;
    };

    /// On one side of a cell: what v is to be more than w, and its derivative by the parameter.
    struct Excess
    {
      dealii::Tensor<1, dim> value, slope;
    };

    /// The scalar element at points of a face of the reference cell.
    struct OnFace
    {
      OnFace(const dealii::FiniteElement<dim> &scalar, unsigned face, const std::vector<dealii::Point<dim - 1>> &points);
      std::vector<dealii::Point<dim - 1>> points;
      Eigen::MatrixXd                     values, slopes; ///< rows: points; derivative by the first parameter of the face
    };

    Eigen::MatrixXd on_cell(const Vector &w, const Cell &cell) const; ///< nodes x components
    /// What the faces in contact, or all of one kind, ask for.
    struct Penetration
    {
      bool                any = false;
      std::vector<double> of_face, of_condition; ///< the largest
    };

    void                       find_contact_faces();
    void                       hold_vertices();
    void                       share_held_directions();               // collective
    void                       move_as_a_whole();                     // collective
    std::vector<unsigned>      nodes_on(const ContactFace &at) const; ///< of the cell
    void                       put_nodes_into_contact();              // collective
    void                       put_nodes_of_faces(bool closed);
    void                       agree_at_cuts(const Vector &before); // collective
    void                       move_off_obstacles();                // collective
    Penetration                find_penetration(double tolerance);
    void                       add_move(const ContactFace &contact, unsigned corner, double amount);
    void                       add_move(std::vector<Move> &moves, const Move &move) const;
    void                       share_moves(); // collective
    void                       apply_moves();
    static std::vector<double> amounts_together(const std::vector<Move> &moves);
    void                       check_faces();
    bool                       in_contact(const ContactFace &contact) const;
    bool                       touches(const ContactFace &contact) const; ///< in contact, or next to the obstacle somewhere
    void                       look_for_jumps();

    std::vector<Excess> excess_at(const Cell &cell, unsigned face, const OnFace &feet) const;
    void                add_contact_excess(const ContactFace &contact, const OnFace &feet, std::vector<Excess> &result) const;
    void                add_prescribed_excess(const Cell &cell, unsigned face, const OnFace &feet, std::vector<Excess> &result) const;

    const Problem<dim>                          &problem;
    const Vector                                &u;
    const std::vector<Vector>                   &pressures;
    std::vector<OnFace>                          to_check; ///< by face of the reference cell
    Vector                                       moved;
    std::vector<ContactFace>                     contact;
    std::map<std::size_t, std::vector<unsigned>> contact_of_cell; ///< by active cell index: numbers in `contact`
    std::vector<AtVertex>                        vertices;
    std::map<std::size_t, std::vector<unsigned>> lifts;                   ///< by active cell index: faces
    double                                       size = 0;                ///< of displacements and gaps in contact
    bool                                         held_in_the_way = false; ///< a vertex cannot move off an obstacle, being held
    std::string                                  reason;
    const Processes                             &processes;
  };
} // namespace unilateral

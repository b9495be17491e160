// MPI and the libraries that live on it, from construction to destruction.
#pragma once

#include <deal.II/base/mpi.h>

namespace unilateral
{
  /// One object in main(), before anything else of deal.II; a second one is an error of MPI. Each process uses one thread.
  class MpiSession
  {
  public:
    MpiSession();

    unsigned rank() const;
    unsigned n_ranks() const;

  private:
    dealii::Utilities::MPI::MPI_InitFinalize session;
  };
} // namespace unilateral

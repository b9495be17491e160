// What an unfinished run had come to on a level, as another run needs it to go on from there.
#pragma once

#include "unilateral/functions/cell_functions.h"

#include <memory>

namespace unilateral
{
  struct FormerLevel
  {
    unsigned                             level = 0; ///< coarser ones need not be solved
    std::shared_ptr<const CellFunctions> functions; ///< StartingGuess::functions on it
  };
} // namespace unilateral

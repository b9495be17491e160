// The sections of a report as HTML; each is "" where the folder holds nothing for it.
#pragma once

#include "unilateral/report/results_folder.h"

#include <string>

namespace unilateral
{
  std::string verdict_section(const ResultsFolder &folder);
  std::string contact_section(const ResultsFolder &folder);
  std::string balance_section(const ResultsFolder &folder);
  std::string certificate_section(const ResultsFolder &folder);
  std::string convergence_section(const ResultsFolder &folder);
  std::string epsilon_section(const ResultsFolder &folder);
  std::string adaptive_section(const ResultsFolder &folder);
  std::string mesh_study_section(const ResultsFolder &folder);
  std::string quadrature_section(const ResultsFolder &folder);
  std::string infsup_section(const ResultsFolder &folder);
  std::string sweep_section(const ResultsFolder &folder);
  std::string steps_section(const ResultsFolder &folder); ///< load curves and a table of the steps
  std::string case_section(const ResultsFolder &folder);
  std::string downloads_section(const ResultsFolder &folder);
} // namespace unilateral

// report.html: results as one page that needs nothing beside it.
#pragma once

#include "unilateral/report/results_folder.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// One folder: its report. A sweep: that of its runs (@p steps), one after the other. Several folders: side by side.
  /// The page reads without JavaScript; with it, pictures turn and sections can be drawn. It loads nothing, and no script but its own
  /// runs in it (Content-Security-Policy by the script's hash); all texts from outside are escaped.
  std::string report_html(const std::vector<ResultsFolder> &folders, const std::vector<ResultsFolder> &steps = {});

  /// Writes report.html into @p directory, of what is there now; of a sweep with its runs. @p of: the folder that it will become, whose
  /// name it has then and whose studies are in it; "": this one. Throws InputError and std::runtime_error.
  void write_report(const std::string &directory, const std::string &of = "");
} // namespace unilateral

// What the steps of a load history leave in the folder of the results: a folder each, and a table of all.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace unilateral
{
  /// "step-003" for step 2 of up to 999.
  std::string folder_of_step(std::size_t k, std::size_t n_steps);

  /// The numbers of steps worth a column or a curve, as paths into an entry of `steps` in results.json
  /// ("constraint.0.total_contact_force"): those that the first entry has.
  std::vector<std::string> quantities_of_steps(const nlohmann::ordered_json &steps);

  /// The number at a path, NaN where there is none.
  double quantity_of_step(const nlohmann::ordered_json &step, const std::string &path);

  /// step_history.csv: a line a step, with its number, the values that steps set, quantities_of_steps(), and the status.
  std::string steps_to_csv(const nlohmann::ordered_json &steps);

  /// The value of the first key that is a number in all steps and grows from each to the next, its name in @p key; else the numbers of the
  /// steps, from 1, and "step".
  std::vector<double> abscissa_of_steps(const nlohmann::ordered_json &steps, std::string &key);

  /// Removes what a load history has left in @p directory, its table, the folders of its steps and what an unfinished one has left
  /// to be resumed; other files stay.
  void remove_old_steps(const std::string &directory);

  /// Leaves the folders of the first @p k steps, by the names that they have among @p n_steps, and removes those of others; the table and
  /// what is to be resumed stay.
  void keep_steps(std::size_t k, std::size_t n_steps, const std::string &directory);

  /// restart.json and restart-N-P.bin, see case/restart.h.
  bool is_restart_file(const std::string &name);
  void remove_restart(const std::string &directory);
} // namespace unilateral

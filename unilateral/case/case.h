// What the user asked for: the problem with the texts of its functions, parameters and expectations. read_case.h reads and writes it.
#pragma once

#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/functions/field_spec.h"
#include "unilateral/output/results.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  using MeshSpec = RefinedMeshOf<FieldSpec>;           ///< [mesh]
  using CoefficientSpecs = CoefficientsOf<FieldSpec>;  ///< of [model] and [[material]]
  using MaterialSpec = MaterialOf<FieldSpec>;          ///< [[material]]
  using ModelSpec = ModelOf<FieldSpec>;                ///< [model]
  using BoundarySpec = BoundaryConditionOf<FieldSpec>; ///< a line of [boundary]
  using PeriodicSpec = PeriodicPartsOf<FieldSpec>;     ///< [[periodic]]
  using SupportSpec = InnerSupportOf<FieldSpec>;       ///< [[support]]
  using ConstraintSpec = UnilateralBoundOf<FieldSpec>; ///< [constraint] or [[constraint]]
  using ExactSpec = ExactSolutionOf<FieldSpec>;        ///< [exact]

  /// What a program hands over beside the text of a case. There `{ given = 2 }` in place of a function is functions[2], and `given = 0`
  /// as the source of the mesh is `mesh`.
  struct GivenData
  {
    std::vector<std::shared_ptr<const GivenFunction>> functions = {};
    std::shared_ptr<const CellList>                   mesh = {};
    std::vector<std::string>                          expressions = {}; ///< of the program's own, which may use parameters of the case
  };

  /// What a step of a load history sets.
  struct StepSetting
  {
    std::string           key;    ///< as --set has it: "parameters.d", "boundary.top"
    std::string           value;  ///< as TOML has it
    std::optional<double> number; ///< where it is one
  };

  struct Case;

  /// [[step]]: one problem of a load history. What it does not set stays as the step before has left it.
  struct LoadStep
  {
    std::vector<StepSetting> settings;
    SourceLocation           where;
    std::vector<Parameter>   parameters; ///< all of them, as they are in this step
    std::vector<StepSetting> values;     ///< of all other keys that some step sets, as far as the case has them in this step
    std::shared_ptr<const Case>
      others; ///< has the rest, where a step up to this one has set more than parameters; none: as the case has it
  };

  struct Case : ProblemStatementOf<FieldSpec>, CaseSource
  {
    GivenData given;

    std::string name; ///< file name without .toml

    std::vector<Parameter>   parameters;
    std::vector<LoadStep>    steps; ///< none: the case is a single problem
    std::vector<Expectation> expect;

    /// [output]: which files a run writes beside its numbers.
    struct
    {
      bool     vtu = true, csv = false, report = true;
      unsigned every = 1; ///< of a load history: fields are written for every n-th step and the last; 0: for that alone
    } files;

    unsigned dimension = 0; ///< of the mesh

    /// The names that the mesh can have, as far as they are known before it is built; empty when it cannot be read.
    std::vector<std::string> part_names, region_names;
  };
} // namespace unilateral

// Kernels of the multigrid solver: products with A in double precision, steps of the smoother in single precision, V-cycles; nanoseconds
// and bytes per unknown. Usage: build/bench/multigrid [--benchmark_filter=...]
#include "unilateral/multigrid/multigrid.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/discretisation/mesh_hierarchy.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/multigrid/cell_operator.h"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <map>

namespace
{
  using namespace unilateral;

  struct Levels
  {
    std::shared_ptr<LevelHierarchy> hierarchy = std::make_shared<LevelHierarchy>();
    std::vector<double>             x;
  };

  template <int dim>
  Levels make_levels(const std::string &model, const std::string &mesh, const unsigned refine)
  {
    const std::string text = fmt::format("[mesh]\n{}\nrefine = {}\n[model]\n{}\n[boundary]\nall = {}\n", mesh, refine, model,
                                         model.find("elasticity") == std::string::npos ? "0" : "\"clamped\"");
    Diagnostics       diagnostics;
    const Case        request = parse_case(text, "bench.toml", {}, diagnostics);
    Problem<dim>      problem(problem_of(request), diagnostics);
    Levels            levels;
    add_level(*levels.hierarchy, problem);
    std::vector<Vector> nothing;
    for (unsigned l = 0; l < refine; ++l)
    {
      problem.refine(nothing);
      add_level(*levels.hierarchy, problem);
    }
    levels.x.resize(levels.hierarchy->finest().n_dofs());
    for (std::size_t i = 0; i < levels.x.size(); ++i)
      levels.x[i] = double(i % 17) / 17;
    for (const auto dof : levels.hierarchy->finest().fixed())
      levels.x[dof] = 0;
    return levels;
  }

  /// One hierarchy is kept at a time.
  Levels &levels_of(const std::string &name)
  {
    static std::string current;
    static Levels      levels;
    if (current != name)
    {
      levels = Levels();
      current = name;
      const std::string square = "box = [[0, 0], [1, 1]]\ncells = 4", cube = "box = [[0, 0, 0], [1, 1, 1]]\ncells = 2",
                        disc = "ball = { center = [0, 0], radius = 1 }", ball = "ball = { center = [0, 0, 0], radius = 1 }";
      const auto membrane = [](const unsigned p) { return fmt::format("kind = \"membrane\"\nelement = \"Q{}\"", p); };
      const auto body = [](const unsigned p)
      { return fmt::format("kind = \"elasticity\"\nyoung = 1\npoisson = 0.3\nelement = \"Q{}\"", p); };
      if (name == "square Q1")
        levels = make_levels<2>(membrane(1), square, 8);
      else if (name == "square Q2")
        levels = make_levels<2>(membrane(2), square, 7);
      else if (name == "square Q4")
        levels = make_levels<2>(membrane(4), square, 6);
      else if (name == "disc Q1")
        levels = make_levels<2>(membrane(1), disc, 7);
      else if (name == "cube Q1")
        levels = make_levels<3>(membrane(1), cube, 6);
      else if (name == "cube Q2")
        levels = make_levels<3>(membrane(2), cube, 5);
      else if (name == "cube Q4")
        levels = make_levels<3>(membrane(4), cube, 4);
      else if (name == "ball Q1")
        levels = make_levels<3>(membrane(1), ball, 5);
      else if (name == "elastic cube Q1")
        levels = make_levels<3>(body(1), cube, 5);
      else if (name == "elastic cube Q2")
        levels = make_levels<3>(body(2), cube, 4);
    }
    return levels;
  }

  void report(benchmark::State &state, const std::size_t n_dofs)
  {
    state.counters["dofs"] = n_dofs;
    state.counters["MDoF/s"] = benchmark::Counter(1e-6 * n_dofs * state.iterations(), benchmark::Counter::kIsRate);
  }

  void product(benchmark::State &state, const std::string &name)
  {
    auto               &levels = levels_of(name);
    const auto         &op = levels.hierarchy->finest();
    std::vector<double> y(levels.x.size());
    for (auto _ : state)
      op.vmult(y.data(), levels.x.data());
    report(state, y.size());
    state.counters["B/DoF"] = double(op.memory()) / y.size();
  }

  /// A product in single precision, fused with a step of the smoother.
  void smoothing(benchmark::State &state, const std::string &name)
  {
    auto       &levels = levels_of(name);
    const auto &sweep = *levels.hierarchy->levels.back().sweep;
    LevelVector x(sweep.size(), 0.f), step(x), b(x), inverse_diagonal(x), terms(x);
    for (auto _ : state)
      sweep.smooth({x.data(), step.data(), step.data(), b.data(), inverse_diagonal.data(), 0.1f, 0.1f}, {}, terms.data());
    report(state, levels.x.size());
    state.counters["B/DoF"] = double(sweep.memory()) / levels.x.size();
  }

  void v_cycle(benchmark::State &state, const std::string &name)
  {
    auto               &levels = levels_of(name);
    Multigrid           multigrid(levels.hierarchy, Multigrid::Parameters());
    std::vector<double> y(levels.x.size());
    multigrid.set_penalty(std::vector<double>(y.size(), 0.), {}, {});
    for (auto _ : state)
      multigrid.vmult(y.data(), levels.x.data());
    report(state, y.size());
    state.counters["B/DoF"] = double(multigrid.memory()) / y.size();
  }
} // namespace

int main(int argc, char **argv)
{
  for (const std::string name :
       {"square Q1", "square Q2", "square Q4", "disc Q1", "cube Q1", "cube Q2", "cube Q4", "ball Q1", "elastic cube Q1", "elastic cube Q2"})
  {
    benchmark::RegisterBenchmark((name + "/product, double").c_str(), product, name);
    benchmark::RegisterBenchmark((name + "/smoothing step, float").c_str(), smoothing, name);
    benchmark::RegisterBenchmark((name + "/V-cycle").c_str(), v_cycle, name);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

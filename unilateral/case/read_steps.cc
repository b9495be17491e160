#include "unilateral/case/read_steps.h"

#include "unilateral/case/case_check.h"
#include "unilateral/case/load_steps.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_field.h"
#include "unilateral/case/solution_fields.h"
#include "unilateral/case/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <tuple>
#include <utility>

namespace unilateral
{
  namespace
  {
    constexpr std::size_t most_steps = 10000;

    /// A key and the value that a step gives it, each at its place.
    struct Assignment
    {
      std::string    key;
      SourceLocation where;
      TomlValue      value;
    };

    struct RawStep
    {
      std::vector<Assignment> assignments;
      SourceLocation          where;
    };

    /// Why a step cannot set @p key; empty: it can.
    std::string why_not_in_a_step(const std::string &key)
    {
      const std::vector<std::string> words = split_path(key);
      for (const char *const name : {"title", "mesh", "part", "output", "functional", "expect", "step", "steps"})
        if (words[0] == name)
          return fmt::format("'{}' is the same in all steps; 'unilateral sweep' runs a case with several values of it", name);
      for (const char *const name : {"model.kind", "model.element", "model.assumption", "model.integration", "method.solver"})
        if (key == name)
          return fmt::format("'{}' is the same in all steps: they share the mesh and the matrices", name);
      if (words.back() == "quadrature")
        return "the rule of a constraint is the same in all steps";
      return "";
    }

    class StepsReader
    {
    public:
      StepsReader(const std::string &folder, const Case &request, Diagnostics &diagnostics)
        : folder(folder), request(request), diagnostics(diagnostics)
      {
      }

      /// [[step]]
      std::vector<RawStep> read_each(const TomlValue &value)
      {
        std::vector<RawStep> steps;
        for (const TomlValue *const content : read_tables(value, "step", diagnostics))
        {
          RawStep step{{}, content->where};
          for (const TomlEntry &entry : content->entries)
            if (entry.key == "set")
              for (const TomlEntry &setting : entries_of_set(entry))
                add(step, setting.key, setting.where, setting.value);
            else if (is_parameter(entry))
              add(step, "parameters." + entry.key, entry.where, entry.value);
          steps.push_back(std::move(step));
        }
        check_number(steps.size(), value.where);
        return steps;
      }

      /// [steps]: lists, as long as each other.
      std::vector<RawStep> read_lists(const TomlValue &value)
      {
        if (value.kind != TomlValue::Kind::table)
        {
          diagnostics.error(value.where,
                            fmt::format("[steps] has a list of values for each key, not {}; single steps are [[step]]", value.kind_name()),
                            MessageName("wrong-type"));
          return {};
        }
        std::optional<std::size_t> n;
        SourceLocation             n_from;
        std::vector<Assignment>    lists;
        const auto                 take = [&](const std::string &key, const SourceLocation &where, const TomlValue &list)
        {
          auto values = values_of(key, list);
          if (!values)
            return;
          if (n && *n != values->elements.size())
            diagnostics.error(list.where,
                              fmt::format("'{}' has {} values, line {} asks for {} steps", key, values->elements.size(), n_from.line, *n),
                              MessageName("wrong-length"));
          if (!n)
            n_from = list.where;
          n = n.value_or(values->elements.size());
          lists.push_back({key, where, std::move(*values)});
        };
        for (const TomlEntry &entry : value.entries)
          if (entry.key == "count")
          {
            if (const auto count = read_count(entry.value))
              take_count(*count, entry.value.where, n, n_from);
          }
          else if (entry.key == "set")
            for (const TomlEntry &setting : entries_of_set(entry))
              take(setting.key, setting.where, setting.value);
          else if (is_parameter(entry))
            take("parameters." + entry.key, entry.where, entry.value);
        if (!n && !diagnostics.has_errors())
          diagnostics.error(value.where,
                            "[steps] makes no steps; give a parameter a list of values, d = [0.01, 0.02] or d = \"0.01:0.1:10\"",
                            MessageName("does-nothing"));
        check_number(n.value_or(0), value.where);
        std::vector<RawStep> steps(diagnostics.has_errors() ? 0 : n.value_or(0), RawStep{{}, value.where});
        for (std::size_t k = 0; k < steps.size(); ++k)
          for (const Assignment &list : lists)
            add(steps[k], list.key, list.where, list.value.elements[k]);
        return steps;
      }

    private:
      void take_count(const std::size_t count, const SourceLocation &where, std::optional<std::size_t> &n, SourceLocation &n_from)
      {
        if (n && *n != count)
          diagnostics.error(where, fmt::format("'count' is {}, line {} has {} values", count, n_from.line, *n),
                            MessageName("wrong-length"));
        n = count;
        n_from = where;
      }

      std::optional<std::size_t> read_count(const TomlValue &value)
      {
        if (value.kind == TomlValue::Kind::integer && value.integer > 0)
          return value.integer;
        diagnostics.error(value.where, "'count' must be a whole number from 1, the number of steps", MessageName("out-of-range"));
        return {};
      }

      void check_number(const std::size_t n, const SourceLocation &where)
      {
        if (n > most_steps)
          diagnostics.error(where, fmt::format("these are {} steps, {} are possible", n, most_steps), MessageName("out-of-range"));
      }

      const std::vector<TomlEntry> &entries_of_set(const TomlEntry &entry)
      {
        static const std::vector<TomlEntry> none;
        if (entry.value.kind == TomlValue::Kind::table)
          return entry.value.entries;
        diagnostics.error(
          entry.value.where,
          fmt::format("'set' must be a table of keys and values, {{ \"boundary.top\" = [0, -0.01] }}, not {}", entry.value.kind_name()),
          MessageName("wrong-type"));
        return none;
      }

      bool is_parameter(const TomlEntry &entry)
      {
        std::vector<std::string> names;
        for (const Parameter &parameter : request.parameters)
          names.push_back(parameter.name);
        if (std::find(names.begin(), names.end(), entry.key) != names.end())
          return true;
        diagnostics.error(entry.where,
                          fmt::format("[parameters] has no '{}'{}; other keys of the case are set by set = {{ \"boundary.top\" = 0 }}",
                                      entry.key, suggestion(entry.key, names)),
                          MessageName("unknown-key"));
        return false;
      }

      /// The elements of a list, or of the numbers FROM:TO:N; a value for every step.
      std::optional<TomlValue> values_of(const std::string &key, const TomlValue &list)
      {
        if (list.kind == TomlValue::Kind::array && !list.elements.empty())
          return list;
        double   from = 0, to = 0;
        unsigned n = 0;
        int      end = 0;
        if (list.kind == TomlValue::Kind::string && std::sscanf(list.string.c_str(), "%lf:%lf:%u%n", &from, &to, &n, &end) == 3 &&
            std::size_t(end) == list.string.size() && n > 0 && n <= most_steps)
        {
          TomlValue values;
          values.kind = TomlValue::Kind::array;
          values.where = list.where;
          for (unsigned k = 0; k < n; ++k)
          {
            TomlValue &value = values.elements.emplace_back();
            value.kind = TomlValue::Kind::real;
            value.real = n == 1 ? from : k + 1 == n ? to : from + (to - from) * k / (n - 1);
            value.where = value.inside = list.where;
          }
          return values;
        }
        diagnostics.error(
          list.where,
          fmt::format("'{}' of [steps] must be a list with a value for each step, or \"FROM:TO:N\" with up to {} numbers", key, most_steps),
          MessageName("wrong-type"));
        return {};
      }

      void add(RawStep &step, const std::string &key, const SourceLocation &where, TomlValue value)
      {
        if (const std::string reason = why_not_in_a_step(key); !reason.empty())
        {
          diagnostics.error(where, reason, MessageName("misplaced-key"));
          return;
        }
        make_paths_absolute(value);
        step.assignments.push_back({key, where, std::move(value)});
      }

      /// The expanded case is read from another folder.
      void make_paths_absolute(TomlValue &value) const
      {
        for (TomlEntry &entry : value.entries)
          if (entry.value.kind == TomlValue::Kind::string &&
              (entry.key == "raster" || entry.key == "profile" || entry.key == "stl" || entry.key == "run"))
            entry.value.string = absolute_path(entry.value.string, folder);
          else
            make_paths_absolute(entry.value);
        for (TomlValue &element : value.elements)
          make_paths_absolute(element);
      }

      const std::string &folder;
      const Case        &request;
      Diagnostics       &diagnostics;
    };

    StepSetting setting_of(const std::string &key, const TomlValue &value)
    {
      StepSetting setting{key, to_toml(value), {}};
      if (value.kind == TomlValue::Kind::integer || value.kind == TomlValue::Kind::real)
        setting.number = value.kind == TomlValue::Kind::integer ? double(value.integer) : value.real;
      return setting;
    }

    /// Parameters and cases of the steps, one after the other.
    class History
    {
    public:
      History(
        const TomlValue &document, const std::string &folder, const StepReader &read, const std::vector<RawStep> &steps, Case &request)
        : document(document), folder(folder), read(read), request(request), state(without_steps(request))
      {
        fields.has_steps = true;
        for (const RawStep &step : steps)
          for (const Assignment &assignment : step.assignments)
            if (!assignment.key.starts_with("parameters.") && std::find(keys.begin(), keys.end(), assignment.key) == keys.end())
              keys.push_back(assignment.key);
      }

      /// A step with mistakes is left out: those after it are read as if it did not exist.
      void add(const RawStep &raw, Diagnostics &diagnostics)
      {
        auto before = std::tuple(document, state, others);
        if (!try_to_add(raw, diagnostics))
          std::tie(document, state, others) = std::move(before);
      }

    private:
      bool try_to_add(const RawStep &raw, Diagnostics &diagnostics)
      {
        LoadStep step{{}, raw.where, {}, {}, {}};
        bool     parameters_alone = true;
        for (const Assignment &assignment : raw.assignments)
        {
          const TomlValue &value = assignment.value;
          set_value(document, assignment.key, value, assignment.where, diagnostics);
          step.settings.push_back(setting_of(assignment.key, value));
          if (assignment.key.starts_with("parameters."))
            set_parameter(assignment.key.substr(assignment.key.find('.') + 1), assignment, diagnostics);
          else
            parameters_alone = false;
        }
        if (diagnostics.has_errors())
          return false;
        if (!parameters_alone)
        {
          state = read(document, diagnostics);
          others = std::make_shared<const Case>(state);
        }
        if (!diagnostics.has_errors())
          check_case(state, diagnostics);
        if (!diagnostics.has_errors())
          problem_of(state, diagnostics, fields);
        if (diagnostics.has_errors())
          return false;
        step.parameters = state.parameters;
        for (const std::string &key : keys)
          if (const TomlValue *const value = value_at(document, key))
            step.values.push_back(setting_of(key, *value));
        step.others = others;
        request.steps.push_back(std::move(step));
        return true;
      }

      void set_parameter(const std::string &name, const Assignment &assignment, Diagnostics &diagnostics)
      {
        const auto parameter =
          std::find_if(state.parameters.begin(), state.parameters.end(), [&](const Parameter &other) { return other.name == name; });
        if (parameter == state.parameters.end())
          diagnostics.error(assignment.where, fmt::format("[parameters] has no '{}'", name), MessageName("unknown-key"));
        else if (auto value = read_field(assignment.value, name, folder, diagnostics))
          parameter->value = std::move(*value);
      }

      TomlValue                   document;
      std::vector<std::string>    keys; ///< what some step sets, other than parameters
      const std::string          &folder;
      const StepReader           &read;
      Case                       &request;
      Case                        state;
      std::shared_ptr<const Case> others;
      StepFields                  fields;
    };

    /// Adds to @p all what it does not contain yet: what is wrong with a list of values is found in each step.
    void add_new_messages(const Diagnostics &found, Diagnostics &all)
    {
      for (const Diagnostic &message : found.all())
      {
        if (std::any_of(all.all().begin(), all.all().end(),
                        [&](const Diagnostic &known)
                        {
                          return known.where.line == message.where.line && known.where.column == message.where.column &&
                                 known.where.file == message.where.file && known.message == message.message;
                        }))
          continue;
        if (message.severity == Severity::error)
          all.error(message.where, message.message, message.name);
        else if (message.severity == Severity::warning)
          all.warning(message.where, message.message, message.name);
        else
          all.note(message.where, message.message, message.name);
      }
    }

    constexpr unsigned most_steps_with_mistakes = 10;

    /// The mesh is that of all steps: what chooses its parts and where it is refined must not change.
    void check_mesh(const Case &request, Diagnostics &diagnostics)
    {
      std::vector<std::string> stepped;
      for (const LoadStep &step : request.steps)
        for (const StepSetting &setting : step.settings)
          if (setting.key.starts_with("parameters."))
            stepped.push_back(setting.key.substr(setting.key.find('.') + 1));
      std::sort(stepped.begin(), stepped.end());
      stepped.erase(std::unique(stepped.begin(), stepped.end()), stepped.end());
      const auto check = [&](const FieldSpec &where)
      {
        for (const std::string &name : parameters_behind(where, request.parameters))
          if (std::binary_search(stepped.begin(), stepped.end(), name))
            diagnostics.error(where.where,
                              fmt::format("the mesh is the same in all steps, and this depends on '{}', which steps set", name),
                              MessageName("contradiction"));
      };
      for (const auto &refinement : request.mesh.local)
        check(refinement.where);
      for (const auto &part : request.mesh.parts)
        check(part.where);
    }
  } // namespace

  void read_steps(const TomlValue &document, const std::string &folder, const StepReader &read, Case &request, Diagnostics &diagnostics)
  {
    TomlValue        copy = document;
    const TomlValue *each = copy.find("step"), *lists = copy.find("steps");
    if (each && lists)
      diagnostics.error(lists->where, "[steps] and [[step]] are two ways to say the same; keep one of them", MessageName("contradiction"));
    if ((!each && !lists) || (each && lists))
      return;
    const bool                 mistakes_elsewhere = diagnostics.has_errors(); // which would be found again in every step
    StepsReader                reader(folder, request, diagnostics);
    const std::vector<RawStep> steps = each ? reader.read_each(*each) : reader.read_lists(*lists);
    if (mistakes_elsewhere)
      return;
    History  history(document, folder, read, steps, request);
    unsigned n_wrong = 0;
    for (const RawStep &step : steps)
    {
      Diagnostics found;
      history.add(step, found);
      add_new_messages(found, diagnostics);
      if (found.has_errors() && ++n_wrong == most_steps_with_mistakes)
        break;
    }
    if (!diagnostics.has_errors())
      check_mesh(request, diagnostics);
  }

  void warn_about_overrides_in_steps(const Case &request, const std::vector<Override> &overrides, Diagnostics &diagnostics)
  {
    for (const auto &[key, value] : overrides)
      for (std::size_t k = 0; k < request.steps.size(); ++k)
      {
        const auto &settings = request.steps[k].settings;
        const auto  setting =
          std::find_if(settings.begin(), settings.end(),
                       [&key = key](const StepSetting &other) { return key == other.key || key.starts_with(other.key + "."); });
        if (setting == settings.end())
          continue;
        diagnostics.warning(request.steps[k].where,
                            fmt::format("'{}={}', given beside the case, {}: step {} sets '{}'", key, value,
                                        k == 0 ? std::string("has no effect") : fmt::format("holds up to step {} only", k), k + 1,
                                        setting->key),
                            MessageName("setting-of-steps"));
        break;
      }
  }
} // namespace unilateral

#include "unilateral/case/json_schema.h"

#include "unilateral/case/case_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    using SchemaJson = nlohmann::ordered_json;

    SchemaJson any_of(const std::vector<SchemaJson> &choices)
    {
      if (choices.size() == 1)
        return choices.front();
      SchemaJson json;
      json["anyOf"] = choices;
      return json;
    }

    /// Writes the tables as definitions, one for each kind of problem where kinds differ, and refers to them.
    class SchemaWriter
    {
    public:
      SchemaJson document()
      {
        SchemaJson json = table_json(case_tables().front(), "");
        json["allOf"] = SchemaJson::array();
        for (const std::string &kind : kinds_of_problems())
        {
          SchemaJson is_kind, sections;
          is_kind["properties"]["model"] = {{"properties", {{"kind", {{"const", kind}}}}}, {"required", {"kind"}}};
          is_kind["required"] = {"model"};
          for (const KeyDescription &key : case_tables().front().keys)
            if (!holds_for(key.kinds, kind))
              sections[key.name] = false;
            else if (key.forms.front().table.empty())
              ;
            else if (depends_on_kind(case_table(key.forms.front().table)))
              sections[key.name] = forms_json(key.forms, kind);
          json["allOf"].push_back({{"if", is_kind}, {"then", {{"properties", sections}}}});
        }
        json["definitions"] = definitions;
        SchemaJson whole = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A case of Unilateral"}};
        whole.update(json);
        return whole;
      }

    private:
      static bool depends_on_kind(const TableDescription &table)
      {
        return std::any_of(table.keys.begin(), table.keys.end(), [](const KeyDescription &key) { return !key.kinds.empty(); }) ||
               std::any_of(table.rules.begin(), table.rules.end(), [](const KeyRule &rule) { return !rule.kinds.empty(); });
      }

      /// A reference to a table as @p kind has it, "" for whatever any kind has.
      SchemaJson reference(const std::string &name, const std::string &kind)
      {
        const TableDescription &table = case_table(name);
        const std::string       key = depends_on_kind(table) && !kind.empty() ? fmt::format("{} of {}", name, kind) : name;
        if (!definitions.contains(key))
        {
          definitions[key] = true; // taken, should the table contain itself
          definitions[key] = table_json(table, kind);
        }
        // Blanks are no part of a URI.
        std::string path = key;
        for (std::size_t blank = 0; (blank = path.find(' ', blank)) != std::string::npos; blank += 3)
          path.replace(blank, 1, "%20");
        return {{"$ref", "#/definitions/" + path}};
      }

      static SchemaJson number_json(const ValueForm &form)
      {
        SchemaJson json = {{"type", form.type == ValueForm::Type::whole_number ? "integer" : "number"}};
        if (form.least)
          json[form.open_below ? "exclusiveMinimum" : "minimum"] = *form.least;
        if (form.most)
          json[form.open_above && form.least ? "exclusiveMaximum" : "maximum"] = *form.most;
        return json;
      }

      static SchemaJson text_json(const ValueForm &form)
      {
        SchemaJson json = {{"type", "string"}};
        if (!form.words.empty())
          json["enum"] = form.words;
        if (!form.pattern.empty())
          json["pattern"] = form.pattern;
        if (!form.not_words.empty())
          json["not"]["enum"] = form.not_words;
        return json;
      }

      SchemaJson list_json(const ValueForm &form, const std::string &kind)
      {
        SchemaJson json = {{"type", "array"}, {"items", forms_json(form.elements, kind)}};
        if (form.lengths.empty())
          return json;
        const unsigned shortest = form.lengths.front(), longest = form.lengths.back();
        json["minItems"] = shortest;
        json["maxItems"] = longest;
        for (unsigned n = shortest; n <= longest; ++n)
          if (std::find(form.lengths.begin(), form.lengths.end(), n) == form.lengths.end())
            json["allOf"].push_back({{"not", {{"minItems", n}, {"maxItems", n}}}});
        return json;
      }

      SchemaJson form_json(const ValueForm &form, const std::string &kind)
      {
        switch (form.type)
        {
        case ValueForm::Type::number:
        case ValueForm::Type::whole_number:
          return number_json(form);
        case ValueForm::Type::text:
          return text_json(form);
        case ValueForm::Type::boolean:
          return {{"type", "boolean"}};
        case ValueForm::Type::list:
          return list_json(form, kind);
        case ValueForm::Type::table:
          return reference(form.table, kind);
        case ValueForm::Type::table_or_tables:
        {
          const SchemaJson table = reference(form.table, kind);
          return any_of({table, {{"type", "array"}, {"items", table}}});
        }
        case ValueForm::Type::anything:
          return SchemaJson::object();
        case ValueForm::Type::field:
          break;
        }
        if (!definitions.contains("field"))
        {
          definitions["field"] = true;
          definitions["field"] = any_of({{{"type", "number"}},
                                         {{"type", "string"}},
                                         reference("raster", ""),
                                         reference("profile", ""),
                                         reference("run", ""),
                                         reference("previous", "")});
        }
        return {{"$ref", "#/definitions/field"}};
      }

      SchemaJson forms_json(const std::vector<ValueForm> &forms, const std::string &kind)
      {
        std::vector<SchemaJson> choices;
        for (const ValueForm &form : forms)
          if (SchemaJson choice = form_json(form, kind); std::find(choices.begin(), choices.end(), choice) == choices.end())
            choices.push_back(choice);
        return any_of(choices);
      }

      /// One key, as all the kinds in @p meanings have it.
      SchemaJson key_json(const std::vector<const KeyDescription *> &meanings, const std::string &kind)
      {
        std::vector<ValueForm> forms;
        std::string            description;
        for (const KeyDescription *const meaning : meanings)
        {
          forms.insert(forms.end(), meaning->forms.begin(), meaning->forms.end());
          if (meanings.size() > 1)
            description += fmt::format("{}{}: ", description.empty() ? "" : "\n", fmt::join(meaning->kinds, ", "));
          description += meaning->description;
        }
        // What stands beside a reference is ignored by draft 7.
        SchemaJson json = forms_json(forms, kind);
        if (json.contains("$ref"))
          json = {{"allOf", {json}}};
        json["description"] = description;
        if (meanings.size() > 1)
          return json;
        if (SchemaJson value = SchemaJson::parse(meanings.front()->by_default, nullptr, false); !value.is_discarded())
          json["default"] = value;
        if (SchemaJson value = SchemaJson::parse(meanings.front()->example, nullptr, false); !value.is_discarded())
          json["examples"] = SchemaJson::array({value});
        return json;
      }

      static SchemaJson rule_json(const KeyRule &rule)
      {
        SchemaJson each = SchemaJson::array();
        switch (rule.type)
        {
        case KeyRule::Type::not_together:
          return {{"not", {{"required", rule.keys}}}};
        case KeyRule::Type::needs:
          return {{"dependencies", {{rule.keys[0], {rule.keys[1]}}}}};
        case KeyRule::Type::exactly_one:
        case KeyRule::Type::at_least_one:
          break;
        }
        for (const std::string &key : rule.keys)
          each.push_back({{"required", {key}}});
        return {{rule.type == KeyRule::Type::exactly_one ? "oneOf" : "anyOf", each}};
      }

      SchemaJson table_json(const TableDescription &table, const std::string &kind)
      {
        SchemaJson               json = {{"type", "object"}, {"description", table.description}, {"additionalProperties", false}};
        std::vector<std::string> names, required;
        std::vector<std::pair<std::string, std::vector<const KeyDescription *>>> keys;
        for (const KeyDescription &key : table.keys)
        {
          if (!kind.empty() && !holds_for(key.kinds, kind))
            continue;
          auto known = std::find_if(keys.begin(), keys.end(), [&](const auto &entry) { return entry.first == key.name; });
          if (known == keys.end())
            known = keys.insert(keys.end(), {key.name, {}});
          known->second.push_back(&key);
          if (key.required && (!kind.empty() || key.kinds.empty()))
            required.push_back(key.name);
        }
        for (const auto &[name, meanings] : keys)
          if (name == KeyDescription::any_name)
            json["additionalProperties"] = key_json(meanings, kind);
          else
            json["properties"][name] = key_json(meanings, kind);
        if (!required.empty())
          json["required"] = required;
        for (const KeyRule &rule : table.rules)
          if (rule.kinds.empty() || (!kind.empty() && holds_for(rule.kinds, kind)))
            json["allOf"].push_back(rule_json(rule));
        return json;
      }

      SchemaJson definitions = SchemaJson::object();
    };
  } // namespace

  nlohmann::ordered_json json_schema()
  {
    return SchemaWriter().document();
  }
} // namespace unilateral

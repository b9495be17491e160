// TOML alone, and values set from the command line: the first line is PATH=VALUE, the rest the document.
#include "fuzzed_bytes.h"

#include "unilateral/case/toml_document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  using namespace unilateral;
  const std::string text = fuzzed::text(bytes, size);
  const std::size_t end_of_line = text.find('\n'), sign = text.find('=');
  Diagnostics       diagnostics;
  try
  {
    if (end_of_line == std::string::npos || sign > end_of_line)
    {
      parse_toml(text, "fuzz.toml");
      return 0;
    }
    TomlValue document = parse_toml(text.substr(end_of_line + 1), "fuzz.toml");
    set_value(document, {text.substr(0, sign), text.substr(sign + 1, end_of_line - sign - 1)}, diagnostics);
  }
  catch (const InputError &e)
  {
    fuzzed::require(!e.diagnostics.empty());
    return 0;
  }
  // Whatever stands in quotes comes back.
  TomlValue quoted;
  try
  {
    quoted = parse_toml("a = " + toml_quoted(text), "fuzz.toml");
  }
  catch (const InputError &)
  {
    return 0; // not UTF-8
  }
  const TomlValue *value = quoted.find("a");
  fuzzed::require(value && value->string == text);
  return 0;
}

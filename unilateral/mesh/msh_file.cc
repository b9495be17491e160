#include "unilateral/mesh/msh_file.h"

#include "unilateral/base/number_of_name.h"
#include "unilateral/mesh/msh_format.h"

namespace unilateral
{
  namespace
  {
    using msh::Numbers;
    using msh::require;
    using msh::Scanner;

    msh::Format read_format(Scanner &scanner)
    {
      require(scanner.line() == "$MeshFormat");
      const std::string line(scanner.line());
      Numbers           numbers(line);
      msh::Format       format;
      format.version = numbers.next<double>();
      const int kind = numbers.next<int>();
      require((format.version == 2.2 || format.version == 4.1) && (kind == 0 || kind == 1) && numbers.next<int>() == sizeof(std::uint64_t));
      format.binary = kind == 1;
      if (format.binary)
      {
        require(scanner.binary<int>() == 1); // else the bytes of its numbers come in another order
        require(scanner.line().empty());
      }
      require(scanner.line() == "$EndMeshFormat");
      return format;
    }
  } // namespace

  std::optional<MeshOutline> outline_of_msh(const std::string &file)
  {
    try
    {
      Scanner           scanner(file);
      const msh::Format format = read_format(scanner);
      MeshOutline       outline = format.version == 2.2 ? outline_of_format_2(scanner, format) : outline_of_format_4(scanner, format);
      number_of_name("boundary", outline.part_names);
      number_of_name("domain", outline.region_names);
      return outline;
    }
    catch (const msh::NotRead &)
    {
      return std::nullopt;
    }
  }

  std::optional<MshIndex> index_of_msh(const std::string &file, const std::uint64_t most_in_piece)
  {
    try
    {
      Scanner           scanner(file);
      const msh::Format format = read_format(scanner);
      return format.version == 2.2 ? index_of_format_2(scanner, format, most_in_piece) : index_of_format_4(scanner, format, most_in_piece);
    }
    catch (const msh::NotRead &)
    {
      return std::nullopt;
    }
  }
} // namespace unilateral

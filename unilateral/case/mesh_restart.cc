#include "unilateral/case/mesh_restart.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/case/restart_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  namespace
  {
    /// The first bytes of a part: its kind with its version, and a number that another order of bytes would change.
    constexpr std::array<char, 8> mark_of_mesh = {'u', 'n', 'i', 'l', 'm', 's', 'h', '1'};
    constexpr std::uint32_t       mark_of_order = 0x01020304;

    std::string bytes_of(const FormerMesh &mesh)
    {
      ByteWriter bytes;
      bytes(mark_of_mesh);
      bytes(mark_of_order);
      bytes(mesh.centres);
      return std::string(bytes.bytes.begin(), bytes.bytes.end());
    }

    std::vector<std::array<double, 3>> read_centres(const std::string &path)
    {
      std::ifstream           file(path, std::ios::binary);
      const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      try
      {
        ByteReader                         reader(bytes);
        std::array<char, 8>                mark{};
        std::uint32_t                      order = 0;
        std::vector<std::array<double, 3>> centres;
        reader(mark);
        reader(order);
        if (mark != mark_of_mesh || order != mark_of_order)
          throw std::out_of_range("another kind of file");
        reader(centres);
        const bool finite = std::all_of(centres.begin(), centres.end(),
                                        [](const auto &x) { return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]); });
        if (!reader.at_end() || !finite)
          throw std::out_of_range("not as it was written");
        return centres;
      }
      catch (const std::out_of_range &)
      {
        throw cannot_resume(fmt::format("'{}' is missing, cut short or damaged", path));
      }
    }
  } // namespace

  void write_mesh_restart(
    const std::string &folder, const Case &request, const unsigned number, const FormerMesh &own, const Processes &processes)
  {
    const std::optional<std::string> part = bytes_of(own);
    write_restart_files(folder, number, {{"mesh", number}, {"case", hash_of_problem(request)}}, part, processes);
  }

  std::shared_ptr<const FormerMesh> read_mesh_restart(const std::string &folder, const Case &request)
  {
    const auto json = read_restart_json(folder);
    if (!json.contains("mesh"))
      throw cannot_resume(fmt::format("what was left unfinished in '{}' is a load history, or a run without adapt in [mesh]", folder));
    if (json.value("case", nlohmann::ordered_json()) != hash_of_problem(request))
      throw cannot_resume(fmt::format("the mesh that was left unfinished in '{}' is that of another case", folder));
    const auto mesh = std::make_shared<FormerMesh>();
    for (const std::string &path : restart_parts(folder, json))
    {
      const auto part = read_centres(path);
      mesh->centres.insert(mesh->centres.end(), part.begin(), part.end());
    }
    if (mesh->centres.empty())
      throw damaged_restart(folder);
    return mesh;
  }

  bool has_restart_of_steps(const std::string &folder)
  {
    if (!std::filesystem::exists(std::filesystem::path(folder) / "restart.json"))
      return false;
    try
    {
      return read_restart_json(folder).contains("steps");
    }
    catch (const InputError &)
    {
      return false; // nobody can resume it
    }
  }
} // namespace unilateral

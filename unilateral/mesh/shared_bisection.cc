#include "unilateral/mesh/shared_bisection.h"

#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

#include <zoltan.h>

namespace unilateral
{
  using dealii::Point;

  namespace
  {
    template <int dim>
    const std::vector<Point<dim>> &points_of(void *const data)
    {
      return *static_cast<const std::vector<Point<dim>> *>(data);
    }

    template <int dim>
    int count(void *const data, int *const error)
    {
      *error = ZOLTAN_OK;
      return points_of<dim>(data).size();
    }

    /// Objects by their local numbers alone.
    template <int dim>
    void list(void *const data, int, int, const ZOLTAN_ID_PTR global, const ZOLTAN_ID_PTR local, int, float *, int *const error)
    {
      std::iota(global, global + points_of<dim>(data).size(), 0u);
      std::iota(local, local + points_of<dim>(data).size(), 0u);
      *error = ZOLTAN_OK;
    }

    template <int dim>
    int count_coordinates(void *, int *const error)
    {
      *error = ZOLTAN_OK;
      return dim;
    }

    template <int dim>
    void
    coordinates(void *const data, int, int, const int n, ZOLTAN_ID_PTR, const ZOLTAN_ID_PTR local, int, double *const x, int *const error)
    {
      for (int k = 0; k < n; ++k)
        for (unsigned d = 0; d < dim; ++d)
          x[k * dim + d] = points_of<dim>(data)[local[k]][d];
      *error = ZOLTAN_OK;
    }
  } // namespace

  template <int dim>
  std::vector<unsigned> bisect_shared(const std::vector<Point<dim>> &points, const Processes &processes)
  {
    std::vector<unsigned> part(points.size(), 0);
    if (processes.alone())
      return part;
    float version = 0;
    Zoltan_Initialize(0, nullptr, &version);
    const auto                                              destroy = [](Zoltan_Struct *zoltan) { Zoltan_Destroy(&zoltan); };
    const std::unique_ptr<Zoltan_Struct, decltype(destroy)> zoltan(Zoltan_Create(processes.communicator()), destroy);
    const auto set = [&](const char *const name, const std::string &value) { Zoltan_Set_Param(zoltan.get(), name, value.c_str()); };
    set("DEBUG_LEVEL", "0"); // before others, which it would print
    set("LB_METHOD", "RCB");
    set("NUM_GLOBAL_PARTS", std::to_string(processes.size()));
    set("NUM_GID_ENTRIES", "1");
    set("NUM_LID_ENTRIES", "1");
    set("RETURN_LISTS", "PARTS"); // of all points, in their order
    set("IMBALANCE_TOL", "1.01");
    void *const data = const_cast<std::vector<Point<dim>> *>(&points);
    Zoltan_Set_Num_Obj_Fn(zoltan.get(), count<dim>, data);
    Zoltan_Set_Obj_List_Fn(zoltan.get(), list<dim>, data);
    Zoltan_Set_Num_Geom_Fn(zoltan.get(), count_coordinates<dim>, data);
    Zoltan_Set_Geom_Multi_Fn(zoltan.get(), coordinates<dim>, data);
    int           changes = 0, n_global_entries = 0, n_local_entries = 0, n_import = 0, n_export = 0;
    ZOLTAN_ID_PTR import_global = nullptr, import_local = nullptr, export_global = nullptr, export_local = nullptr;
    int          *import_process = nullptr, *import_part = nullptr, *export_process = nullptr, *export_part = nullptr;
    const int     result =
      Zoltan_LB_Partition(zoltan.get(), &changes, &n_global_entries, &n_local_entries, &n_import, &import_global, &import_local,
                          &import_process, &import_part, &n_export, &export_global, &export_local, &export_process, &export_part);
    const bool failed = result == ZOLTAN_FATAL || result == ZOLTAN_MEMERR || n_export != int(points.size());
    for (int k = 0; k < n_export && !failed; ++k)
      part[export_local[k]] = export_part[k];
    Zoltan_LB_Free_Part(&import_global, &import_local, &import_process, &import_part);
    Zoltan_LB_Free_Part(&export_global, &export_local, &export_process, &export_part);
    if (processes.any(failed))
      throw std::runtime_error("Zoltan does not divide the mesh");
    return part;
  }

  template std::vector<unsigned> bisect_shared(const std::vector<Point<2>> &, const Processes &);
  template std::vector<unsigned> bisect_shared(const std::vector<Point<3>> &, const Processes &);
} // namespace unilateral

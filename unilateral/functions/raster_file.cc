#include "unilateral/functions/raster_file.h"

#include <fmt/format.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// The formats that are read: each is a file that holds its own pixels. GDAL knows a hundred more, among them some that name other
    /// files or addresses in the network to take pixels from (VRT, WMS, WCS, ...), and plugins; those are not even registered.
    constexpr std::pair<const char *, void (*)()> drivers[] = {
      {"GTiff", GDALRegister_GTiff},     {"AAIGrid", GDALRegister_AAIGrid}, {"PNG", GDALRegister_PNG},   {"DTED", GDALRegister_DTED},
      {"EHdr", GDALRegister_EHdr},       {"GSAG", GDALRegister_GSAG},       {"GSBG", GDALRegister_GSBG}, {"GS7BG", GDALRegister_GS7BG},
      {"SRTMHGT", GDALRegister_SRTMHGT}, {"USGSDEM", GDALRegister_USGSDEM}, {"XYZ", GDALRegister_XYZ}};

    void register_formats()
    {
      CPLSetConfigOption("GDAL_DRIVER_PATH", "disable"); // no plugins
      CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");      // no .aux.xml
      for (const auto &[name, register_it] : drivers)
        register_it();
    }

    /// For GDALOpenEx: others may have registered more.
    const char *const *driver_names()
    {
      static const auto names = []
      {
        std::vector<const char *> list;
        for (const auto &[name, register_it] : drivers)
          list.push_back(name);
        list.push_back(nullptr);
        return list;
      }();
      return names.data();
    }

    constexpr const char *formats = "GeoTIFF, ESRI ASCII grid and EHdr, PNG, DTED, SRTM, USGS DEM, Surfer grids, XYZ";

    /// GDAL writes to standard error unless told not to.
    class QuietGdal
    {
    public:
      QuietGdal()
      {
        static std::once_flag registered;
        std::call_once(registered, register_formats);
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
      }
      ~QuietGdal() { CPLPopErrorHandler(); }
      QuietGdal(const QuietGdal &) = delete;
      QuietGdal &operator=(const QuietGdal &) = delete;

      /// Some of GDAL's end with a new line.
      std::string last_message() const
      {
        const std::string message = CPLGetLastErrorMsg();
        return message.substr(0, message.find_last_not_of(" \n.") + 1);
      }
    };

    /// The files beside @p file that GDAL may open for it, as a list for GDALOpenEx: where it lies and how it is laid out. Not those that
    /// replace its pixels or name other files.
    class Companions
    {
    public:
      explicit Companions(const std::filesystem::path &file)
      {
        list = CSLAddString(list, file.filename().c_str());
        std::string ending = file.extension().string();
        // World files end like the raster with its middle letters left out and a w: .tfw for .tif.
        std::vector<std::string> endings = {".hdr", ".prj", ".wld", ending + "w"};
        if (ending.size() > 2)
          endings.push_back({'.', ending[1], ending.back(), 'w'});
        std::error_code failure;
        for (const std::string &known : endings)
          for (const bool capital : {false, true})
          {
            std::string name = known;
            if (capital)
              std::transform(name.begin(), name.end(), name.begin(), [](const unsigned char c) { return std::toupper(c); });
            const std::filesystem::path companion = std::filesystem::path(file).replace_extension(name);
            if (companion != file && std::filesystem::is_regular_file(companion, failure))
              list = CSLAddString(list, companion.filename().c_str());
          }
      }
      ~Companions() { CSLDestroy(list); }
      Companions(const Companions &) = delete;
      Companions &operator=(const Companions &) = delete;

      const char *const *names() const { return list; }

    private:
      char **list = nullptr;
    };

    struct CloseDataset
    {
      void operator()(void *dataset) const { GDALClose(dataset); }
    };

    /// Throws where a list of points, @p n_bytes of text, has far too few for the pixels: GDAL makes a grid of any points, with gaps where
    /// there are none, and of a few points on no grid one of a hundred million pixels.
    void check_points(const std::size_t n_columns, const std::size_t n_rows, const std::size_t n_bytes, const std::string &name)
    {
      constexpr std::size_t bytes_per_point = 6; // at least: "0 0 1" and the end of the line
      const std::size_t     n_points = n_bytes / bytes_per_point + 1;
      if (n_columns * n_rows > 100 * n_points)
        throw std::runtime_error(
          fmt::format("the points of raster '{}', {} at most, do not lie on a grid: the spacings between the first of "
                      "them make it one of {} x {} pixels; gdal_grid makes a grid of scattered points",
                      name, n_points, n_columns, n_rows));
    }
  } // namespace

  RasterPixels read_raster_file(const std::string &file, const bool placed_by_file)
  {
    const std::string                         name = std::filesystem::path(file).filename().string();
    const QuietGdal                           quiet;
    const Companions                          companions(file);
    const std::unique_ptr<void, CloseDataset> dataset(
      GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, driver_names(), nullptr, companions.names()));
    if (!dataset)
      throw std::runtime_error(fmt::format("'{}' is not a raster of a format that is read here ({}): {}; gdal_translate makes a GeoTIFF of "
                                           "it if GDAL knows it",
                                           name, formats, quiet.last_message()));
    if (GDALGetRasterCount(dataset.get()) == 0)
      throw std::runtime_error(fmt::format("raster '{}' has no band", name));
    const int columns = GDALGetRasterXSize(dataset.get()), rows = GDALGetRasterYSize(dataset.get());
    if (columns < 1 || rows < 1 || static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) > max_raster_pixels)
      throw std::runtime_error(
        fmt::format("raster '{}' of {} x {} pixels is too large; at most {} pixels are read", name, columns, rows, max_raster_pixels));
    RasterPixels pixels;
    auto &[n_columns, n_rows, samples, transform] = pixels;
    n_columns = static_cast<std::size_t>(columns);
    n_rows = static_cast<std::size_t>(rows);
    if (GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get())) == std::string("XYZ") &&
        std::filesystem::path(file).extension() != ".gz")
      check_points(n_columns, n_rows, std::filesystem::file_size(file), name);

    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    // GDAL reads whole blocks, of all bands where they are interleaved, whatever the file holds of them.
    int block_columns = 0, block_rows = 0;
    GDALGetBlockSize(band, &block_columns, &block_rows);
    const double block_size =
      double(block_columns) * block_rows * GDALGetRasterCount(dataset.get()) * GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band));
    if (block_size > double(max_raster_pixels) * sizeof(double))
      throw std::runtime_error(
        fmt::format("raster '{}' has blocks of {} x {} pixels with {} bands, which are too large to be read; gdal_translate "
                    "-b 1 makes a raster of its first band",
                    name, block_columns, block_rows, GDALGetRasterCount(dataset.get())));
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)))
      throw std::runtime_error(fmt::format("raster '{}' holds complex numbers", name));
    if (GDALGetRasterColorTable(band) != nullptr)
      throw std::runtime_error(fmt::format("raster '{}' holds colour indices, not numbers", name));
    // Strip by strip: a header can promise more than its file holds, and memory is taken for what has been read.
    const int strip = std::max(1, (1 << 20) / columns);
    samples.reserve(n_columns * n_rows);
    for (int row = 0; row < rows; row += strip)
    {
      const int n = std::min(strip, rows - row);
      samples.resize(n_columns * static_cast<std::size_t>(row + n));
      if (GDALRasterIO(band, GF_Read, 0, row, columns, n, samples.data() + n_columns * static_cast<std::size_t>(row), columns, n,
                       GDT_Float64, 0, 0) != CE_None)
        throw std::runtime_error(
          fmt::format("raster '{}' cannot be read: {}; the file may be cut short or damaged", name, quiet.last_message()));
    }

    // One mask stands for every way to have no data: a no-data value, a mask band, an alpha channel.
    if (!(GDALGetMaskFlags(band) & GMF_ALL_VALID))
    {
      std::vector<std::uint8_t> mask(samples.size());
      if (GDALRasterIO(GDALGetMaskBand(band), GF_Read, 0, 0, columns, rows, mask.data(), columns, rows, GDT_Byte, 0, 0) != CE_None)
        throw std::runtime_error(
          fmt::format("the mask of raster '{}' cannot be read: {}; the file may be cut short or damaged", name, quiet.last_message()));
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (mask[i] == 0)
          samples[i] = std::numeric_limits<double>::quiet_NaN();
    }
    if (placed_by_file && GDALGetGeoTransform(dataset.get(), transform.data()) != CE_None)
      throw std::runtime_error(fmt::format("raster '{}' does not say where it lies; give extent = [[x0, y0], [x1, y1]]", name));
    return pixels;
  }
} // namespace unilateral

#!/usr/bin/env python3
"""Makes terrain.tif from jacksboro_fault_dem.npz (see README.md). Needs numpy and GDAL for Python; not part of build or tests.

    ./make_terrain.py jacksboro_fault_dem.npz terrain.tif
"""
import math
import sys

import numpy
from osgeo import gdal

# 256 x 256 samples around the fault; the file's first row is the northern one.
FIRST_ROW, FIRST_COLUMN, SIZE = 44, 80, 256

source = numpy.load(sys.argv[1])
elevation = source["elevation"][FIRST_ROW : FIRST_ROW + SIZE, FIRST_COLUMN : FIRST_COLUMN + SIZE].astype(numpy.int16)

# Degrees to metres on the WGS 84 ellipsoid at the middle of the crop: a local plane, x east and y north of its south-west corner.
north = max(float(source["ymin"]), float(source["ymax"]))
latitude = math.radians(north - (FIRST_ROW + SIZE / 2) * float(source["dy"]))
a, e2 = 6378137.0, 0.00669437999014
s2 = 1 - e2 * math.sin(latitude) ** 2
dx = math.radians(float(source["dx"])) * a / math.sqrt(s2) * math.cos(latitude)
dy = math.radians(float(source["dy"])) * a * (1 - e2) / s2**1.5
dx, dy = round(dx, 3), round(dy, 3)

raster = gdal.GetDriverByName("GTiff").Create(
    sys.argv[2], SIZE, SIZE, 1, gdal.GDT_Int16, ["COMPRESS=DEFLATE", "PREDICTOR=2", "ZLEVEL=9"]
)
raster.SetGeoTransform((0, dx, 0, round(SIZE * dy, 3), 0, -dy))
raster.GetRasterBand(1).WriteArray(elevation)
raster.GetRasterBand(1).SetUnitType("m")
raster.FlushCache()
print(f"{SIZE} x {SIZE} samples, {dx} m x {dy} m, {SIZE * dx / 1000:.2f} km x {SIZE * dy / 1000:.2f} km, elevation {elevation.min()} to {elevation.max()} m")

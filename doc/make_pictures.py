#!/usr/bin/python3
"""Runs examples and renders the pictures of README.md into doc/pictures.

    doc/make_pictures.py [--program build/unilateral] [--work FOLDER] [NAME ...]

Needs Python with VTK and NumPy and, on a machine without a display, a virtual one:
    apt-get install --no-install-recommends python3-vtk9 python3-numpy xvfb xauth libgl1-mesa-dri
The program itself needs none of these. FOLDER keeps the results of the runs; by default they are thrown away.
"""
import argparse
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH = 900
INK = (0.15, 0.15, 0.15)
CONTACT = (0.80, 0.15, 0.10)


# Data

def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def surface(grid):
    """The cells of a plane mesh, or the skin of a solid one, as polygons."""
    skin = vtk.vtkGeometryFilter()
    skin.SetInputData(grid)
    skin.Update()
    return skin.GetOutput()


def raised(polygons, heights, factor=1.0):
    """The polygons with z = factor * heights and normals for smooth shading."""
    lifted = vtk.vtkPolyData()
    lifted.DeepCopy(polygons)
    points = vtk_to_numpy(polygons.GetPoints().GetData()).astype(float).copy()
    points[:, 2] = factor * heights
    lifted.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(lifted)
    normals.SplittingOff()
    normals.ConsistencyOn()
    normals.AutoOrientNormalsOff()
    normals.Update()
    return normals.GetOutput()


# Things in the picture

def colours(low, high, stops):
    """A table from value to colour; `stops` are (share, (r, g, b))."""
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToLab()
    for share, rgb in stops:
        function.AddRGBPoint(low + share * (high - low), *rgb)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetRange(low, high)
    for i in range(256):
        table.SetTableValue(i, *function.GetColor(low + (high - low) * i / 255), 1.0)
    table.Build()
    return table


def paint(polygons, name, table, otherwise=None):
    """Gives each point its colour; where the value is not positive the colour `otherwise`, if there is one."""
    rgb = vtk_to_numpy(table.MapScalars(polygons.GetPointData().GetArray(name), vtk.VTK_COLOR_MODE_MAP_SCALARS, -1))[:, :3].copy()
    if otherwise is not None:
        rgb[array(polygons, name) <= 0] = [round(255 * c) for c in otherwise]
    colour = numpy_to_vtk(rgb, deep=True, array_type=vtk.VTK_UNSIGNED_CHAR)
    colour.SetName("colour")
    polygons.GetPointData().AddArray(colour)
    return polygons


PRESSURE = [(0.0, (0.99, 0.85, 0.55)), (0.35, (0.97, 0.60, 0.25)), (0.7, (0.80, 0.25, 0.15)), (1.0, (0.45, 0.05, 0.10))]
NO_CONTACT = (0.62, 0.74, 0.86)
HEIGHT = [(0.0, (0.16, 0.25, 0.48)), (0.5, (0.45, 0.65, 0.75)), (1.0, (0.93, 0.95, 0.90))]
EARTH = [(0.0, (0.36, 0.49, 0.32)), (0.35, (0.63, 0.68, 0.45)), (0.7, (0.72, 0.60, 0.45)), (1.0, (0.95, 0.93, 0.90))]


def actor(data, colour=(0.8, 0.8, 0.8), opacity=1.0):
    """Painted polygons in their colours, others in the one given."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    if data.GetPointData().GetArray("colour"):
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("colour")
        mapper.SetColorModeToDirectScalars()
    else:
        mapper.ScalarVisibilityOff()
    thing = vtk.vtkActor()
    thing.SetMapper(mapper)
    thing.GetProperty().SetColor(*colour)
    thing.GetProperty().SetOpacity(opacity)
    thing.GetProperty().SetAmbient(0.40)
    thing.GetProperty().SetDiffuse(0.65)
    thing.GetProperty().SetSpecular(0.05)
    return thing


def lines(data, colour=INK, width=2.0):
    data.GetPointData().Initialize()
    thing = actor(data, colour=colour)
    # In front of the surface they lie on.
    thing.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
    thing.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(0, -8)
    thing.GetProperty().SetLineWidth(width)
    thing.GetProperty().SetLighting(False)
    return thing


def rim(polygons):
    """The boundary of a surface."""
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(polygons)
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    edges.BoundaryEdgesOn()
    edges.ColoringOff()
    edges.Update()
    return edges.GetOutput()


def level_line(polygons, name, value):
    polygons.GetPointData().SetActiveScalars(name)
    contour = vtk.vtkContourFilter()
    contour.SetInputData(polygons)
    contour.SetValue(0, value)
    contour.Update()
    return contour.GetOutput()


def mesh_lines(polygons, n=24):
    """Every few lines of constant x and y on a surface: they show its shape."""
    append = vtk.vtkAppendPolyData()
    low_x, high_x, low_y, high_y = polygons.GetBounds()[:4]
    for axis, (low, high) in enumerate([(low_x, high_x), (low_y, high_y)]):
        for i in range(1, n):
            plane = vtk.vtkPlane()
            # Not quite on a line of the mesh, where a cut would be empty or double.
            plane.SetOrigin(*[(low + (high - low) * (i / n + 1e-5)) if d == axis else 0 for d in range(3)])
            plane.SetNormal(*[1 if d == axis else 0 for d in range(3)])
            cutter = vtk.vtkCutter()
            cutter.SetCutFunction(plane)
            cutter.SetInputData(polygons)
            cutter.Update()
            append.AddInputData(cutter.GetOutput())
    append.Update()
    return append.GetOutput()


def text(words, size=20, x=0.02, y=0.93):
    label = vtk.vtkTextActor()
    label.SetInput(words)
    style = label.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(*INK)
    label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    label.SetPosition(x, y)
    return label


def colour_bar(table, title, form="%.1f", n_labels=5, x=0.86, y=0.16, height=0.66):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(n_labels)
    bar.SetLabelFormat(form)
    bar.SetUnconstrainedFontSize(True)
    bar.SetVerticalTitleSeparation(10)
    bar.SetBarRatio(0.22)
    for style, size in ((bar.GetTitleTextProperty(), 18), (bar.GetLabelTextProperty(), 17)):
        style.SetFontFamilyToArial()
        style.SetFontSize(size)
        style.SetColor(*INK)
        style.BoldOff()
        style.ItalicOff()
        style.ShadowOff()
    bar.SetPosition(x, y)
    bar.SetWidth(0.115)
    bar.SetHeight(height)
    return bar


def render(path, things, labels=(), height=560, azimuth=-35.0, elevation=30.0, zoom=1.0, shift=(0.0, 0.0), flat=False):
    """`shift` moves the picture by shares of the window, to make room for the colour bar."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for thing in things:
        renderer.AddActor(thing)
    for label in labels:
        renderer.AddActor2D(label)

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(WIDTH, height)
    window.AddRenderer(renderer)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(20)
    renderer.SetOcclusionRatio(0.0)
    renderer.SetUseFXAA(True)

    camera = renderer.GetActiveCamera()
    if flat:
        camera.ParallelProjectionOn()
        camera.SetPosition(0, 0, 1)
        camera.SetViewUp(0, 1, 0)
    else:
        camera.SetViewAngle(22)
        camera.SetPosition(0, -1, 0)
        camera.SetViewUp(0, 0, 1)
    camera.SetFocalPoint(0, 0, 0)
    if not flat:
        camera.Azimuth(azimuth)
        camera.Elevation(elevation)
    renderer.ResetCamera()
    camera.Zoom(zoom)
    camera.SetWindowCenter(*shift)
    renderer.ResetCameraClippingRange()
    window.Render()

    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    write_png(path, grab.GetOutput())
    print(f"{path.relative_to(ROOT) if path.is_relative_to(ROOT) else path}  {path.stat().st_size / 1000:.0f} kB")


def write_png(path, image):
    """With a palette of 256 colours: a third of the bytes."""
    quantize = vtk.vtkImageQuantizeRGBToIndex()
    quantize.SetInputData(image)
    quantize.SetNumberOfColors(256)
    quantize.Update()
    width, height = image.GetDimensions()[:2]
    pixels = vtk_to_numpy(quantize.GetOutput().GetPointData().GetScalars()).astype(numpy.uint8).reshape(height, width)[::-1]
    table = quantize.GetLookupTable()
    palette = bytes(round(255 * c) for i in range(256) for c in table.GetTableValue(i)[:3])
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
                     chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


# The pictures

def membrane_over_ball(results, picture):
    polygons = surface(read(results / "solution.vtu"))
    membrane = raised(polygons, array(polygons, "u"))
    table = colours(0, 4, PRESSURE)
    paint(membrane, "contact_pressure", table, NO_CONTACT)

    ball = vtk.vtkSphereSource()
    ball.SetRadius(1)
    ball.SetThetaResolution(120)
    ball.SetPhiResolution(120)
    ball.Update()
    obstacle = actor(ball.GetOutput(), colour=(0.50, 0.52, 0.56))
    obstacle.SetScale(0.985)  # so that the two surfaces do not fight for the same pixels where they touch

    # The front quarter of the membrane is cut away: below it one sees the ball.
    quarter = vtk.vtkBox()
    quarter.SetBounds(0, 3, -3, 0, -9, 9)
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(membrane)
    clip.SetClipFunction(quarter)
    clip.Update()
    kept = clip.GetOutput()
    render(picture,
           [actor(kept), lines(mesh_lines(kept, 16), colour=(0.40, 0.48, 0.58), width=1.0), lines(rim(kept), width=2.5), obstacle],
           [colour_bar(table, "contact\npressure", "%.0f")],
           azimuth=30, elevation=34, zoom=1.60, shift=(0.12, 0.0), height=470)


def membrane_over_terrain(results, picture):
    factor = 5.0
    polygons = surface(read(results / "solution.vtu"))
    ground = raised(polygons, array(polygons, "lower"), factor)
    membrane = raised(polygons, array(polygons, "u"), factor)
    table = colours(200, 1100, EARTH)
    paint(ground, "lower", table)

    # A dot at each point in contact.
    points = read(results / "constraint-points.vtu")
    touching = array(points, "active") > 0
    places = vtk_to_numpy(points.GetPoints().GetData())[touching].astype(float).copy()
    height = {tuple(numpy.round(p[:2], 2)): z
              for p, z in zip(vtk_to_numpy(polygons.GetPoints().GetData()).astype(float), array(polygons, "u"))}
    places[:, 2] = [factor * height[tuple(numpy.round(p[:2], 2))] + 40 for p in places]
    cloud = vtk.vtkPolyData()
    positions = vtk.vtkPoints()
    positions.SetData(numpy_to_vtk(places, deep=True))
    cloud.SetPoints(positions)
    dot = vtk.vtkSphereSource()
    dot.SetRadius(95)
    dots = vtk.vtkGlyph3D()
    dots.SetInputData(cloud)
    dots.SetSourceConnection(dot.GetOutputPort())
    dots.ScalingOff()
    dots.Update()

    render(picture,
           [actor(ground), actor(membrane, colour=(0.45, 0.62, 0.85), opacity=0.32), lines(rim(membrane), width=2.0),
            lines(rim(ground), colour=(0.4, 0.4, 0.35), width=1.2),
            lines(mesh_lines(membrane, 12), colour=(0.30, 0.42, 0.62), width=1.0), actor(dots.GetOutput(), colour=CONTACT)],
           [colour_bar(table, "ground\nin metres", "%.0f", n_labels=4), text("red: contact. Heights enlarged five times.", 17, 0.02, 0.02)],
           azimuth=30, elevation=36, zoom=1.27, shift=(0.12, -0.05))


def plate_with_hole(results, picture):
    polygons = surface(read(results / "solution.vtu"))
    flat = raised(polygons, 0 * array(polygons, "u"))
    table = colours(-0.18, 0, HEIGHT)
    paint(flat, "u", table)
    contact = level_line(flat, "contact_pressure", 1e-9)
    flat.GetPointData().SetActiveScalars("u")
    isolines = vtk.vtkContourFilter()
    isolines.SetInputData(flat)
    isolines.GenerateValues(19, -0.18, 0)
    isolines.Update()
    render(picture,
           [actor(flat), lines(isolines.GetOutput(), colour=(0.25, 0.35, 0.5), width=1.0),
            lines(contact, colour=CONTACT, width=3.0), lines(rim(flat), width=2.0)],
           [colour_bar(table, "height u", "%.2f", n_labels=4, y=0.14, height=0.72),
            text("red: edge of the contact zone; its straight part is where the harder material begins.", 16, 0.02, 0.03)],
           flat=True, zoom=1.62, shift=(0.14, -0.05), height=400)


def disc_under_ceiling(results, picture):
    polygons = surface(read(results / "solution.vtu"))
    factor = 4.0
    membrane = raised(polygons, array(polygons, "u"), factor)
    table = colours(0, 1.25, PRESSURE)
    paint(membrane, "contact_pressure", table, NO_CONTACT)
    level = factor * array(polygons, "upper").max()
    plate = vtk.vtkPlaneSource()
    plate.SetOrigin(-1.1, -1.1, level + 0.012)
    plate.SetPoint1(1.1, -1.1, level + 0.012)
    plate.SetPoint2(-1.1, 1.1, level + 0.012)
    plate.Update()
    frame = rim(plate.GetOutput())
    render(picture,
           [actor(membrane), lines(mesh_lines(membrane, 12), colour=(0.40, 0.48, 0.58), width=1.0), lines(rim(membrane), width=2.0),
            actor(plate.GetOutput(), colour=(0.7, 0.72, 0.76), opacity=0.22), lines(frame, colour=(0.45, 0.45, 0.5), width=1.5)],
           [colour_bar(table, "contact\npressure", "%.2f", n_labels=6, y=0.12, height=0.74),
            text("Heights enlarged four times.", 17, 0.02, 0.03)],
           azimuth=25, elevation=22, zoom=1.5, shift=(0.12, 0.0), height=460)


PICTURES = {
    "membrane-over-ball": membrane_over_ball,
    "membrane-over-terrain": membrane_over_terrain,
    "plate-with-hole": plate_with_hole,
    "disc-under-ceiling": disc_under_ceiling,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="of " + ", ".join(PICTURES) + "; all when none is given")
    parser.add_argument("--program", default=str(ROOT / "build" / "unilateral"))
    parser.add_argument("--work", help="keep the results of the runs here")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in PICTURES:
            parser.error(f"no picture '{name}'; known: {', '.join(PICTURES)}")

    if "DISPLAY" not in os.environ:
        if not shutil.which("xvfb-run"):
            sys.exit("No display, and no xvfb-run to make one: apt-get install xvfb xauth")
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable] + sys.argv)

    pictures = ROOT / "doc" / "pictures"
    pictures.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(arguments.work or scratch)
        for name in arguments.names or PICTURES:
            results = work / name
            subprocess.run([arguments.program, "run", "-q", ROOT / "examples" / f"{name}.toml", "-o", results], check=True)
            PICTURES[name](results, pictures / f"{name}.png")


if __name__ == "__main__":
    main()

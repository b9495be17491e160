"""Builds the wheel of the Python module (PEP 517): what `pip install .` calls.

The module is part of the CMake build, with the library inside it. A backend from the package index would configure and compile all of that once
more in a folder of its own, and needs a network; here the build folder of the checkout serves, and the wheel is a matter of seconds when it is
there. Only for Pythons with another binary interface than the system's the module is built by itself.
"""

import base64
import hashlib
import os
import subprocess
import sys
import sysconfig
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")


def _project():
    with open(ROOT / "pyproject.toml", "rb") as file:
        return tomllib.load(file)["project"]


def _metadata():
    project = _project()
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {project['version']}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        *(f"Requires-Dist: {name}" for name in project["dependencies"]),
        "Description-Content-Type: text/markdown",
        "",
        (ROOT / project["readme"]).read_text(encoding="utf-8"),
    ]
    return "\n".join(lines)


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _run(*command):
    result = subprocess.run([str(word) for word in command], cwd=ROOT, stdout=sys.stderr)
    if result.returncode != 0:
        raise SystemExit(f"unilateral: '{' '.join(str(word) for word in command)}' failed; its output is above")


def _module():
    """The compiled module for the Python that runs this."""
    _run("./setup")
    module = ROOT / "build" / f"unilateral{SUFFIX}"
    if not module.exists():
        folder = ROOT / "build" / f"python-{sys.implementation.cache_tag}"
        _run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DUNILATERAL_TESTS=OFF",
             f"-DPython_EXECUTABLE={sys.executable}")
        _run("ninja", "-C", folder, "unilateral_python")
        module = folder / f"unilateral{SUFFIX}"
    if not module.exists():
        raise SystemExit(f"unilateral: the build has made no '{module.name}'; is pybind11 there?")
    return module


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = _project()
    stem = f"{project['name']}-{project['version']}"
    name = f"{stem}-{_tag()}.whl"
    module = _module()
    wheel = f"Wheel-Version: 1.0\nGenerator: {stem}\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    files = {
        module.name: module.read_bytes(),
        "unilateral.pyi": (ROOT / "python" / "unilateral.pyi").read_bytes(),
        f"{stem}.dist-info/METADATA": _metadata().encode(),
        f"{stem}.dist-info/WHEEL": wheel.encode(),
        f"{stem}.dist-info/licenses/LICENSE": (ROOT / "LICENSE").read_bytes(),
    }
    record = ""
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(content)}\n"
        archive.writestr(f"{stem}.dist-info/RECORD", record + f"{stem}.dist-info/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("unilateral: there is no source distribution; install from a checkout, pip install .")

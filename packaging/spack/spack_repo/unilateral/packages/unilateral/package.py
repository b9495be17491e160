import os

try:  # Spack 1.0 and later; before it spack.package has the class
    from spack_repo.builtin.build_systems.cmake import CMakePackage, generator
except ImportError:
    pass

from spack.package import *

# The checkout that this file belongs to.
SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 6))


class Unilateral(CMakePackage):
    """Solves variational inequalities with unilateral constraints by finite
    elements: obstacle problems of membranes, beams and plates, and elastic
    bodies in frictionless contact with rigid obstacles, with a guaranteed
    bound of the error."""

    homepage = "file://" + SOURCE
    git = "file://" + SOURCE

    license("MIT")

    version("main", branch="main")  # what is committed

    variant("python", default=True, description="Build the Python module")

    generator("ninja")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("binutils+gold", type="build")  # it is linked by ld.gold

    # Compiled and tested with 9.4; of its parts: METIS divides meshes, ARPACK computes inf-sup constants, Trilinos has
    # the algebraic multigrid method, UMFPACK and LAPACK come with it anyway.
    depends_on("dealii@9.4+mpi+metis+trilinos+arpack~int64")
    depends_on("openmpi@4:", type=("build", "link", "run"))  # `run -n` starts its mpirun
    depends_on("gmsh@4.8:+shared")
    depends_on("gdal@3.6:")
    depends_on("suite-sparse@5.12:")
    depends_on("mumps@5.5:+mpi+double")
    depends_on("openssl@3:")
    depends_on("libpng@1.6:")
    depends_on("fmt@9:")
    depends_on("boost")
    depends_on("cgal@5.5:5", type="build")
    depends_on("cli11@2.1:", type="build")
    depends_on("eigen@3.4")
    depends_on("nlohmann-json@3.11:")
    depends_on("tomlplusplus@3.3:", type="build")
    depends_on("librsvg", type="run")  # rsvg-convert makes PNG pictures

    with when("+python"):
        depends_on("python@3.9:", type=("build", "link", "run"))
        depends_on("py-pybind11@2.10:", type="build")
        depends_on("py-numpy", type=("build", "run"))

    conflicts("%gcc@:11", msg="C++20 as GCC 12 and Clang 14 know it")
    conflicts("%clang@:13", msg="C++20 as GCC 12 and Clang 14 know it")

    def cmake_args(self):
        args = [
            self.define("UNILATERAL_TESTS", False),
            self.define("UNILATERAL_NATIVE", False),  # Spack's target says for which processor
            self.define_from_variant("UNILATERAL_PYTHON", "python"),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("Python_EXECUTABLE", self.spec["python"].command.path))
        return args

    def setup_run_environment(self, env):
        if self.spec.satisfies("+python"):
            env.prepend_path("PYTHONPATH", join_path(self.prefix.lib, "python3", "dist-packages"))
        # The recipe of GDAL adds an empty path where it is an external, and that is the folder in which one is.
        env.remove_path("LD_LIBRARY_PATH", ".")

    def test_membrane_over_ball(self):
        """solve an example whose numbers are known, alone and by two processes"""
        case = join_path(self.prefix.share, "doc", "unilateral", "examples", "membrane-over-ball.toml")
        unilateral = which(join_path(self.prefix.bin, "unilateral"))
        unilateral("run", case, "-o", "alone")
        unilateral("run", "-n", "2", case, "-o", "shared")

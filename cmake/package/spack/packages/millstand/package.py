# Recipe for Spack.  Not tested: no Spack has run it.  `python3 -m py_compile` is all that the tree checks.
# The sources are those of a folder: spack develop --path FOLDER millstand@0.1.0
from spack.package import *


class Millstand(CMakePackage):
    """From the drawing of a rolling-mill stand to the vibration of its rolls."""

    license("GPL-3.0-or-later")
    version("0.1.0")

    variant("native", default=False, description="Tune for the processor that builds")

    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("dealii@9.4.1 ~mpi+umfpack")
    depends_on("gmsh@4.8: +shared")
    depends_on("eigen@3.4:")
    depends_on("suite-sparse")
    depends_on("metis@5:")
    depends_on("openblas threads=openmp")
    depends_on("sundials@6: +cvode+arkode")
    depends_on("intel-tbb")
    depends_on("boost")
    depends_on("fmt")
    depends_on("spdlog")
    depends_on("cli11")
    depends_on("tomlplusplus")
    depends_on("nlohmann-json")
    depends_on("minizip")
    depends_on("zlib-api")
    depends_on("sqlite")
    depends_on("openturns")
    depends_on("spectra")
    depends_on("googletest", type="build")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("MILLSTAND_NATIVE", "native"),
            self.define("MILLSTAND_UNITY", True),
            self.define("MILLSTAND_BENCH", False),
        ]

# A recipe for Spack. The release fills in the address and the checksum of the source archive.
import os

from spack.package import *


class Isojam(CMakePackage):
    """Jammed packings of soft frictionless convex solids, and why they are rigid."""

    url = "https://ADDRESS-OF-THE-RELEASE/isojam-0.1.0.tar.gz"

    license("BSD-3-Clause")

    version("0.1.0", sha256="CHECKSUM-OF-THE-RELEASE")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("boost@1.74:")
    depends_on("cli11@2.1:")
    depends_on("eigen@3.4:")
    depends_on("fmt@9:")
    depends_on("tbb")
    depends_on("metis@5.1:")
    depends_on("nlohmann-json@3.11:")
    depends_on("python@3.9:", type=("build", "run"))
    depends_on("py-numpy", type="run")
    depends_on("py-pandas", type="run")
    depends_on("spectra@1.0:")

    extends("python")
    generator("ninja")
    requires("target=x86_64:", "target=aarch64:", policy="one_of", msg="isojam runs on x86-64 and on arm64")

    def cmake_args(self):
        # Vega and three.js are no packages of Spack, so `report` and `chart` are left out.
        return [
            self.define("ISOJAM_TESTS", False),
            self.define("ISOJAM_PAGES", False),
            self.define("ISOJAM_PYTHON", self.spec["python"].command.path),
            self.define("ISOJAM_PYTHON_DIR", os.path.relpath(python_platlib, self.prefix)),
        ]

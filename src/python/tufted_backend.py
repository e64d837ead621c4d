"""Builds the wheel for pip (PEP 517): configures the project with CMake, builds the module and packs what it needs.
It lies in the source tree because Debian and Ubuntu have no package of a backend that runs CMake.
"""
import base64
import hashlib
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = "A Laplacian for point clouds and nonmanifold triangle meshes"


def _version():
    return re.search(r'TUFTED_VERSION "([\d.]+)', (ROOT / "include/tufted/version.h").read_text(encoding="utf-8"))[1]


def _check_packages():
    """Says what is missing before minutes of compiling. With pip's build isolation nothing of the system is there."""
    missing = [name for name in ("numpy", "scipy") if importlib.util.find_spec(name) is None]
    if missing:
        raise RuntimeError(f"tufted: {sys.executable} finds no {' and no '.join(missing)}. Install what "
                           "tools/install_dependencies.sh --python does, take an environment of /usr/bin/python3 -m venv "
                           "--system-site-packages, and call pip install --no-build-isolation; see docs/python.md")


def _build():
    """Builds the package and returns its folder."""
    _check_packages()
    folder = str(ROOT / "build" / "wheel")
    configure = ["cmake", "-S", str(ROOT), "-B", folder, *(["-G", "Ninja"] if shutil.which("ninja") else []),
                 "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DTUFTED_WITH_PYTHON=ON",
                 "-DTUFTED_WITH_PCL=OFF", "-DTUFTED_BUILD_TOOLS=OFF", "-DTUFTED_BUILD_TESTS=OFF",
                 f"-DTUFTED_PYTHON={sys.executable}", "-DCMAKE_MODULE_LINKER_FLAGS=-s"]
    subprocess.run(configure, check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "tufted_python", "--parallel", str(os.cpu_count() or 1)],
                   check=True)
    return pathlib.Path(folder, "python", "tufted")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = _version()
    tag = "cp{0}{1}-cp{0}{1}-{2}".format(*sys.version_info[:2], re.sub(r"[-.]", "_", sysconfig.get_platform()))
    info = f"tufted-{version}.dist-info"
    files = {f"tufted/{path.name}": path.read_bytes() for path in sorted(_build().iterdir())
             if path.suffix in (".py", ".pyi", ".so") or path.name == "py.typed"}
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: tufted\nVersion: {version}\nSummary: {SUMMARY}\n"
                                 "License-File: LICENSE\nRequires-Python: >=3.8\nRequires-Dist: numpy\n"
                                 "Requires-Dist: scipy\n").encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: tufted_backend\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}\n").encode()
    record = "".join(f"{name},sha256={_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    name = f"tufted-{version}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
    return name


def _digest(content):
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def build_sdist(sdist_directory, config_settings=None):
    version = _version()
    name = f"tufted-{version}"
    with tarfile.open(pathlib.Path(sdist_directory, f"{name}.tar.gz"), "w:gz") as archive:
        for part in ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "pyproject.toml", "include", "src"):
            archive.add(ROOT / part, f"{name}/{part}")
    return f"{name}.tar.gz"


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []

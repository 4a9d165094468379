# SPDX-License-Identifier: GPL-3.0-or-later
"""The build backend (PEP 517) of the sdist: the library by meson, then the module with it inside by meson-python."""
import os
import subprocess
import tempfile
from pathlib import Path

import mesonpy

SOURCE = Path(__file__).resolve().parent.parent
OPTIONS = ["-Dtests=disabled", "-Dmpi=disabled", "-Dlive=disabled", "-Dstatic-programs=disabled", "-Dfmi=disabled"]

get_requires_for_build_wheel = mesonpy.get_requires_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    target = str(Path(wheel_directory).resolve())
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["meson", "setup", folder, str(SOURCE), *OPTIONS], check=True)
        subprocess.run(["ninja", "-C", folder, "lib/libfbd.a"], check=True)
        places = [str(Path(folder) / "meson-uninstalled"), os.environ.get("PKG_CONFIG_PATH", "")]
        os.environ["PKG_CONFIG_PATH"] = os.pathsep.join(filter(None, places))
        os.chdir(SOURCE / "python")
        return mesonpy.build_wheel(target, config_settings)


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the sdist is made from the repository, by packaging/sdist")

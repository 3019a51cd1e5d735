"""Builds the programs from a copy of these sources in which no surface has any lobe but the diffuse one and the
compiler can see it, so that all code for reflection, transmission and caustic photons falls away. It shows what that
code costs a scene that does not use it; it renders nothing but such scenes rightly."""
import os
import shutil
import subprocess

from report_lib.programs import Failure, Programs
from report_lib.scenes import ROOT

# File, text that stands in it exactly once, what takes its place.
CHANGES = (
    ("common/bsdf/bsdf.h", "struct Bsdf {",
     "struct Never {  // a bool that is known to be false\n"
     "  Never& operator=(bool) { return *this; }\n"
     "  constexpr operator bool() const { return false; }\n"
     "};\n\nstruct Bsdf {"),
    ("common/bsdf/bsdf.h", "bool reflects = false;", "Never reflects;"),
    ("common/bsdf/bsdf.h", "bool dielectric = false;", "Never dielectric;"),
    ("common/bsdf/bsdf.h", "return passThrough > 0 || (dielectric && !isBlack(transmissionTint));", "return false;"),
    ("common/scene/needs.h", "return reflection || transmission;", "return false;"),
)


def make(context):
    """The Programs of that build. Raises Failure if the sources have changed so that CHANGES no longer fit."""
    source = os.path.join(context.folder, "plain_source")
    build = os.path.join(context.options.out, "plain_build")  # stays, so that the next time is quicker
    _copy(source)
    for name, old, new in CHANGES:
        _change(os.path.join(source, name), old, new)
    context.progress("building without features")
    _run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DNINEFOLD_TESTS=OFF")
    _run("cmake", "--build", build)
    return Programs(os.path.join(build, "bin"), context.programs.clients, context.progress)


def _copy(to):
    shutil.rmtree(to, ignore_errors=True)
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], stdout=subprocess.PIPE, check=True).stdout
    for name in names.decode().split("\0"):
        if name.startswith(("CMake", "cmake/", "common/", "proto/", "client/", "master/", "tools/")):
            os.makedirs(os.path.dirname(os.path.join(to, name)), exist_ok=True)
            shutil.copy2(os.path.join(ROOT, name), os.path.join(to, name))


def _change(path, old, new):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if text.count(old) != 1:
        raise Failure(f"{path} has {text.count(old)} times '{old}', not once: bring scripts/report_lib/plain_build.py up to date")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(old, new))


def _run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        lines = [line for line in done.stdout.splitlines() if "error" in line.lower()] or done.stdout.splitlines()[-1:]
        raise Failure(f"{' '.join(command)}: {' '.join(lines[:1])}")

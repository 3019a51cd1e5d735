"""scripts/report: runs the sections that are asked for and writes the page."""
import datetime
import os
import platform
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from report_lib import options as command_line  # noqa: E402  the path comes first
from report_lib.programs import Failure, Programs, Progress  # noqa: E402
from report_lib.scenes import ROOT  # noqa: E402


class Context:
    """What a section may use. folder: its own, for pictures and runs."""

    def __init__(self, options, programs, references, progress):
        self.options, self.programs, self.references, self.progress = options, programs, references, progress
        self.scenes, self.few_scenes = options.scenes, options.few
        self.folder = None


def main(words):
    options = command_line.parse(words)
    # Only now what is slow to load, so that --help is there without it.
    from report_lib import keep, page, references, section
    progress = Progress(time.monotonic)
    failed = False
    try:
        programs = Programs(options.programs, options.clients, progress)
        cache = references.References(programs, options.references, options.reference_error, options.reference_seconds)
        failed = not run_sections(Context(options, programs, cache, progress), section)
    except Failure as failure:
        print(f"report: {failure}", file=sys.stderr)
        return 1
    sections = [found for name in command_line.SECTIONS if (found := section.load(options.out, name))]
    write(options, sections, page, keep)
    return 1 if failed else 0


def run_sections(context, section):
    """A section that fails costs the others nothing."""
    well = True
    for name in context.options.sections:
        context.folder = section.fresh_folder(context.options.out, name)
        try:
            made = section.module_of(name).run(context)
        except Failure as failure:
            print(f"report: section {name}: {failure}", file=sys.stderr)
            well = False
            continue
        made.made = circumstances(context.options)
        section.save(context.options.out, made)
    return well


def write(options, sections, page, keep):
    os.makedirs(options.out, exist_ok=True)
    for made in sections:
        for table in made.tables:
            with open(os.path.join(options.out, table.name + ".csv"), "w", encoding="utf-8") as file:
                file.write(table.csv())
    path = os.path.join(options.out, "report.html")
    page.write(path, sections, options.out)
    print(f"the report is {path}")
    if options.keep:
        keep.write(options.keep, sections, options.out)


def circumstances(options):
    return {"date": datetime.date.today().isoformat(), "commit": commit(),
            "machine": f"{processor()}, {os.cpu_count()} cores",
            "options": f"{options.clients} clients, {options.width} pixels wide" + (", quick" if options.quick else "")}


def commit():
    def git(*arguments):
        return subprocess.run(["git", "-C", ROOT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=False).stdout.strip()
    changed = git("status", "--porcelain", "--", "common", "proto", "client", "master", "tools")
    return (git("rev-parse", "--short", "HEAD") or "unknown") + (" with changes" if changed else "")


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

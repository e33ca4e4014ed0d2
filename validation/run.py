#!/usr/bin/env python3
"""Compares abbe with reference packages: `python3 validation/run.py`, from any folder.

Needs Rust and a Python that the packages of requirements.txt support (3.11 to 3.14); this file itself runs with
Python 3.9 and looks for such a one on the path. The packages go into validation/.venv, which is made once and used again until
requirements.txt changes. Writes validation/report.md; the exit code is 1 if anything is out of tolerance.
"""

import argparse
import hashlib
import importlib
import json
import multiprocessing
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from binary import PROFILE, abbe_binary

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
ENVIRONMENT = HERE / ".venv"
REQUIREMENTS = HERE / "requirements.txt"
PYTHONS = [(3, 14), (3, 13), (3, 12), (3, 11)]  # what colour-science 0.4.7 and numpy 2.4 support
INSIDE = "ABBE_VALIDATION_INSIDE"


def venv_python():
    return ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def find_python():
    """This interpreter, or another on the path if the packages do not support it."""
    if sys.version_info[:2] in PYTHONS:
        return sys.executable
    for major, minor in PYTHONS:
        found = shutil.which(f"python{major}.{minor}")
        if found:
            return found
    sys.exit(f"Python {sys.version.split()[0]}; expected 3.11 to 3.14, here or on the path as python3.x")


def ensure_environment():
    """Makes the virtual environment unless the one there was made from the same requirements."""
    stamp = ENVIRONMENT / "requirements.sha256"
    digest = hashlib.sha256(REQUIREMENTS.read_bytes()).hexdigest()
    if venv_python().exists() and stamp.exists() and stamp.read_text().strip() == digest:
        return
    print("installing the reference packages into", ENVIRONMENT, flush=True)
    python = find_python()
    subprocess.run([python, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
    pip = [str(venv_python()), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, "-r", str(REQUIREMENTS)], check=True)
    stamp.write_text(digest + "\n")


def evaluate_all(requests):
    """Values of the library's functions at lists of arguments; the example is brought up to date first."""
    command = ["cargo", "run", "--profile", PROFILE, "--quiet", "--example", "evaluate"]
    text = json.dumps([{"function": function, "arguments": arguments} for function, arguments in requests])
    done = subprocess.run(command, cwd=ROOT, input=text, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def evaluate(function, arguments):
    """Values of one function."""
    return evaluate_all([(function, arguments)])[0]


def subject_rows(only, frozen):
    """Rows of the modules of subjects/, two at a time. Each has a process of its own: colour-science's tables can be changed
    in place, and what one subject does to them must not reach another."""
    import colour  # noqa: F401 - a forked process has it already

    names = [path.stem for path in sorted((HERE / "subjects").glob("*.py")) if not only or path.stem in only]
    method = "fork" if "fork" in multiprocessing.get_all_start_methods() else "spawn"
    with multiprocessing.get_context(method).Pool(2, maxtasksperchild=1) as pool:
        return sum(pool.map(rows_of, [(name, frozen) for name in names], chunksize=1), [])


def rows_of(task):
    """Rows of one module, which has `comparisons()`, `checks(evaluate)` or both."""
    name, frozen = task
    sys.path.insert(0, str(HERE))
    import comparison

    module = importlib.import_module("subjects." + name)
    comparisons = module.comparisons() if hasattr(module, "comparisons") else []
    values = evaluate_all([(c.function, c.arguments) for c in comparisons])
    rows = [c.row(v) for c, v in zip(comparisons, values)]
    if hasattr(module, "checks"):
        rows += module.checks(evaluate)
    if frozen:
        comparison.freeze(HERE / "reference", name, comparisons)
    return rows


def all_rows(only, frozen):
    rows = subject_rows(only, frozen)
    return rows if only else rows + other_rows()


def other_rows():
    rows = []
    if (HERE / "glass_check.py").exists():
        import glass_check

        rows += glass_check.check(abbe_binary())
    return rows


def formatted(rows):
    """The table as Markdown, which reads well on a terminal too."""
    lines = [("subject", "cases", "largest error", "tolerance", "verdict")]
    for subject, cases, error, tolerance, ok in rows:
        lines.append((subject, str(cases), f"{error:.2g}", f"{tolerance:.2g}", "ok" if ok else "MISS"))
    widths = [max(len(line[column]) for line in lines) for column in range(5)]
    text = [" | ".join(cell.ljust(width) for cell, width in zip(line, widths)) for line in lines]
    text.insert(1, " | ".join("-" * width for width in widths))
    return "".join(f"| {line} |\n" for line in text)


NOT_COVERED = """
## Not yet covered

What colour-science has and this report does not compare: Stockman-Sharpe cone fundamentals; Munsell notation (values are
compared); limits and volumes of RGB spaces; thin films and multilayers; Rayleigh scattering; a rendered chart of patches
(the command line is compared end to end). Tone mapping operators are tested in the crate alone.
"""


def write_report(table):
    packages = [line for line in REQUIREMENTS.read_text().split("\n") if line and not line.startswith("#")]
    head = "# Validation\n\nWritten by `python3 validation/run.py`. References: " + ", ".join(packages) + ".\n\n"
    (HERE / "report.md").write_text(head + table + NOT_COVERED, encoding="utf-8")


def arguments():
    parser = argparse.ArgumentParser(description="Compares abbe with reference packages.")
    parser.add_argument("--freeze", action="store_true", help="write the values that cargo test checks to reference/")
    parser.add_argument("--only", nargs="+", metavar="SUBJECT", help="modules of subjects/ alone, without a report")
    return parser.parse_args()


def main():
    wanted = arguments()
    if os.environ.get(INSIDE) != "1":
        ensure_environment()
        command = [str(venv_python()), str(Path(__file__).resolve()), *sys.argv[1:]]
        sys.exit(subprocess.run(command, env={**os.environ, INSIDE: "1", "PYTHONWARNINGS": "ignore"}).returncode)
    start = time.monotonic()
    sys.path.insert(0, str(HERE))
    rows = all_rows(wanted.only, wanted.freeze)
    table = formatted(rows)
    if not wanted.only:
        write_report(table)
    print(table, end="")
    missed = sum(not row[4] for row in rows)
    print(f"{len(rows)} subjects, {missed} out of tolerance, {time.monotonic() - start:.0f} s")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()

"""Comparisons of the library with a reference: what is asked, what is expected, how near it has to be."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FROZEN_CASES = 24


@dataclass
class Comparison:
    """One line of the report: a function of validation/evaluate at many arguments."""

    subject: str
    function: str
    arguments: list  # one JSON value a case
    expected: list  # a number, or a (nested) list or array of numbers, for each case
    tolerance: float
    relative: bool = False  # to the largest component of each case's expected value; else absolute
    frozen_cases: int = FROZEN_CASES  # how many of the cases, evenly spread, cargo test keeps; 0 for none

    def row(self, values):
        errors = [error_of(value, expected, self.relative) for value, expected in zip(values, self.expected)]
        complete = len(values) == len(self.expected) == len(self.arguments) > 0
        worst = max(errors, key=lambda e: np.inf if np.isnan(e) else e) if complete else np.nan
        return row(self.subject, len(errors), worst, self.tolerance)

    def frozen(self):
        """As JSON, with some of its cases."""
        count = min(self.frozen_cases, len(self.arguments))
        chosen = [round(i * (len(self.arguments) - 1) / max(1, count - 1)) for i in range(count)]
        return {
            "subject": self.subject,
            "function": self.function,
            "tolerance": self.tolerance,
            "relative": self.relative,
            "arguments": [self.arguments[i] for i in chosen],
            "expected": [np.asarray(self.expected[i], dtype=float).tolist() for i in chosen],
        }


def error_of(value, expected, relative):
    """The largest difference; NaN if there is no value, or one of another shape."""
    if isinstance(value, dict) or value is None:
        return np.nan
    value, expected = np.asarray(value, dtype=float).ravel(), np.asarray(expected, dtype=float).ravel()
    if value.shape != expected.shape:
        return np.nan
    difference = float(np.abs(value - expected).max())
    return difference / float(np.abs(expected).max()) if relative and difference > 0.0 else difference


def row(subject, cases, error, tolerance):
    """One line of the report. NaN is a miss."""
    return subject, int(cases), float(error), float(tolerance), bool(error <= tolerance)


def freeze(folder, name, comparisons):
    """Writes the cases that cargo test checks; one comparison a line."""
    kept = [json.dumps(c.frozen(), allow_nan=False) for c in comparisons if c.frozen_cases > 0]
    if kept:
        Path(folder, name + ".json").write_text("[\n" + ",\n".join(kept) + "\n]\n", encoding="utf-8")

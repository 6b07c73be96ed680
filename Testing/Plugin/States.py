"""A saved state, as .pvsm and as a Python script, brings back the same trim."""
import os

from paraview import smstate
from paraview.simple import FindSource, LoadState, ResetSession, SaveState

from Checks import OUTPUT_DIRECTORY, check_equal, sheet, summary, trim, wave_at

OPTIONS = {"CorrectionType": 3, "Optimization": 1, "InvertSide": 1, "UseKeepPoint": 1,
           "KeepPoint": [1.0, 2.0, 0.25], "EliminationFraction": 0.4, "RenumberNodes": 0,
           "Tolerance": 1e-8, "QualityOfAllElements": 1, "InsertLayer": 1,
           "MapValues": 1}


def values(proxy):
    return {name: repr(proxy.GetPropertyValue(name)) for name in OPTIONS}


def check_restored(expected_values, expected_summary, what):
    restored = FindSource("TheTrim")
    check_equal(values(restored), expected_values, "properties from " + what)
    # NaN is not equal to itself: compared as text.
    check_equal(repr(summary(restored)), repr(expected_summary), "summary from " + what)


original = trim(sheet(), wave_at(10.3), registrationName="TheTrim", **OPTIONS)
original_values, original_summary = values(original), summary(original)
state = os.path.join(OUTPUT_DIRECTORY, "trim.pvsm")
SaveState(state)
script = smstate.get_state()

ResetSession()
LoadState(state)
check_restored(original_values, original_summary, "the .pvsm file")

ResetSession()
exec(compile(script, "state", "exec"), {"__name__": "state"})
check_restored(original_values, original_summary, "the Python state")
